// SPDX-License-Identifier: BSD-3-Clause
// Arrays that start on a cache line, and the array of nodal vectors of the time loop.
#pragma once
#include "numbers/simd.hpp"

#include <cstddef>
#include <new>
#include <span>
#include <vector>

namespace meniscus {

/// Allocates memory that starts on a cache line. From 4 MB on it starts on a page of 2 MB, and the
/// system is asked for pages of that size: they need fewer address translations (performance note
/// 2).
void* allocate_lines(std::size_t bytes);
void release_lines(void* p, std::size_t bytes);
/// Touches the pages of allocated, unused memory on all threads, so that the system provides them
/// in parallel. One thread alone would wait for them about as long as for writing the data.
void take_pages(void* begin, std::size_t bytes);

template <class T>
struct CacheLineAllocator {
  using value_type = T;
  CacheLineAllocator() = default;
  template <class U>
  CacheLineAllocator(const CacheLineAllocator<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(allocate_lines(n * sizeof(T))); }
  void deallocate(T* p, std::size_t n) { release_lines(p, n * sizeof(T)); }
  template <class U>
  bool operator==(const CacheLineAllocator<U>&) const {
    return true;
  }
};

/// A vector whose first element starts a cache line.
template <class T>
using AlignedVector = std::vector<T, CacheLineAllocator<T>>;

/// Leaves new elements uninitialised: the caller has to write them.
template <class T>
struct UnsetAllocator : CacheLineAllocator<T> {
  UnsetAllocator() = default;
  template <class U>
  UnsetAllocator(const UnsetAllocator<U>&) {}
  template <class U>
  void construct(U* p) {
    ::new (static_cast<void*>(p)) U;
  }
  template <class U>
  bool operator==(const UnsetAllocator<U>&) const {
    return true;
  }
};

/// A long vector that all threads fill.
template <class T>
using UnsetVector = std::vector<T, UnsetAllocator<T>>;

/// Resizes a vector. The pages of new elements are touched in parallel if the vector is empty or
/// enough memory is reserved.
template <class T>
void grow(UnsetVector<T>& v, std::size_t size) {
  if (v.empty()) v.reserve(size);
  if (size > v.size() && size <= v.capacity())
    take_pages(v.data() + v.size(), (size - v.size()) * sizeof(T));
  v.resize(size);
}

/// A vector of one particle in 2D or 3D, padded to four doubles so that it fits one register.
/// Components beyond D are zero and stay zero.
using NodalVector = Lanes;
/// One vector per particle.
using NodalVectors = AlignedVector<NodalVector>;
/// One vector per particle for intermediate results, which are written before they are read.
/// Entries that a rank never touches take no memory.
using NodalScratch = UnsetVector<NodalVector>;

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
