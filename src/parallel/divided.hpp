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
  /// Like complete_items(), but does nothing if one rank has all items: nobody else needs them.
  void complete_where_rows_are(Index n, void* values, std::size_t bytes_per_value) const {
    if (place_ == even) complete_items(n, values, bytes_per_value);
  }
  /// Like complete_items() for items with several values each: item i has values[start[i]] to
  /// values[start[i + 1] - 1].
  void complete_runs(Index n, std::span<const Offset> start, void* values,
                     std::size_t bytes_per_value) const;

  // The same functions for rows instead of items.
  OwnItems own_rows(Index n) const;
  Index first_row(Index n, int rank) const;
  int rank_of_row(Index n, Index row) const;
  void complete_rows(Index n, void* values, std::size_t bytes_per_value) const;
  /// The part of a list that belongs to this rank. `listed` has some of n rows in ascending order;
  /// the result is a range of places in the list.
  ItemRange own_listed(Index n, std::span<const Index> listed) const;
  /// Gathers values[place in the list].
  void complete_listed(Index n, std::span<const Index> listed, void* values,
                       std::size_t bytes_per_value) const;

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
    return sum_of_own(n, zero, f,
                      [&](T* sums) { complete_items(chunk_count(n), sums, sizeof(T)); });
  }
  /// Like sum(), but if one rank has all rows, only that rank gets the result.
  template <class T, class F>
  T sum_where_rows_are(Index n, T zero, F&& f) const {
    return sum_of_own(n, zero, f,
                      [&](T* sums) { complete_where_rows_are(chunk_count(n), sums, sizeof(T)); });
  }

 private:
  template <class T, class F, class Complete>
  T sum_of_own(Index n, T zero, F&& f, Complete&& complete) const {
    const OwnItems own = own_items(chunk_count(n));
    return sum_by_chunks<Cost::much>(
        n, {0, n}, zero, f, own.end - own.begin, [&](Index k) { return own.begin + k; }, complete);
  }

  static constexpr int even = -1, each = -2;

  template <class First>
  void complete(void* values, std::size_t bytes_per_value, First&& first) const;

  int place_ = even;  // the rank that has all, or even or each
};

inline constexpr Division evenly{};

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

/// Calls f(k) in parallel for the items k of this rank out of n. record(k) then returns a trivially
/// copyable result; other ranks get it as take(k, record).
template <class F, class Record, class Take>
void divided_for(const Division& division, Index n, F&& f, Record&& record, Take&& take,
                 int grain = 64) {
  const OwnItems own = division.own_items(n);
  parallel_for(own, f, grain);
  if (ranks().alone() || division.is_to_each()) return;
  std::vector<decltype(record(0))> records(static_cast<std::size_t>(n));
  for (Index k = own.begin; k < own.end; ++k) at(records, k) = record(k);
  division.complete_items(n, records.data(), sizeof records[0]);
  for (Index k = 0; k < n; ++k)
    if (k < own.begin || k >= own.end) take(k, at(records, k));
}

/// Like divided_for() for some of n rows, `listed` in ascending order: f(row), record(row) and
/// take(row, record). Each rank computes the rows that it owns.
template <class F, class Record, class Take>
void divided_for_rows(const Division& division, Index n, std::span<const Index> listed, F&& f,
                      Record&& record, Take&& take, int grain) {
  const ItemRange own = division.own_listed(n, listed);
  parallel_for(
      own, [&](Index k) { f(at(listed, k)); }, grain);
  if (ranks().alone() || division.is_to_each()) return;
  std::vector<decltype(record(0))> records(listed.size());
  for (Index k = own.begin; k < own.end; ++k) at(records, k) = record(at(listed, k));
  division.complete_listed(n, listed, records.data(), sizeof records[0]);
  for (Index k = 0; k < static_cast<Index>(listed.size()); ++k)
    if (k < own.begin || k >= own.end) take(at(listed, k), at(records, k));
}

}  // namespace meniscus
