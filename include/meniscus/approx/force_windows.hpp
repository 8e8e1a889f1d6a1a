// SPDX-License-Identifier: BSD-3-Clause
// Adding up forces from rows on several threads and ranks with the same bits for any number of
// them: row chunks, as many as their number asks for, each with its own sums for the particles that
// its rows touch, added up in ascending order (performance note 5, scaling note 2).
#pragma once
#include "meniscus/approx/shared_windows.hpp"
#include "meniscus/approx/thread_sums.hpp"
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
  /// those of its own chunks at least (Division::own_rows()).
  ForceWindows(std::span<const Offset> start, std::span<const Index> particle, Index particles,
               const Division& division);

  /// Calls work(chunk, begin row, end row, window) for each chunk of this rank; window[A] += ... is
  /// allowed for the particles A of those rows. Then adds all windows to `force`, which is the same
  /// on all ranks before and after; while a halo is entered, on the rank that adds up the sums of a
  /// particle, until Halo::spread().
  template <class F>
  void accumulate(std::span<NodalVector> force, F&& work) {
    parallel_for(
        static_cast<Index>(own_.size()),
        [&](Index c) {
          const WindowChunk& chunk = at(own_, c);
          NodalVector* const window = thread_sums(particles_);
          for (Index s = chunk.sum; s < chunk.sum_end; ++s) window[at(touched_, s)] = Lanes::zero();
          work(chunk.number, chunk.begin, chunk.end, window);
          for (Index s = chunk.sum; s < chunk.sum_end; ++s) at(sums_, s) = window[at(touched_, s)];
        },
        1);
    if (shared_) shared_->bring_windows(sums_);
    add_to(force);
    if (shared_) shared_->spread_forces(force);
  }

  /// Of SharedWindows, in a run of several ranks.
  void mark_touched(std::span<std::uint8_t> particles) const { shared_->mark_touched(particles); }
  void mark_summed(std::span<std::uint8_t> particles) const { shared_->mark_summed(particles); }
  void keep_to(std::shared_ptr<const Halo> halo) { shared_->keep_to(std::move(halo)); }

  /// Also of those without rows.
  int chunks() const { return chunks_; }
  const Division& division() const { return division_; }
  /// Pairs of the rows of all ranks and particles.
  Offset pairs() const { return pairs_; }
  /// Sums that this rank adds up.
  std::size_t sums() const { return sum_of_particle_.size(); }
  std::size_t bytes() const {
    return sums_.size() * sizeof(NodalVector) +
           (touched_.size() + sum_start_.size() + sum_of_particle_.size()) * sizeof(Index);
  }

 private:
  void find_touched(std::span<const Offset> start, std::span<const Index> particle);
  void order_by_particle(const std::vector<WindowSum>& sums, ItemRange particles);
  void add_to(std::span<NodalVector> force) const;

  Division division_;
  int chunks_ = 0;
  Index particles_ = 0;
  Offset pairs_ = 0;
  std::vector<WindowChunk> own_;        // whose rows this rank does
  std::vector<Index> touched_;          // particle of a sum of own chunks, [sum]
  ItemRange summed_{0, 0};              // particles whose sums this rank adds up
  std::vector<Index> sum_start_;        // [particle of summed_ + 1]
  std::vector<Index> sum_of_particle_;  // number of a sum, in ascending order of chunks
  NodalVectors sums_;
  std::shared_ptr<SharedWindows> shared_;  // null: there are no other ranks
};

}  // namespace meniscus
