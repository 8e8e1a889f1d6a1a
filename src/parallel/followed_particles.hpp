// SPDX-License-Identifier: BSD-3-Clause
// The particles of a system whose motion a process follows, and loops, sums and exchanges over
// them.
#pragma once
#include "parallel/halo.hpp"
#include "parallel/step_reads.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

namespace meniscus {

/// A process follows all particles, or during steps its own and its ghosts (Halo). Results have the
/// same bits in both cases.
class FollowedParticles {
 public:
  /// Follows all particles until further notice, for this reason, e.g. the name of a term.
  void follow_all(std::string reason) {
    halo_.reset();
    reason_ = std::move(reason);
  }
  /// From the next enter() on, follows the particles that are read. Follows all if some process
  /// reads all. All processes call this.
  void follow(StepReads reads, const ParticleOwners& owners);
  /// Why all particles are followed; empty if they are not.
  const std::string& reason() const { return reason_; }
  /// The own and ghost particles; null if all particles are followed.
  const Halo* halo() const { return halo_.get(); }

  /// Begins and ends steps on the followed particles, for vectors over all particles
  /// (Halo::enter(), Halo::leave()). All processes call these.
  void enter(std::initializer_list<NodalVectors*> motion) {
    if (halo_) halo_->enter(motion);
  }
  void leave(std::initializer_list<NodalVectors*> motion) {
    if (halo_) halo_->leave(motion);
  }
  /// The halo between enter() and leave(); otherwise null, and all particles are followed.
  const Halo* entered() const { return halo_ && halo_->is_entered() ? halo_.get() : nullptr; }

  /// Sends sums over rows, [particle], from the process that adds them up to all processes that
  /// follow the particle. All processes call this.
  void spread(std::span<NodalVector> sums) const { (entered() ? *halo_ : *everyone_).spread(sums); }
  /// Needed before spread(), on several processes.
  void set_owners(const ParticleOwners& owners);
  /// Completes a vector over all particles, of which each process has the followed ones.
  void complete(NodalVectors& vector) const {
    if (entered()) halo_->owners().complete(vector.data(), sizeof(NodalVector));
  }
  /// The smallest of the numbers that the processes pass, at most n.
  static Index smallest(Index n, Index mine) {
    return n - static_cast<Index>(ranks().largest(n - mine));
  }

  /// True if the motion of a particle is known.
  bool follows(Index A) const { return !entered() || halo_->follows(A); }
  /// Calls f(range) for the ranges of n particles that belong to this process.
  template <class F>
  void for_own(Index n, F&& f) const {
    if (!entered()) return f(ItemRange{0, n});
    for (const ItemRange& part : halo_->owners().own()) f(part);
  }
  /// Calls f(begin, end) on all threads for ranges of the followed ones of n particles.
  template <class F>
  void for_each(Index n, F&& f) const {
    entered() ? halo_->for_particles(f) : sweep(n, f);
  }
  /// Sum of f(A) over a part of n particles, added in the order of the chunks of all n.
  template <class T, class F>
  T sum_part(Index n, ItemRange part, T zero, F&& f) const {
    const ParticleOwners* owners = entered() ? &halo_->owners() : nullptr;
    return sum_by_chunks<Cost::little>(
        n, part, zero, f, owners ? static_cast<Index>(owners->own_chunks().size()) : chunk_count(n),
        [&](Index k) { return owners ? at(owners->own_chunks(), k) : k; },
        [&](T* sums) {
          if (owners) owners->complete_chunks(sums, sizeof(T));
        });
  }
  /// Sum of f(A) over n particles.
  template <class T, class F>
  T sum(Index n, T zero, F&& f) const {
    return sum_part(n, {0, n}, zero, f);
  }

  /// sum_A a_A . b_A
  Real dot(std::span<const NodalVector> a, std::span<const NodalVector> b) const {
    return sum(static_cast<Index>(a.size()), 0.0,
               [&](Index A) { return meniscus::sum(at(a, A) * at(b, A)); });
  }
  /// The largest length of a vector.
  Real largest(std::span<const NodalVector> w) const {
    struct Greatest {
      Real square;
      Greatest operator+(const Greatest& b) const { return {std::max(square, b.square)}; }
    };
    return std::sqrt(sum(static_cast<Index>(w.size()), Greatest{0}, [&](Index A) {
                       return Greatest{meniscus::sum(at(w, A) * at(w, A))};
                     }).square);
  }
  /// to = from; both have the same length.
  void copy(std::span<const NodalVector> from, std::span<NodalVector> to) const {
    for_each(static_cast<Index>(from.size()), [&](Index begin, Index end) {
      std::copy(from.begin() + begin, from.begin() + end, to.begin() + begin);
    });
  }

 private:
  std::shared_ptr<Halo> halo_;
  std::unique_ptr<Halo> everyone_;  // of all particles; null on one process
  std::string reason_;
};

}  // namespace meniscus
