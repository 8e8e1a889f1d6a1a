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

/// Thrown on all ranks if a step in a halo needs the motion of particles outside of it. The caller
/// takes the step back, calls leave() and repeats the step.
struct HaloOutgrown {};

/// True if `halo` is not null and entered.
inline bool is_entered(const std::shared_ptr<const Halo>& halo) {
  return halo && halo->is_entered();
}

/// Calls f(begin, end) on all threads for ranges of the n particles; in a halo, of the followed
/// ones.
template <class F>
void for_particles(const std::shared_ptr<const Halo>& halo, Index n, F&& f) {
  if (is_entered(halo)) return halo->for_particles(f);
  sweep(n, f);
}

/// Sum of f(A) over a part of n particles, added in the order of the chunks of all n. In a halo
/// each rank adds up the chunks that it owns, then sums are gathered.
template <class T, class F>
T sum_over_part(const std::shared_ptr<const Halo>& halo, Index n, ItemRange part, T zero, F&& f) {
  const ParticleOwners* owners = is_entered(halo) ? &halo->owners() : nullptr;
  return sum_by_chunks<Cost::little>(
      n, part, zero, f, owners ? static_cast<Index>(owners->own_chunks().size()) : chunk_count(n),
      [&](Index k) { return owners ? at(owners->own_chunks(), k) : k; },
      [&](T* sums) {
        if (owners) owners->complete_chunks(sums, sizeof(T));
      });
}

/// parallel_sum() over n particles with the same bits; in a halo each rank adds up its own chunks.
template <class T, class F>
T sum_over_particles(const std::shared_ptr<const Halo>& halo, Index n, T zero, F&& f) {
  return is_entered(halo) ? sum_over_part(halo, n, {0, n}, zero, f)
                          : parallel_sum<Cost::little>(n, zero, f);
}

}  // namespace meniscus
