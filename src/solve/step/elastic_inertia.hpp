// SPDX-License-Identifier: BSD-3-Clause
// The inertia of thin bodies in dynamic relaxation: chosen for few steps, not that of their mass.
#pragma once
#include "solve/system.hpp"

#include <memory>
#include <vector>

namespace meniscus {

/// (quasi-statics note 9) With the masses m of the particles, their density rho and the Laplacian L
/// of linear elements, for each component by itself,
///   M^-1 = B [m/2 + rho L/(2 k^2)]^-1 B^t,   k = 2 pi/extent,
/// where B is about the inverse of the transform to places: waves as long as the body move about as
/// by their mass, and with sound of speed c no mode is much faster than sqrt(2) c k, however thin
/// the wall. Neither sum M v nor sum M v x place comes into a body that has none. Symmetric,
/// positive; the same bits for any number of threads.
template <int D>
class ElasticInertia {
 public:
  explicit ElasticInertia(const System<D>& system);
  ~ElasticInertia();

  /// z = M^-1 r
  void solve(const NodalVectors& r, NodalVectors& z) const;

 private:
  class OfBody;
  std::vector<std::unique_ptr<OfBody>> bodies_;
};

/// The longest stable step of central differences with that inertia, by power iteration on
/// differences of the force.
template <int D>
class ElasticStep {
 public:
  /// Steps are `safety` times the limit.
  ElasticStep(System<D>& system, Real safety);

  /// At a state that has its forces: found anew where the limit may have changed by 2 %.
  Real at_state(const ElasticInertia<D>& inertia, const State& state);
  /// Finds it anew before the next step.
  void doubt() { next_ = 0; }
  /// Forces that it took so far.
  std::int64_t evaluations() const { return evaluations_; }

  void archive(const Archive& a);

 private:
  /// Iterates until the stiffness settles, `most` times at most.
  void iterate(const ElasticInertia<D>& inertia, const State& state, int most);

  System<D>& system_;
  Real safety_, spacing_;
  NodalVectors mode_, momentum_, trial_, force_;
  Real stiffness_ = 0;  ///< squared frequency of the fastest mode; 0: unknown
  Real interval_ = 0;   ///< steps from one estimate to the next
  std::int64_t next_ = 0, evaluations_ = 0;
};

/// Whether relaxation gives a system that inertia: thin elastic bodies in space alone, with nothing
/// that holds, touches or flows. (In the plane steps are cheap.)
template <int D>
bool is_thin_and_elastic(const System<D>& system, const std::vector<bool>& fluid);

}  // namespace meniscus
