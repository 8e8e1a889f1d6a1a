// SPDX-License-Identifier: BSD-3-Clause
// Adding up forces from rows on several threads and ranks with the same bits for any number of
// them: row chunks, as many as their number asks for, each with its own window of particles, summed
// in ascending order (performance note 5, scaling note 2).
#pragma once
#include "meniscus/approx/shared_windows.hpp"
#include "meniscus/core/aligned.hpp"
#include "meniscus/core/parallel.hpp"

#include <memory>
#include <span>
#include <vector>

namespace meniscus {

/// The chunks of a set of rows, each with the sums of the particles that its rows touch.
class ForceWindows {
 public:
  ForceWindows() = default;
  /// Windows for compressed rows. All ranks make them of the same number of rows, of which each has
  /// those of its own chunks at least (own_rows()).
  ForceWindows(std::span<const Offset> start, std::span<const Index> particle, Index particles);

  /// Calls work(chunk, begin row, end row, window) for each chunk of this rank; window[A] += ... is
  /// allowed for the particles A of those rows. Then adds all windows to `force`, which is the same
  /// on all ranks before and after (while a halo is entered, on those that follow a particle), and
  /// completes what work has written per chunk.
  template <class F, class... T>
  void accumulate(std::span<NodalVector> force, F&& work, PerChunk<T>&... results) {
    parallel_for(
        static_cast<Index>(own_.size()),
        [&](Index c) {
          const WindowChunk& chunk = at(own_, c);
          NodalVector* sum = sums_.data() + chunk.sum;
          std::fill(sum, sum + (chunk.high - chunk.low), Lanes::zero());
          work(chunk.number, chunk.begin, chunk.end, sum - chunk.low);
        },
        1);
    if (shared_) shared_->bring_windows(sums_);
    add_to(force);
    if (shared_) {
      shared_->spread_forces(force);
      if constexpr (sizeof...(T) > 0) shared_->spread_results(results...);
    }
  }

  /// Of SharedWindows, in a run of several ranks.
  void mark_touched(std::span<std::uint8_t> particles) const { shared_->mark_touched(particles); }
  void mark_summed(std::span<std::uint8_t> particles) const { shared_->mark_summed(particles); }
  void keep_to(std::shared_ptr<const Halo> halo, Index first) {
    shared_->keep_to(std::move(halo), first);
  }

  /// All chunk numbers are below this.
  int chunks() const { return chunks_; }
  /// Pairs of the rows of all ranks and particles.
  Offset pairs() const { return pairs_; }
  std::size_t bytes() const { return sums_.size() * sizeof(Lanes); }

 private:
  void add_to(std::span<NodalVector> force) const;

  int chunks_ = 0;
  Offset pairs_ = 0;
  std::vector<WindowChunk> own_;     // whose rows this rank does
  std::vector<WindowChunk> summed_;  // windows over this rank's particles, ascending
  NodalVectors sums_;
  std::shared_ptr<SharedWindows> shared_;  // null: there are no other ranks
};

}  // namespace meniscus
