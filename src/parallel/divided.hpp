// SPDX-License-Identifier: BSD-3-Clause
// Loops over items that all ranks hold; each rank computes a part of them (scaling note 2).
#pragma once
#include "parallel/parallel.hpp"
#include "parallel/ranks.hpp"

#include <span>
#include <vector>

namespace meniscus {

/// The range of items out of n that one rank computes.
using OwnItems = ItemRange;

class Portions;

/// How the rows and items of a body are divided between the ranks: evenly, all on one rank (a small
/// body), or all on each rank. Rows are divided at the borders of their chunks.
class Division {
 public:
  constexpr Division() = default;
  /// All items on one rank.
  constexpr explicit Division(int rank) : place_(rank) {}
  /// Each rank computes all items, so nothing is exchanged.
  static constexpr Division to_each() { return Division(each); }

  /// True if one rank has all items.
  bool is_whole() const { return place_ >= 0; }
  /// The rank that has all items, for a division that is not even. With to_each() this is the
  /// calling rank.
  int only_rank() const { return place_ == each ? ranks().rank() : place_; }
  bool is_to_each() const { return place_ == each; }
  /// True if this rank can have rows or items.
  bool has_some() const { return place_ == even || only_rank() == ranks().rank(); }
  /// The items of this rank.
  OwnItems own_items(Index n) const;
  /// The first item of a rank; n for rank = number of ranks.
  Index first_item(Index n, int rank) const;
  /// The rank that computes an item out of n.
  int rank_of_item(Index n, Index item) const;
  /// Gathers values[item], of `bytes_per_value` bytes each: each rank gets the items of all others.
  void complete_items(Index n, void* values, std::size_t bytes_per_value) const;
  // The same functions for rows instead of items.
  OwnItems own_rows(Index n) const;
  Index first_row(Index n, int rank) const;
  int rank_of_row(Index n, Index row) const;
  void complete_rows(Index n, void* values, std::size_t bytes_per_value) const;

  // The shares of the ranks in n items or n rows.
  Portions items(Index n) const;
  Portions rows(Index n) const;
  /// The shares of the rows in a list of some of n rows, in ascending order. The list must live as
  /// long as the result.
  Portions listed(Index n, std::span<const Index> list) const;

  /// Calls use(i, value) on all ranks for all i < n in ascending order. The rank that has row i
  /// computes value = make(i). Values are made and sent one chunk at a time.
  template <class Make, class Use>
  void for_all_in_order(Index n, Make&& make, Use&& use) const {
    std::vector<decltype(make(0))> values;
    for (int c = 0; c < chunk_count(n); ++c) {
      const Index begin = chunk_begin(n, c), size = chunk_begin(n, c + 1) - begin;
      const int rank = rank_of_item(chunk_count(n), c);
      values.resize(static_cast<std::size_t>(size));
      if (rank == ranks().rank())
        parallel_for(size, [&](Index k) { at(values, k) = make(begin + k); });
      ranks().hand_out(rank, values.data(), values.size() * sizeof values[0]);
      for (Index k = 0; k < size; ++k) use(begin + k, at(values, k));
    }
  }

  /// parallel_sum() with the same bits. Each rank adds up the chunks of its rows, then sums are
  /// gathered.
  template <class T, class F>
  T sum(Index n, T zero, F&& f) const {
    const OwnItems own = own_items(chunk_count(n));
    return sum_by_chunks<Cost::much>(
        n, {0, n}, zero, f, own.end - own.begin, [&](Index k) { return own.begin + k; },
        [&](T* sums) { complete_items(chunk_count(n), sums, sizeof(T)); });
  }

 private:
  static constexpr int even = -1, each = -2;

  template <class First>
  void complete(void* values, std::size_t bytes_per_value, First&& first) const;

  int place_ = even;  // the rank that has all, or even or each
};

inline constexpr Division evenly{};

/// The ranges of n items that the ranks have: rank r has the items first(r), ..., first(r + 1) - 1.
class Portions {
 public:
  Index first(int rank) const;
  ItemRange of(int rank) const { return {first(rank), first(rank + 1)}; }
  ItemRange own() const { return of(ranks().rank()); }
  /// True if ranks receive items of other ranks.
  bool are_sent() const { return !ranks().alone() && !division_.is_to_each(); }
  /// Number of items that others need from a rank: none if each rank has all items.
  std::size_t sent_by(int rank) const {
    return division_.is_to_each() ? 0 : static_cast<std::size_t>(first(rank + 1) - first(rank));
  }

 private:
  friend class Division;
  enum class Of { items, rows, list };
  Portions(const Division& division, Of kind, Index n, std::span<const Index> list = {})
      : division_(division), kind_(kind), n_(n), list_(list) {}

  Division division_;
  Of kind_;
  Index n_;
  std::span<const Index> list_;
};

/// Divides bodies with rows[body] rows each between the ranks. A body with at most half of the rows
/// of a rank goes to one rank: its exchanges would cost more than its rows. Only as many bodies are
/// placed so as leave no rank with more than 5 % over its share. Bodies that follow each other tend
/// to the same rank.
std::vector<Division> divide(std::span<const Index> rows);

/// The value `mine` of each rank, [rank].
template <class T>
std::vector<T> said_by_ranks(const T& mine) {
  std::vector<T> all(static_cast<std::size_t>(ranks().size()), mine);
  evenly.complete_items(ranks().size(), all.data(), sizeof(T));
  return all;
}

}  // namespace meniscus
