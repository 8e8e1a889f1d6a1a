// SPDX-License-Identifier: BSD-3-Clause
// Items divided evenly between the ranks, and their exchanges by the number of items.
#include "meniscus/core/divided.hpp"

#include <map>

namespace meniscus {
namespace {

Index first_item(Index n, int rank) {
  return static_cast<Index>(static_cast<Offset>(n) * rank / ranks().size());
}

Exchange& exchange_of(Index n) {
  constexpr std::size_t most = 64;  // lists of contacts have ever new lengths
  static std::map<Index, std::unique_ptr<Exchange>> known;
  if (known.size() > most) known.clear();
  std::unique_ptr<Exchange>& exchange = known[n];
  if (exchange) return *exchange;
  std::vector<Leaf> leaves;
  for (int rank = 0; rank < ranks().size(); ++rank)
    for (Index k = first_item(n, rank); k < first_item(n, rank + 1); ++k)
      if (rank != ranks().rank()) leaves.push_back({k, rank, k});
  exchange = ranks().exchange(n, leaves);
  return *exchange;
}

}  // namespace

OwnItems own_items(Index n) {
  return {first_item(n, ranks().rank()), first_item(n, ranks().rank() + 1)};
}

Index first_row(Index n, int rank) {
  return chunk_begin(n, first_item(chunk_count(n), rank));
}

int rank_of_item(Index n, Index item) {
  auto rank = static_cast<int>(static_cast<Offset>(item) * ranks().size() / n);
  while (item >= first_item(n, rank + 1)) ++rank;
  return rank;
}

OwnItems own_rows(Index n) {
  return {first_row(n, ranks().rank()), first_row(n, ranks().rank() + 1)};
}

void complete_rows(Index n, void* values, std::size_t bytes_per_value) {
  auto* bytes = static_cast<std::byte*>(values);
  for (int rank = 0; rank < ranks().size(); ++rank) {
    const std::size_t begin = static_cast<std::size_t>(first_row(n, rank)) * bytes_per_value,
                      end = static_cast<std::size_t>(first_row(n, rank + 1)) * bytes_per_value;
    ranks().hand_out(rank, bytes + begin, end - begin);
  }
}

int rank_of_row(Index n, Index row) {
  auto chunk = static_cast<int>(static_cast<Offset>(row) * chunk_count(n) / n);
  while (row >= chunk_begin(n, chunk + 1)) ++chunk;
  return rank_of_item(chunk_count(n), chunk);
}

void complete_items(Index n, void* values, std::size_t bytes_per_value) {
  if (n > 0 && !ranks().alone()) exchange_of(n).bring(values, values, bytes_per_value);
}

}  // namespace meniscus
