// SPDX-License-Identifier: BSD-3-Clause
// Which rank looks at which particles of all bodies, in sums over them and for the others.
#pragma once
#include "meniscus/core/shared_items.hpp"

#include <span>
#include <vector>

namespace meniscus {

/// The chunks of sums over all particles, each with one owner: the rank that has the row in the
/// middle of the chunk if the body has a row for each particle. So of each body a rank owns about
/// the part over which it also adds up windows.
class ParticleOwners {
 public:
  /// Of n particles; `first`: those with which bodies begin, in ascending order; `division`: of
  /// their rows. All ranks call this.
  ParticleOwners(Index n, std::vector<Index> first, std::vector<Division> division);

  Index particles() const { return n_; }
  int owner(Index A) const;
  /// The rank that adds up the windows over a particle.
  int adds_up(Index A) const;
  /// Neighbouring particles of this rank, in ascending order.
  std::span<const OwnItems> own() const { return own_; }
  /// Chunks of sums over all particles.
  std::span<const Index> own_chunks() const { return own_chunks_; }

  // Bring what their owners have of so many bytes, [chunk] and [particle]. All ranks call these.
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
  mutable SharedItems chunks_;  // what they are sorted in changes
};

}  // namespace meniscus
