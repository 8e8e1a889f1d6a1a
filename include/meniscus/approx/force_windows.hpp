// SPDX-License-Identifier: BSD-3-Clause
// Adding up forces from rows on several threads with the same bits for any thread count: row
// chunks, as many as their number asks for, each with its own window of particles, summed in
// ascending order (performance note 5).
#pragma once
#include "meniscus/core/aligned.hpp"
#include "meniscus/core/parallel.hpp"

#include <span>
#include <vector>

namespace meniscus {

/// The chunks of a set of rows, each with the sums of the particles that its rows touch.
class ForceWindows {
 public:
  ForceWindows() = default;
  /// Windows for compressed rows.
  ForceWindows(std::span<const Offset> start, std::span<const Index> particle, Index particles);

  /// Calls work(chunk, begin row, end row, window) for each chunk; window[A] += ... is allowed for
  /// the particles A of those rows. Then adds all windows to `force`.
  template <class F>
  void accumulate(std::span<NodalVector> force, F&& work) {
    parallel_for(
        static_cast<Index>(chunks_.size()),
        [&](Index c) {
          Chunk& chunk = at(chunks_, c);
          std::fill(chunk.sum.begin(), chunk.sum.end(), Lanes::zero());
          work(chunk.number, chunk.begin, chunk.end, chunk.sum.data() - chunk.low);
        },
        1);
    add_to(force);
  }

  /// All chunk numbers are below this.
  int chunks() const { return chunks_.empty() ? 0 : chunks_.back().number + 1; }
  std::size_t bytes() const;

 private:
  struct Chunk {
    int number;
    Index begin, end;  // rows
    Index low, high;   // particles
    NodalVectors sum;  // [particle - low]
  };
  void add_to(std::span<NodalVector> force) const;

  std::vector<Chunk> chunks_;
};

}  // namespace meniscus
