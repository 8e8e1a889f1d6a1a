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

void complete_items(Index n, void* values, std::size_t bytes_per_value) {
  if (n > 0) exchange_of(n).bring(values, values, bytes_per_value);
}

}  // namespace meniscus
