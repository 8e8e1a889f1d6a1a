// SPDX-License-Identifier: BSD-3-Clause
// Artificial inertia for the dynamic relaxation of thin bodies, chosen so that few steps are
// needed.
#pragma once
#include "solve/system.hpp"

#include <memory>
#include <vector>

namespace meniscus {

/// The artificial inertia (quasi-statics note 9). Let m be the masses of the particles, rho their
/// density, and L the Laplacian of linear elements. For each component separately,
///   M^-1 = B [m/2 + rho L/(2 k^2)]^-1 B^t,   k = 2 pi/extent,
/// where B is an approximate inverse of the transform from coefficients to positions. Waves as long
/// as the body move about as with their real mass. No mode is much faster than sqrt(2) c k, with
/// the speed of sound c, however thin the wall is. A body without momentum and angular momentum
/// keeps both at zero. M is symmetric and positive. The bits are the same for any number of
/// threads.
template <int D>
class ElasticInertia {
 public:
  explicit ElasticInertia(const System<D>& system);
  ~ElasticInertia();

  /// z = M^-1 r, for all bodies.
  void solve(const NodalVectors& r, NodalVectors& z) const;

 private:
  class OfBody;
  std::vector<std::unique_ptr<OfBody>> bodies_;
};

/// The longest stable step of central differences with this inertia. It is found by power iteration
/// on differences of the force.
template <int D>
class ElasticStep {
 public:
  /// Steps are `safety` times the stable step.
  ElasticStep(System<D>& system, Real safety);

  /// The step at a state that has its forces. Computes it again if it may have changed by 2 %.
  Real at_state(const ElasticInertia<D>& inertia, const State& state);
  /// Forces a new computation before the next step.
  void doubt() { next_ = 0; }
  /// Number of force evaluations so far.
  std::int64_t evaluations() const { return evaluations_; }

  void archive(const Archive& a);

 private:
  /// Iterates until the stiffness has converged, at most `most` times.
  void iterate(const ElasticInertia<D>& inertia, const State& state, int most);

  System<D>& system_;
  Real safety_, spacing_;
  NodalVectors mode_, momentum_, trial_, force_;
  Real stiffness_ = 0;  ///< squared frequency of the fastest mode; 0: unknown
  Real interval_ = 0;   ///< steps from one estimate to the next
  std::int64_t next_ = 0, evaluations_ = 0;
};

/// True if relaxation uses this inertia for a system: 3D, only thin elastic bodies, without held
/// faces, contacts or fluids. (In 2D steps are cheap.)
template <int D>
bool is_thin_and_elastic(const System<D>& system, const std::vector<bool>& fluid);

}  // namespace meniscus
