// SPDX-License-Identifier: BSD-3-Clause
// The particles whose motion a rank reads in a step. The stepper and each force term register the
// particles that they read; the halo is made from all of them (scaling note 2.3).
#pragma once
#include "parallel/chunk_sums.hpp"
#include "parallel/halo.hpp"

#include <memory>
#include <span>
#include <vector>

namespace meniscus {

class StepReads {
 public:
  /// `particles`: number of particles of all bodies. None of them is marked as read.
  explicit StepReads(Index particles) : read_(static_cast<std::size_t>(particles), 0) {}

  /// Marks the particles that the rows of this rank touch, and the particles over which it adds up
  /// chunk sums. Both are numbered from `first` on.
  void rows(const ChunkSums& chunk_sums, Index first);
  /// Registers only the particles over which this rank adds up chunk_sums, for rows that read no
  /// motion.
  void sums(const ChunkSums& chunk_sums, Index first);
  /// Marks these particles, numbered from `first` on. They are usually the same on all ranks.
  void particles(std::span<const Index> numbers, Index first);
  /// Marks the particles begin, ..., end - 1.
  void range(Index begin, Index end);
  /// Registers a vector over all particles that steps update, for Halo::keep().
  void keeps(NodalVectors& vector) { kept_.push_back(&vector); }

  /// Makes the halo of all registered particles. Returns null if every rank reads all particles.
  /// All ranks have to call this.
  std::shared_ptr<Halo> share(ParticleOwners owners);

 private:
  std::vector<std::uint8_t> read_;  // [particle]
  std::vector<NodalVectors*> kept_;
};

}  // namespace meniscus
