// SPDX-License-Identifier: BSD-3-Clause
// Which thread does which part of a loop: the same one in every loop over the same rows, as long as
// all are equally fast.
#pragma once
#include "meniscus/core/types.hpp"

#include <atomic>
#include <cstdint>

namespace meniscus {

/// The parts of a loop, in shares of neighbouring ones for the threads. Who has done its own share
/// takes from the ends of others'. What a thread has written in the loop before is in its cache,
/// and the next one finds it there.
class LoopShares {
 public:
  explicit LoopShares(Index parts);
  /// A part for the calling thread, each of them once; -1 if all are taken.
  Index take();

 private:
  /// The part that its thread takes next, and above it the one behind the last. A cache line each,
  /// since the line of another thread has to be fetched.
  struct alignas(64) Share {
    std::atomic<std::uint64_t> parts;
  };
  static constexpr int most = 64;
  int count_;
  Share shares_[most];
};

}  // namespace meniscus
