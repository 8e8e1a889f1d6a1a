// SPDX-License-Identifier: BSD-3-Clause
// The parts of a parallel loop for each thread. Loops over the same rows give a thread the same
// parts, as long as all threads are equally fast.
#pragma once
#include "numbers/types.hpp"

#include <atomic>
#include <cstdint>

namespace meniscus {

/// Portions of neighbouring parts of a loop, one share for each thread. A thread that has done its
/// share takes parts from the ends of other shares. The data that a thread wrote in the previous
/// loop are in its cache and are used by the same thread again.
class LoopShares {
 public:
  explicit LoopShares(Index parts);
  /// Returns a part for the calling thread, each part once; -1 if all are taken.
  Index take();

 private:
  /// The next part of the owner is in the low half, and one past the last part in the high half.
  /// Each share has its own cache line, so that taking from the share of another thread fetches one
  /// line only.
  struct alignas(64) Share {
    std::atomic<std::uint64_t> parts;
  };
  static constexpr int most = 64;
  int count_;
  Share shares_[most];
};

}  // namespace meniscus
