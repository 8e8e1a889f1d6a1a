// SPDX-License-Identifier: BSD-3-Clause
// The chunks of a set of rows divided between the ranks of a run, and what they exchange: a rank
// does the rows of some chunks and adds up the windows over some particles (scaling note 2).
#pragma once
#include "meniscus/core/aligned.hpp"
#include "meniscus/core/halo.hpp"

#include <span>
#include <vector>

namespace meniscus {

/// A chunk of rows and its sums, of the particles that they touch in ascending order.
struct WindowChunk {
  int number;
  Index begin, end;    ///< rows
  Index sum, sum_end;  ///< among the sums of this rank
};

/// A sum of a window and the particle it is part of the force on.
struct WindowSum {
  Index particle, sum;
};

class SharedWindows {
 public:
  /// `chunks`: all that have rows, in ascending order, of compressed rows; of the rows, and of
  /// `touched`, the particles of their sums, only those of own chunks are looked at.
  SharedWindows(std::vector<WindowChunk> chunks, std::span<const Index> touched,
                std::span<const Offset> start, Index particles, const Division& division);

  /// Those whose rows this rank does.
  const std::vector<WindowChunk>& own() const { return own_; }
  /// Sums of the forces on this rank's particles, in ascending order of chunks.
  const std::vector<WindowSum>& summed() const { return summed_; }
  ItemRange summed_particles() const {
    return {at(border_, ranks().rank()), at(border_, ranks().rank() + 1)};
  }
  /// Of the sums of all windows here.
  Index size() const { return size_; }
  /// Pairs of all rows and particles.
  Offset pairs() const { return pairs_; }

  /// Windows of the rows of other ranks.
  void bring_windows(NodalVectors& sums) const {
    windows_->bring(sums.data(), sums.data(), sizeof(NodalVector));
  }
  /// Forces on all particles that the rows touch; while a halo is entered, nothing.
  void spread_forces(std::span<NodalVector> force) const {
    if (!is_entered(halo_)) particles_->bring(force.data(), force.data(), sizeof(NodalVector));
  }
  /// Marks the particles that the rows of this rank touch.
  void mark_touched(std::span<std::uint8_t> particles) const;
  /// Marks those over which it adds up windows.
  void mark_summed(std::span<std::uint8_t> particles) const;
  /// From now on forces are spread by the halo, when it is entered, and not by these windows.
  void keep_to(std::shared_ptr<const Halo> halo) { halo_ = std::move(halo); }

 private:
  /// The particles that the rows of each chunk touch, [chunk].
  using Touched = std::vector<std::vector<Index>>;
  /// Bits of `touched_`.
  static constexpr std::uint8_t by_a_rank = 1, by_this_rank = 2;

  Touched touched_by_chunks(const std::vector<WindowChunk>& chunks, std::span<const Index> touched,
                            std::span<const Offset> start, const Division& division);
  void share_windows(const std::vector<WindowChunk>& chunks, const Touched& touched);
  void remember_touched(const Touched& touched);
  /// Forces of particles that rows touch and other ranks add up.
  std::unique_ptr<Exchange> exchange_of_forces() const;

  std::vector<int> rank_;      // that does a chunk, [chunk]
  std::vector<Index> border_;  // particle at which those of a rank begin, [rank], and their number
  std::vector<WindowChunk> own_;
  std::vector<WindowSum> summed_;
  Index size_ = 0;
  Offset pairs_ = 0;
  std::vector<std::uint8_t> touched_;  // by rows of which ranks, [particle]
  std::unique_ptr<Exchange> windows_, particles_;
  std::shared_ptr<const Halo> halo_;
};

}  // namespace meniscus
