// SPDX-License-Identifier: BSD-3-Clause
// The particles whose motion a rank follows during a step: its own and its ghosts. Ghosts are
// particles of other ranks that its rows and sums read (scaling note 2.3).
#pragma once
#include "parallel/aligned.hpp"
#include "parallel/particle_owners.hpp"

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>
#include <vector>

namespace meniscus {

class Halo {
 public:
  /// `read`: 1 for each particle that the rows of this rank read, [particle]. Particles that the
  /// rank owns are added. All ranks have to call this.
  Halo(std::vector<std::uint8_t> read, ParticleOwners owners);

  /// True if some rank follows fewer than all particles.
  bool is_partial() const { return partial_; }
  bool follows(Index A) const { return at(read_, A) != 0; }
  const ParticleOwners& owners() const { return owners_; }
  /// Number of particles that this rank follows.
  Index size() const { return size_; }
  /// Number of followed particles that other ranks own.
  Index ghosts() const { return ghosts_; }

  /// Registers nodal vectors that steps update beside the motion: enter() and leave() treat them
  /// alike.
  void keep(std::vector<NodalVectors*> kept) { kept_ = std::move(kept); }

  /// Starts steps in the halo: from now on only followed particles are valid on this rank. All
  /// others become NaN in `motion` and in the vectors of keep(), so that a wrong read is noticed.
  void enter(std::initializer_list<NodalVectors*> motion);
  /// Ends steps in the halo: gathers `motion` and the vectors of keep() on all ranks. All ranks
  /// have to call this.
  void leave(std::initializer_list<NodalVectors*> motion);
  /// True between enter() and leave().
  bool is_entered() const { return entered_; }

  /// Sends the sums over rows, [particle], from the rank that adds them up to the ranks that follow
  /// the particle. All ranks have to call this.
  void spread(std::span<NodalVector> sums) const;
  /// Sets `all` to the values of all particles, given the values of the followed particles. All
  /// ranks have to call this.
  void gather(std::span<const NodalVector> followed, NodalVectors& all) const;

  /// Calls f(begin, end) on all threads for ranges of followed particles.
  template <class F>
  void for_particles(F&& f) const {
    for_parts<Cost::little>(static_cast<Index>(parts_.size()), size_,
                            [&](Index k) { f(at(parts_, k).begin, at(parts_, k).end); });
  }

 private:
  std::vector<std::uint8_t> read_;
  std::vector<OwnItems> parts_;
  std::vector<NodalVectors*> kept_;
  ParticleOwners owners_;
  std::unique_ptr<Exchange> sums_;
  Index size_ = 0, ghosts_ = 0;
  bool partial_ = false, entered_ = false;
};

}  // namespace meniscus
