// SPDX-License-Identifier: BSD-3-Clause
// How long dynamic relaxation is expected to take, from a motion of few unknowns.
#pragma once
#include "solve/free_motions.hpp"
#include "solve/linear/held_preconditioner.hpp"
#include "solve/step/relaxation.hpp"

namespace meniscus {

/// The motion of a system in a few shapes, those in which the loads move it: Lanczos vectors of its
/// masses and the inverse of its tangent at the start, from the change of the state that its ramps
/// and its forces ask for.
template <int D>
class WayToRest {
 public:
  /// `loaded`: the time from which on loads are those of the end. Terms have a potential.
  WayToRest(System<D>& system, const HeldPreconditioner<D>& P, const State& state, Real loaded);

  /// The time at which Relaxation ends with these tolerances, by steps `dt`: its damping and its
  /// windows, of `fewest_steps` at least, on the shapes. None if forces cannot be evaluated, if a
  /// shape has no stiffness, or if it does not end.
  std::optional<Real> time(const typename Relaxation<D>::Tolerances&, Real dt,
                           int fewest_steps) const;

 private:
  static constexpr std::size_t most_shapes = 4;
  using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1, 0, static_cast<int>(most_shapes), 1>;
  using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic, 0,
                               static_cast<int>(most_shapes), most_shapes>;

  Real mass_product(const NodalVectors& a, const NodalVectors& b) const;
  NodalVectors forces_for(const NodalVectors& acceleration) const;
  /// The force against a displacement.
  NodalVectors stiff_force(const Motion&, const NodalVectors& w) const;
  /// The displacement at which that is r, about.
  NodalVectors inverse(const Motion&, NodalVectors r) const;
  /// Lanczos vectors that begin with w.
  void find_shapes(const Motion&, NodalVectors w);
  void find_uncancelled(const Motion& motion);
  /// The largest displacement of a sum of shapes over the extent of its body.
  Real largest_change(const Vector& q) const;
  /// Sum of the lengths of the forces that give the shapes these accelerations.
  Real sum_of_forces(const Vector& acceleration) const;

  System<D>& system_;
  const HeldPreconditioner<D>& P_;
  FreeMotions<D> free_;
  Real begin_, loaded_;
  bool known_ = false;          ///< what forces are
  bool without_loads_ = false;  ///< at the end: bodies come to rest in their reference
  std::vector<NodalVectors> shapes_, places_;  ///< coefficients, and where these move particles
  Matrix stiffness_;
  Vector rest_, speed_;  ///< where the loads of the end bring the shapes; how fast they move
  Real uncancelled_ = 0;
};

}  // namespace meniscus
