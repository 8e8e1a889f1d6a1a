// SPDX-License-Identifier: BSD-3-Clause
// Loops over what all ranks of a run hold, of which each rank does a part (scaling note 2).
#pragma once
#include "meniscus/core/parallel.hpp"
#include "meniscus/core/ranks.hpp"

#include <span>
#include <vector>

namespace meniscus {

/// The items that a rank does of n, a neighbouring part.
using OwnItems = ItemRange;

/// How items and rows are divided between the ranks: evenly, or, those of a small body, all to one,
/// or all to each. Rows are divided in their chunks.
class Division {
 public:
  constexpr Division() = default;
  /// All to one rank.
  constexpr explicit Division(int rank) : place_(rank) {}
  /// All to each rank, which all do the same: nothing is brought.
  static constexpr Division to_each() { return Division(each); }

  /// Whether all are of one rank.
  bool is_whole() const { return place_ >= 0; }
  /// That has all, as this rank sees it; of a division that is not even.
  int only_rank() const { return place_ == each ? ranks().rank() : place_; }
  bool is_to_each() const { return place_ == each; }
  /// Whether this rank may have rows or items.
  bool has_some() const { return place_ == even || only_rank() == ranks().rank(); }
  /// Items of this rank.
  OwnItems own_items(Index n) const;
  /// With which those of a rank begin; of the number of ranks: n.
  Index first_item(Index n, int rank) const;
  /// The rank that does an item of n.
  int rank_of_item(Index n, Index item) const;
  /// Brings values of so many bytes, [item], of the others.
  void complete_items(Index n, void* values, std::size_t bytes_per_value) const;
  /// The same for those only that may have rows: nothing is sent of a whole body.
  void complete_where_rows_are(Index n, void* values, std::size_t bytes_per_value) const {
    if (place_ == even) complete_items(n, values, bytes_per_value);
  }
  /// Of items with several values each, those of item i from values[start[i]] to
  /// values[start[i + 1]].
  void complete_runs(Index n, std::span<const Offset> start, void* values,
                     std::size_t bytes_per_value) const;

  // The same of rows.
  OwnItems own_rows(Index n) const;
  Index first_row(Index n, int rank) const;
  int rank_of_row(Index n, Index row) const;
  void complete_rows(Index n, void* values, std::size_t bytes_per_value) const;
  /// Of some of n rows, listed in ascending order: those of this rank, places in the list.
  ItemRange own_listed(Index n, std::span<const Index> listed) const;
  /// Brings values, [place in the list].
  void complete_listed(Index n, std::span<const Index> listed, void* values,
                       std::size_t bytes_per_value) const;

  /// Calls use(i, value) for all i < n in ascending order on all ranks, with value = make(i) of the
  /// rank whose rows have i. Makes those of a chunk at a time.
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

  /// parallel_sum() with the same bits, of which each rank does the chunks of its rows.
  template <class T, class F>
  T sum(Index n, T zero, F&& f) const {
    return sum_of_own(n, zero, f,
                      [&](T* sums) { complete_items(chunk_count(n), sums, sizeof(T)); });
  }
  /// The same for those only that may have rows.
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

  int place_ = even;  // or the rank that has all, or each
};

inline constexpr Division evenly{};

/// Of bodies with so many rows each. A small body, of at most half of what a rank has, is
/// whole: its exchanges would cost more than its rows. As many are as leave no rank with more than
/// 5 % over its share, neighbours among them on the same rank.
std::vector<Division> divide(std::span<const Index> rows);

/// What each rank says, [rank].
template <class T>
std::vector<T> said_by_ranks(const T& mine) {
  std::vector<T> all(static_cast<std::size_t>(ranks().size()), mine);
  evenly.complete_items(ranks().size(), all.data(), sizeof(T));
  return all;
}

/// Calls f(k) for the items k of this rank out of n; what record(k) then says of each, a copy of
/// memory, is handed to others by take(k, record).
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

/// The same for rows out of n, which are listed in ascending order: of each rank its own. f(row),
/// record(row) and take(row, record).
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
