// SPDX-License-Identifier: BSD-3-Clause
// Assembly of forces from rows on several threads and ranks, with the same bits for any number of
// them. Rows are divided into chunks, whose number depends on the number of rows only. Each chunk
// has its own sums for the particles that its rows touch. The sums are added to the
// forces in ascending order of chunks (performance note 5, scaling note 2).
#pragma once
#include "parallel/aligned.hpp"
#include "parallel/divided_sums.hpp"
#include "parallel/gathered.hpp"
#include "parallel/parallel.hpp"
#include "parallel/thread_sums.hpp"

#include <memory>
#include <span>
#include <vector>

namespace meniscus {

class ChunkSums;

/// Sums of chunks that are not yet added to forces. The sums of all terms are exchanged and added
/// together, after all rows.
class PendingSums {
 public:
  /// Exchanges all pending sums and adds them to their forces. All ranks call this.
  void complete();
  /// Forgets sums that an exception has left.
  void forget();

 private:
  friend class ChunkSums;
  std::vector<ChunkSums*> waiting_;
};

/// Forces on particles, and where sums of chunks wait to be added to them.
struct ForceVector : std::span<NodalVector> {
  ForceVector(std::span<NodalVector> force, PendingSums* waiting = nullptr)
      : std::span<NodalVector>(force), pending(waiting) {}
  ForceVector(NodalVectors& force) : std::span<NodalVector>(force) {}

  PendingSums* pending = nullptr;  ///< null: sums are added at once

  /// The forces on `count` particles from `first` on.
  ForceVector part(Index first, Index count) const {
    return {subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(count)), pending};
  }
};

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
  /// sums[A] for the particles A of those rows. The sums of all chunks are added to `force` later,
  /// by PendingSums::complete(), or at once if it is not given. A rank gets the forces on the
  /// particles over which it adds up chunk sums.
  template <class F>
  void accumulate(const ForceVector& force, F&& work) {
    complete_others(force);
    parallel_for(
        static_cast<Index>(own_.size()),
        [&](Index c) {
          const RowChunk& chunk = at(own_, c);
          NodalVector* const sums = thread_sums(particles_);
          for (Index s = chunk.sum; s < chunk.sum_end; ++s)
            sums[at(touched_, s)] = is_pending_ ? at(sums_, s) : Lanes::zero();
          work(chunk.number, chunk.begin, chunk.end, sums);
          for (Index s = chunk.sum; s < chunk.sum_end; ++s) at(sums_, s) = sums[at(touched_, s)];
        },
        1);
    leave(force);
  }

  /// An array with `values_per_row` values for each of n rows. Each rank has computed its rows.
  template <class T>
  Gathered gathered(Index n, T* values, std::size_t values_per_row = 1) const {
    return {values, division_.rows(n), values_per_row};
  }
  /// Calls f(chunk, begin row, end row) for each chunk of this rank, on all threads.
  template <class F>
  void for_own_chunks(F&& f) const {
    parallel_for(
        static_cast<Index>(own_.size()),
        [&](Index c) { f(at(own_, c).number, at(own_, c).begin, at(own_, c).end); }, 1);
  }

  /// Forwarded to DividedSums; only for runs on several ranks.
  void mark_touched(std::span<std::uint8_t> particles) const { shared_->mark_touched(particles); }
  void mark_summed(std::span<std::uint8_t> particles) const { shared_->mark_summed(particles); }

  /// Number of chunks, including chunks without rows.
  int chunks() const { return chunks_; }
  const Division& division() const { return division_; }
  /// The rows of this rank out of n, which are divided like these rows.
  ItemRange own_rows(Index n) const { return division_.own_rows(n); }
  /// The rows of a chunk out of n, which are divided like these rows.
  static ItemRange rows_of(int chunk, Index n) {
    return {chunk_begin(n, chunk), chunk_begin(n, chunk + 1)};
  }
  /// Room for a result of each chunk.
  template <class T>
  ChunkTally<T> tally() const {
    return {chunks_, division_};
  }
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
  /// Completes pending sums, unless they are for the same forces.
  void complete_others(const ForceVector& force) {
    if (is_pending_ && (!force.pending || force.data() != force_.data())) complete();
  }
  /// Leaves the sums for later, or adds them at once.
  void leave(const ForceVector& force);
  /// Receives the sums of other ranks and adds all to force_.
  void complete();

  friend class PendingSums;

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
  bool is_pending_ = false;  // sums_ are not yet added to force_
  std::span<NodalVector> force_;
  std::shared_ptr<DividedSums> shared_;  // null on a single rank
};

}  // namespace meniscus
