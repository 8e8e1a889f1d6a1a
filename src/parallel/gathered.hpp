// SPDX-License-Identifier: BSD-3-Clause
// Arrays of which each rank computes a part, and their exchange.
#pragma once
#include "parallel/divided.hpp"

#include <exception>
#include <span>
#include <vector>

namespace meniscus {

/// An array of which each rank has computed its share. Values are copied byte by byte.
struct Gathered {
  void* values;
  std::size_t bytes_per_item;
  Portions shares;

  template <class T>
  Gathered(T* array, const Portions& of_ranks, std::size_t values_per_item = 1)
      : values(array), bytes_per_item(values_per_item * sizeof(T)), shares(of_ranks) {}
};

/// Completes arrays on all ranks, all in one exchange.
class GatherTogether {
 public:
  /// All ranks call this with arrays of the same lengths and shares. `failure` is an exception of
  /// this rank, or null. If some rank has one, it is thrown on all ranks.
  void operator()(std::span<const Gathered> arrays, const std::exception_ptr& failure = nullptr);

 private:
  std::vector<std::size_t> begin_;  // of the bytes of each rank, and their number
  std::vector<std::byte> bytes_;
};

/// Results of the chunks of a set of rows, [chunk]. Each rank computes the results of own chunks.
template <class T>
class ChunkTally {
 public:
  ChunkTally() = default;
  ChunkTally(int chunks, const Division& division)
      : division_(division), of_chunk_(static_cast<std::size_t>(chunks)) {}

  T& operator[](int chunk) { return at(of_chunk_, chunk); }
  auto begin() const { return of_chunk_.begin(); }
  auto end() const { return of_chunk_.end(); }
  /// Sum over all chunks in ascending order, once the results are gathered.
  T sum(T zero) const {
    for (const T& of_chunk : of_chunk_) zero = zero + of_chunk;
    return zero;
  }
  Gathered gathered() { return {of_chunk_.data(), shares()}; }
  /// For results that only ranks with rows need: not gathered if one rank has all rows.
  Gathered gathered_where_rows_are() {
    return {of_chunk_.data(), division_.is_whole()
                                  ? Division::to_each().items(static_cast<Index>(of_chunk_.size()))
                                  : shares()};
  }

 private:
  Portions shares() const { return division_.items(static_cast<Index>(of_chunk_.size())); }

  Division division_;
  std::vector<T> of_chunk_;
};

}  // namespace meniscus
