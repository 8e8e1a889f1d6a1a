// SPDX-License-Identifier: BSD-3-Clause
// Arrays that start on a cache line, and the array of nodal vectors of the time loop.
#pragma once
#include "meniscus/core/simd.hpp"

#include <cstddef>
#include <new>
#include <span>
#include <vector>

namespace meniscus {

/// Memory that starts a cache line; from 4 MB on it starts a page of 2 MB and the system is asked
/// for such pages, of which the processor finds the address sooner (performance note 2).
void* allocate_lines(std::size_t bytes);
void release_lines(void* p, std::size_t bytes);
/// Has the system fill pages of memory that is allocated and not used yet, on all threads: one
/// alone waits for it as long as for what it writes there.
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

/// Leaves new elements as the memory is: who makes them writes them.
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

/// A long vector that is filled by all threads.
template <class T>
using UnsetVector = std::vector<T, UnsetAllocator<T>>;

/// Resizes a vector, quickly where it is empty or that much is reserved.
template <class T>
void grow(UnsetVector<T>& v, std::size_t size) {
  if (v.empty()) v.reserve(size);
  if (size > v.size() && size <= v.capacity())
    take_pages(v.data() + v.size(), (size - v.size()) * sizeof(T));
  v.resize(size);
}

/// A vector of one particle, padded to four doubles (2D and 3D alike), so that it is one register.
/// Components beyond D are zero and stay zero.
using NodalVector = Lanes;
/// One vector per particle.
using NodalVectors = AlignedVector<NodalVector>;
/// The same for intermediate results, which are written before they are read: pages of particles
/// that a rank does not follow take no memory.
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
