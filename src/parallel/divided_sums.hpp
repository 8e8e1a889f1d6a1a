// SPDX-License-Identifier: BSD-3-Clause
// The chunks of a set of rows divided between the ranks, and the exchange of their sums. A rank
// computes the rows of some chunks and adds up the chunk sums over some particles (scaling note 2).
#pragma once
#include "parallel/aligned.hpp"
#include "parallel/divided.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace meniscus {

/// A chunk of rows with its sums: one sum for each particle that the rows touch, in ascending
/// order.
struct RowChunk {
  int number;
  Index begin, end;    ///< rows
  Index sum, sum_end;  ///< range of its sums among the sums of this rank
};

/// A sum of a chunk and the particle whose force it contributes to.
struct ChunkSum {
  Index particle, sum;
};

class DividedSums {
 public:
  /// `chunks` has all chunks with rows, in ascending order. `touched` has the particles of their
  /// sums and `start` the begins of the compressed rows; both are read for chunks of this rank
  /// only.
  DividedSums(std::vector<RowChunk> chunks, std::span<const Index> touched,
              std::span<const Offset> start, Index particles, const Division& division);

  /// The chunks whose rows this rank computes.
  const std::vector<RowChunk>& own() const { return own_; }
  /// The sums of forces on the particles of this rank, in ascending order of chunks.
  const std::vector<ChunkSum>& summed() const { return summed_; }
  ItemRange summed_particles() const {
    return {at(border_, ranks().rank()), at(border_, ranks().rank() + 1)};
  }
  /// Number of sums that this rank stores: of its own chunks and of chunks it receives.
  Index size() const { return size_; }
  /// Number of (row, particle) pairs of all ranks.
  Offset pairs() const { return pairs_; }

  /// Receives the sums of other ranks over particles of this rank.
  void bring_sums(NodalVectors& sums) const {
    chunk_sums_->bring(sums.data(), sums.data(), sizeof(NodalVector));
  }
  /// Marks the particles that the rows of this rank touch.
  void mark_touched(std::span<std::uint8_t> particles) const;
  /// Marks the particles over which this rank adds up chunk_sums.
  void mark_summed(std::span<std::uint8_t> particles) const;

 private:
  /// The particles that the rows of a chunk touch, [chunk].
  using Touched = std::vector<std::vector<Index>>;

  Touched touched_by_chunks(const std::vector<RowChunk>& chunks, std::span<const Index> touched,
                            std::span<const Offset> start, const Division& division);
  void exchange_of_sums(const std::vector<RowChunk>& chunks, const Touched& touched);
  void remember_touched(const Touched& touched);

  std::vector<int> rank_;      // rank that computes a chunk, [chunk]
  std::vector<Index> border_;  // first particle of each rank, and the number of particles
  std::vector<RowChunk> own_;
  std::vector<ChunkSum> summed_;
  Index size_ = 0;
  Offset pairs_ = 0;
  std::vector<std::uint8_t> touched_;  // 1 if the rows of this rank touch it, [particle]
  std::unique_ptr<Exchange> chunk_sums_;
};

}  // namespace meniscus
