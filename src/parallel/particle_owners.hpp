// SPDX-License-Identifier: BSD-3-Clause
// Owners of particles: a rank adds up the sums over particles that it owns, and sends their motion
// to the other ranks.
#pragma once
#include "parallel/shared_items.hpp"

#include <span>
#include <vector>

namespace meniscus {

/// Chunks of sums over all particles, each owned by one rank. The owner is the rank that has the
/// row in the middle of the chunk, with one row per particle. A rank so owns about the particles
/// over which it also adds up the chunk sums of forces.
class ParticleOwners {
 public:
  /// `n`: number of particles; `first`: the first particle of each body, ascending; `division`: the
  /// division of the rows of each body. All ranks have to call this.
  ParticleOwners(Index n, std::vector<Index> first, std::vector<Division> division);

  Index particles() const { return n_; }
  int owner(Index A) const;
  /// The rank that adds up the chunk sums of forces over a particle.
  int adds_up(Index A) const;
  /// The ranges of particles that this rank owns, in ascending order.
  std::span<const OwnItems> own() const { return own_; }
  /// The chunks that this rank owns and adds up, in sums over all particles.
  std::span<const Index> own_chunks() const { return own_chunks_; }

  // Gather values of `bytes_per_value` bytes, [chunk] and [particle], from their owners. All ranks
  // have to call these.
  void complete_chunks(void* values, std::size_t bytes_per_value) const {
    chunks_.complete(values, bytes_per_value);
  }
  void complete(void* values, std::size_t bytes_per_value) const;

 private:
  struct Run {
    OwnItems particles;
    int owner;
  };

  Index n_;
  std::vector<Index> first_;        // [body]
  std::vector<Division> division_;  // [body]
  std::vector<Run> runs_;
  std::vector<OwnItems> own_;
  std::vector<Index> own_chunks_;
  mutable SharedItems chunks_;  // mutable: it sorts in a buffer
};

}  // namespace meniscus
