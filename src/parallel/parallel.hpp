// SPDX-License-Identifier: BSD-3-Clause
// Loops over threads whose results do not depend on the number of threads.
#pragma once
#include "numbers/types.hpp"
#include "parallel/loop_shares.hpp"

#include <algorithm>
#include <cstddef>
#include <exception>
#include <memory>
#include <type_traits>

namespace meniscus {

inline constexpr int most_chunks = 4096;

/// Number of chunks of n rows. It depends on n only, never on the number of threads, since it
/// decides the order of summation and so the last bits of every result.
inline constexpr int chunk_count(Index n) {
  constexpr Index rows_per_chunk = 2048, least = 16;
  return std::clamp<Index>(n / rows_per_chunk, least, most_chunks);
}

/// The row at which chunk c of n rows begins.
inline Index chunk_begin(Index n, int c) {
  return static_cast<Index>(static_cast<Offset>(n) * c / chunk_count(n));
}

/// Calls f(i) for i in [0, n) on all threads, `grain` neighbouring i at a time. If calls throw, the
/// exception of the smallest i is rethrown at the end (an exception must not leave an OpenMP
/// region). For n <= grain a plain loop is used, since opening a region takes time even on one
/// thread.
template <class F>
void parallel_for(Index n, F&& f, Index grain = 64) {
  if (n <= grain) {
    for (Index i = 0; i < n; ++i) f(i);
    return;
  }
  std::exception_ptr failure;
  [[maybe_unused]] Index failed = n;
  LoopShares shares(n / grain + (n % grain != 0));
#pragma omp parallel
  for (Index part = shares.take(); part >= 0; part = shares.take()) {
    const Index end = part < n / grain ? (part + 1) * grain : n;
    for (Index i = part * grain; i < end; ++i) {
      try {
        f(i);
      } catch (...) {
#pragma omp critical(meniscus_parallel_for)
        if (i < failed) {
          failed = i;
          failure = std::current_exception();
        }
      }
    }
  }
  if (failure) std::rethrow_exception(failure);
}

/// The items begin, ..., end - 1.
struct ItemRange {
  Index begin, end;
};

/// parallel_for() over the items of a range.
template <class F>
void parallel_for(const ItemRange& items, F&& f, Index grain = 64) {
  parallel_for(
      items.end - items.begin, [&](Index k) { f(items.begin + k); }, grain);
}

/// The cost of one row.
enum class Cost {
  much,
  little  // a few operations
};

/// Calls f(k) for k in [0, parts) on all threads; the parts together have n rows. Few rows of
/// little cost are done by the calling thread: other threads would take longer to fetch the data.
template <Cost cost, class F>
void for_parts(Index parts, [[maybe_unused]] Index n, F&& f) {
  constexpr Index few = cost == Cost::little ? 4096 : 0;
  parallel_for(parts, f, n > few ? 1 : std::max<Index>(parts, 1));
}

/// Calls f(chunk, begin, end) for the chunks of n rows on all threads.
template <Cost cost = Cost::much, class F>
void for_chunks(Index n, F&& f) {
  for_parts<cost>(chunk_count(n), n,
                  [&](Index c) { f(c, chunk_begin(n, c), chunk_begin(n, c + 1)); });
}

/// Calls f(begin, end) for chunks of n rows of little cost.
template <class F>
void sweep(Index n, F&& f) {
  for_chunks<Cost::little>(n, [&](Index, Index begin, Index end) { f(begin, end); });
}

/// An array on the stack with one value per chunk. Memory beyond the number of chunks is not
/// touched.
template <class T>
class PerChunk {
 public:
  PerChunk(int chunks, const T& value) : size_(static_cast<std::size_t>(chunks)) {
    static_assert(std::is_trivially_destructible_v<T>);
    std::uninitialized_fill_n(begin(), size_, value);
  }
  T& operator[](std::size_t c) { return begin()[c]; }
  T* begin() { return reinterpret_cast<T*>(memory_); }
  T* end() { return begin() + size_; }

 private:
  std::size_t size_;
  alignas(T) std::byte memory_[most_chunks * sizeof(T)];
};

/// Sum of f(i) over a range of items, added in the order of the chunks of n. This rank adds up
/// `count` chunks, chunk(k) for k = 0 .. count - 1; complete(sums) has to fill in the sums of the
/// others.
template <Cost cost, class T, class F, class Chunk, class Complete>
T sum_by_chunks(Index n, ItemRange items, T zero, F&& f, Index count, Chunk&& chunk,
                Complete&& complete) {
  PerChunk<T> partial(chunk_count(n), zero);
  for_parts<cost>(count, n, [&](Index k) {
    const Index c = chunk(k), end = std::min(chunk_begin(n, c + 1), items.end);
    T s = zero;
    for (Index i = std::max(chunk_begin(n, c), items.begin); i < end; ++i) s = s + f(i);
    at(partial, c) = s;
  });
  complete(partial.begin());
  T total = zero;
  for (const T& p : partial) total = total + p;
  return total;
}

/// Sum of f(i) over [0, n), added in the order of the chunks.
template <Cost cost = Cost::much, class T, class F>
T parallel_sum(Index n, T zero, F&& f) {
  return sum_by_chunks<cost>(
      n, {0, n}, zero, f, chunk_count(n), [](Index k) { return k; }, [](T*) {});
}

}  // namespace meniscus
