// SPDX-License-Identifier: BSD-3-Clause
// Assembly of forces from rows on several threads and ranks, with the same bits for any number of
// them. Rows are divided into chunks, whose number depends on the number of rows only. Each chunk
// has its own sums for the particles that its rows touch. The sums are added to the
// forces in ascending order of chunks (performance note 5, scaling note 2).
#pragma once
#include "parallel/aligned.hpp"
#include "parallel/divided_sums.hpp"
#include "parallel/parallel.hpp"
#include "parallel/thread_sums.hpp"

#include <memory>
#include <span>
#include <vector>

namespace meniscus {

/// The chunks of a set of rows, each with sums for the particles that its rows touch.
class ChunkSums {
 public:
  ChunkSums() = default;
  /// Makes the sums of compressed rows. All ranks call this with the same number of rows. Each
  /// rank needs the entries of the rows of its own chunks (Division::own_rows()); others may be
  /// empty.
  ChunkSums(std::span<const Offset> start, std::span<const Index> particle, Index particles,
            const Division& division);

  /// Calls work(chunk, begin row, end row, sums) for each chunk of this rank; `work` may add to
  /// sums[A] for the particles A of those rows. Then the sums of all chunks are added to `force`,
  /// which must be the same on all ranks before and is so after. While a halo is entered, a
  /// particle gets its force only on the rank that adds up its chunk_sums, until Halo::spread().
  template <class F>
  void accumulate(std::span<NodalVector> force, F&& work) {
    parallel_for(
        static_cast<Index>(own_.size()),
        [&](Index c) {
          const RowChunk& chunk = at(own_, c);
          NodalVector* const sums = thread_sums(particles_);
          for (Index s = chunk.sum; s < chunk.sum_end; ++s) sums[at(touched_, s)] = Lanes::zero();
          work(chunk.number, chunk.begin, chunk.end, sums);
          for (Index s = chunk.sum; s < chunk.sum_end; ++s) at(sums_, s) = sums[at(touched_, s)];
        },
        1);
    if (shared_) shared_->bring_sums(sums_);
    add_to(force);
    if (shared_) shared_->spread_forces(force);
  }

  /// Forwarded to DividedSums; only for runs on several ranks.
  void mark_touched(std::span<std::uint8_t> particles) const { shared_->mark_touched(particles); }
  void mark_summed(std::span<std::uint8_t> particles) const { shared_->mark_summed(particles); }
  void keep_to(std::shared_ptr<const Halo> halo) { shared_->keep_to(std::move(halo)); }

  /// Number of chunks, including chunks without rows.
  int chunks() const { return chunks_; }
  const Division& division() const { return division_; }
  /// Number of (row, particle) pairs in the rows of all ranks.
  Offset pairs() const { return pairs_; }
  /// Number of sums of chunks that this rank adds to forces.
  std::size_t sums() const { return sum_of_particle_.size(); }
  std::size_t bytes() const {
    return sums_.size() * sizeof(NodalVector) +
           (touched_.size() + sum_start_.size() + sum_of_particle_.size()) * sizeof(Index);
  }

 private:
  void find_touched(std::span<const Offset> start, std::span<const Index> particle);
  void order_by_particle(const std::vector<ChunkSum>& sums, ItemRange particles);
  void add_to(std::span<NodalVector> force) const;

  Division division_;
  int chunks_ = 0;
  Index particles_ = 0;
  Offset pairs_ = 0;
  std::vector<RowChunk> own_;           // chunks whose rows this rank computes
  std::vector<Index> touched_;          // particle of each sum of own chunks, [sum]
  ItemRange summed_{0, 0};              // particles whose sums this rank adds up
  std::vector<Index> sum_start_;        // [particle of summed_ + 1]
  std::vector<Index> sum_of_particle_;  // numbers of sums, ascending chunks for each particle
  NodalVectors sums_;
  std::shared_ptr<DividedSums> shared_;  // null on a single rank
};

}  // namespace meniscus
