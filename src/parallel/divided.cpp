// SPDX-License-Identifier: BSD-3-Clause
// Items and rows divided between the ranks, and their exchange.
#include "parallel/divided.hpp"

#include <algorithm>
#include <numeric>

namespace meniscus {

/// Gathers values: rank r provides those from first(r) to first(r + 1) - 1.
template <class First>
void Division::complete(void* values, std::size_t bytes_per_value, First&& first) const {
  if (ranks().alone() || is_to_each()) return;
  thread_local std::vector<std::size_t> begin;
  begin.clear();
  for (int rank = 0; rank <= ranks().size(); ++rank)
    begin.push_back(static_cast<std::size_t>(first(rank)) * bytes_per_value);
  ranks().gather(values, begin);
}

Index Division::first_item(Index n, int rank) const {
  if (place_ != even) return rank > only_rank() ? n : 0;
  return static_cast<Index>(static_cast<Offset>(n) * rank / ranks().size());
}

OwnItems Division::own_items(Index n) const {
  return {first_item(n, ranks().rank()), first_item(n, ranks().rank() + 1)};
}

int Division::rank_of_item(Index n, Index item) const {
  if (place_ != even) return only_rank();
  auto rank = static_cast<int>(static_cast<Offset>(item) * ranks().size() / n);
  while (item >= first_item(n, rank + 1)) ++rank;
  return rank;
}

void Division::complete_items(Index n, void* values, std::size_t bytes_per_value) const {
  complete(values, bytes_per_value, [&](int rank) { return first_item(n, rank); });
}

Index Division::first_row(Index n, int rank) const {
  return chunk_begin(n, first_item(chunk_count(n), rank));
}

OwnItems Division::own_rows(Index n) const {
  return {first_row(n, ranks().rank()), first_row(n, ranks().rank() + 1)};
}

int Division::rank_of_row(Index n, Index row) const {
  if (place_ != even) return only_rank();
  auto chunk = static_cast<int>(static_cast<Offset>(row) * chunk_count(n) / n);
  while (row >= chunk_begin(n, chunk + 1)) ++chunk;
  return rank_of_item(chunk_count(n), chunk);
}

void Division::complete_rows(Index n, void* values, std::size_t bytes_per_value) const {
  complete(values, bytes_per_value, [&](int rank) { return first_row(n, rank); });
}

Portions Division::items(Index n) const {
  return {*this, Portions::Of::items, n};
}

Portions Division::rows(Index n) const {
  return {*this, Portions::Of::rows, n};
}

Portions Division::listed(Index n, std::span<const Index> list) const {
  return {*this, Portions::Of::list, n, list};
}

Index Portions::first(int rank) const {
  if (kind_ == Of::items) return division_.first_item(n_, rank);
  const Index row = division_.first_row(n_, rank);
  if (kind_ == Of::rows) return row;
  return static_cast<Index>(std::lower_bound(list_.begin(), list_.end(), row) - list_.begin());
}

namespace {

/// Places bodies with up to `largest` rows on one rank each and divides the others evenly. Returns
/// the rows of the rank with most of them, relative to an even share.
Real place_whole(std::span<const Index> rows, Index largest, std::vector<Division>& divisions) {
  const int size = ranks().size();
  Offset small = 0, all = 0;
  for (const Index n : rows) {
    all += n;
    if (n <= largest) small += n;
  }
  std::vector<Real> load(static_cast<std::size_t>(size), static_cast<Real>(all - small) / size);
  Offset before = 0;
  for (std::size_t b = 0; b < rows.size(); ++b) {
    divisions[b] = evenly;
    if (rows[b] > largest) continue;
    const auto rank = static_cast<int>((2 * before + rows[b]) * size / (2 * small));
    divisions[b] = Division(rank);
    at(load, rank) += rows[b];
    before += rows[b];
  }
  return *std::max_element(load.begin(), load.end()) * size / static_cast<Real>(all);
}

}  // namespace

std::vector<Division> divide(std::span<const Index> rows) {
  std::vector<Division> divisions(rows.size());
  if (ranks().alone()) return divisions;
  constexpr Real bearable = 1.05;
  const Offset all = std::accumulate(rows.begin(), rows.end(), Offset{0});
  Index largest = static_cast<Index>(all / (2 * ranks().size()));
  while (largest > 0 && place_whole(rows, largest, divisions) > bearable) {
    // Divide the largest of the bodies evenly, too.
    Index next = 0;
    for (const Index n : rows)
      if (n <= largest) next = std::max(next, n);
    largest = next - 1;
  }
  if (largest <= 0) divisions.assign(rows.size(), evenly);
  return divisions;
}

}  // namespace meniscus
