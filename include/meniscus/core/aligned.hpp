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

/// A vector whose first element starts a cache line.
template <class T>
using AlignedVector = std::vector<T, CacheLineAllocator<T>>;

/// A vector of one particle, padded to four doubles (2D and 3D alike), so that it is one register.
/// Components beyond D are zero and stay zero.
using NodalVector = Lanes;
/// One vector per particle.
using NodalVectors = AlignedVector<NodalVector>;

/// The first D components of entry i.
template <int D>
Vec<D> vector_at(std::span<const NodalVector> field, Index i) {
  Vec<D> x;
  for (int k = 0; k < D; ++k) x[k] = at(field, i)[k];
  return x;
}

/// Sets entry i to x, and the components beyond D to zero.
template <int D>
void set_vector(std::span<NodalVector> field, Index i, const Vec<D>& x) {
  NodalVector vector = NodalVector::zero();
  for (int k = 0; k < D; ++k) vector.set(k, x[k]);
  at(field, i) = vector;
}

}  // namespace meniscus
