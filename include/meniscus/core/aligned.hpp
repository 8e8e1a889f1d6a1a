// SPDX-License-Identifier: BSD-3-Clause
// Arrays that start on a cache line, and the array of nodal vectors of the time loop.
#pragma once
#include "meniscus/core/simd.hpp"

#include <cstdlib>
#include <new>
#include <span>
#include <vector>

namespace meniscus {

template <class T>
struct CacheLineAllocator {
  using value_type = T;
  static constexpr std::size_t alignment = 64;
  CacheLineAllocator() = default;
  template <class U>
  CacheLineAllocator(const CacheLineAllocator<U>&) {}
  T* allocate(std::size_t n) {
    return static_cast<T*>(::operator new (n * sizeof(T), std::align_val_t{alignment}));
  }
  void deallocate(T* p, std::size_t) { ::operator delete (p, std::align_val_t{alignment}); }
  template <class U>
  bool operator==(const CacheLineAllocator<U>&) const {
    return true;
  }
};

template <class T>
using AlignedVector = std::vector<T, CacheLineAllocator<T>>;

/// One vector per particle, padded to four doubles (2D and 3D alike): a particle is one register.
/// Unused components are zero and stay zero.
using NodalVectors = AlignedVector<Lanes>;

template <int D>
Vec<D> vector_at(std::span<const Lanes> field, Index i) {
  Vec<D> x;
  for (int k = 0; k < D; ++k) x[k] = at(field, i)[k];
  return x;
}

template <int D>
void set_vector(std::span<Lanes> field, Index i, const Vec<D>& x) {
  Lanes lanes = Lanes::zero();
  for (int k = 0; k < D; ++k) lanes.set(k, x[k]);
  at(field, i) = lanes;
}

}  // namespace meniscus
