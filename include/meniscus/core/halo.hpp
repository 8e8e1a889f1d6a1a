// SPDX-License-Identifier: BSD-3-Clause
// The particles that a rank follows in the steps of a run: its own and its ghosts, those of other
// ranks that its rows and sums read (scaling note 2.3).
#pragma once
#include "meniscus/core/aligned.hpp"
#include "meniscus/core/particle_owners.hpp"

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>
#include <vector>

namespace meniscus {

class Halo {
 public:
  /// `read`: which of all particles the rows of this rank read. Its own, for sums over particles,
  /// are followed anyway. All ranks call this.
  Halo(std::vector<std::uint8_t> read, ParticleOwners owners);

  /// Whether some rank follows fewer than all particles.
  bool is_partial() const { return partial_; }
  bool follows(Index A) const { return at(read_, A) != 0; }
  const ParticleOwners& owners() const { return owners_; }
  /// Of particles that are followed.
  Index size() const { return size_; }
  /// Those of them that it does not own.
  Index ghosts() const { return ghosts_; }

  /// Vectors over all particles that steps keep up, beside the motion.
  void keep(std::vector<NodalVectors*> kept) { kept_ = std::move(kept); }

  /// From now on only what is followed is right on this rank. The rest of the motion and of what is
  /// kept becomes not a number, so that it is seen if somebody reads it.
  void enter(std::initializer_list<NodalVectors*> motion);
  /// All ranks know all of these vectors again. All ranks call this.
  void leave(std::initializer_list<NodalVectors*> motion);
  /// Between the two.
  bool is_entered() const { return entered_; }

  /// Brings sums over rows, [particle], from the rank that adds them up to those that follow the
  /// particle. All ranks call this.
  void spread(std::span<NodalVector> sums) const;

  /// Calls f(begin, end) on all threads for the particles that are followed, in parts.
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

/// Thrown on all ranks where a step in a halo comes to need the motion of more than that: it has to
/// be taken back, and made again when all ranks know the state.
struct HaloOutgrown {};

/// Whether a step is made in a halo; null: there is none.
inline bool is_entered(const std::shared_ptr<const Halo>& halo) {
  return halo && halo->is_entered();
}

/// Calls f(begin, end) on all threads for n particles, in parts; in a halo for those it follows.
template <class F>
void for_particles(const std::shared_ptr<const Halo>& halo, Index n, F&& f) {
  if (is_entered(halo)) return halo->for_particles(f);
  sweep(n, f);
}

/// Sum over some of n particles, in the chunks of all; in a halo each rank looks at its own.
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

/// parallel_sum() over n particles, of which in a halo each rank knows its own.
template <class T, class F>
T sum_over_particles(const std::shared_ptr<const Halo>& halo, Index n, T zero, F&& f) {
  return is_entered(halo) ? sum_over_part(halo, n, {0, n}, zero, f)
                          : parallel_sum<Cost::little>(n, zero, f);
}

}  // namespace meniscus
