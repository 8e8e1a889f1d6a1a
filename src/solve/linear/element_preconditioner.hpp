// SPDX-License-Identifier: BSD-3-Clause
// A preconditioner for the tangent of elastic bodies: linear elements on the grids of the bodies.
#pragma once
#include "solve/newton/implicit_euler.hpp"

#include <memory>
#include <vector>

namespace meniscus {

/// Moduli of isotropic linear elasticity.
struct ElasticModuli {
  Real shear = 0, lame = 0;  ///< mu, lambda
};

/// The preconditioner P = T^t K T of each body (quasi-statics note 3). T_AB = N_B(X_A) is the
/// transform from coefficients to displacements of particles. K is the stiffness of fully
/// integrated trilinear (2D: bilinear) elements, whose nodes are the particles. K alone would be
/// too stiff for modes in which coefficients change but particles hardly move. T is nearly singular
/// for these modes and is shifted a little. P does not couple different bodies.
template <int D>
class ElementPreconditioner {
 public:
  /// Takes the moduli from the strain energy of each body in its reference. With a `step` of
  /// implicit Euler, viscosity is added to the moduli and inertia to K, and the elements are at
  /// their positions at the begin of the step. Throws SolveError if a body has no stiffness.
  explicit ElementPreconditioner(System<D>& system, const ImplicitEuler<D>* step = nullptr);
  ~ElementPreconditioner();

  /// Computes the preconditioner again for another step.
  void renew(System<D>& system, const ImplicitEuler<D>* step);

  /// z = P^-1 r. P is symmetric and positive; the bits do not depend on the number of threads.
  void apply(const NodalVectors& r, NodalVectors& z) const;

  const ElasticModuli& moduli(std::size_t body) const { return at(moduli_, body); }
  /// A typical force per displacement: the sum of mu times the cube root of the volume (2D: mu).
  Real stiffness_scale() const { return stiffness_scale_; }
  /// The energy of strains of order one: the sum of mu times the volume.
  Real energy_scale() const { return energy_scale_; }

 private:
  class OfBody;
  std::vector<ElasticModuli> moduli_;
  std::vector<std::unique_ptr<OfBody>> bodies_;
  Real energy_scale_ = 0, stiffness_scale_ = 0;
};

/// Moduli of a body in its reference, from the tangent of its strain energy for uniform strains.
/// They are means over the body, and the shear modulus is also a mean over the coordinate planes.
/// `rate` is the strain rate per strain; if it is not zero, viscosity contributes to the moduli.
template <int D>
ElasticModuli elastic_moduli(System<D>& system, const Body<D>& body, Real rate = 0);

}  // namespace meniscus
