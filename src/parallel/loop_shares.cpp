// SPDX-License-Identifier: BSD-3-Clause
// Threads take parts of a loop from their own share, then from others.
#include "parallel/loop_shares.hpp"

#include <omp.h>

#include <algorithm>

namespace meniscus {
namespace {

using Parts = std::uint64_t;

Parts packed(std::uint32_t next, std::uint32_t end) {
  return Parts{end} << 32 | next;
}
std::uint32_t next_of(Parts parts) {
  return static_cast<std::uint32_t>(parts);
}
std::uint32_t end_of(Parts parts) {
  return static_cast<std::uint32_t>(parts >> 32);
}

/// Relaxed order is enough: the data of a part are written before the loop and read after it.
Index take_first(std::atomic<Parts>& share) {
  Parts parts = share.load(std::memory_order_relaxed);
  while (next_of(parts) < end_of(parts))
    if (share.compare_exchange_weak(parts, packed(next_of(parts) + 1, end_of(parts)),
                                    std::memory_order_relaxed))
      return static_cast<Index>(next_of(parts));
  return -1;
}

Index take_last(std::atomic<Parts>& share) {
  Parts parts = share.load(std::memory_order_relaxed);
  while (next_of(parts) < end_of(parts))
    if (share.compare_exchange_weak(parts, packed(next_of(parts), end_of(parts) - 1),
                                    std::memory_order_relaxed))
      return static_cast<Index>(end_of(parts) - 1);
  return -1;
}

}  // namespace

LoopShares::LoopShares(Index parts) : count_(std::clamp(omp_get_max_threads(), 1, most)) {
  const auto begin = [&](int share) {
    return static_cast<std::uint32_t>(static_cast<Offset>(parts) * share / count_);
  };
  for (int k = 0; k < count_; ++k)
    shares_[k].parts.store(packed(begin(k), begin(k + 1)), std::memory_order_relaxed);
}

Index LoopShares::take() {
  const int own = omp_get_thread_num() % count_;
  Index part = take_first(shares_[own].parts);
  for (int k = 1; part < 0 && k < count_; ++k) part = take_last(shares_[(own + k) % count_].parts);
  return part;
}

}  // namespace meniscus
