// SPDX-License-Identifier: BSD-3-Clause
// A preconditioner for the tangent of elastic bodies: linear elements on their own grids.
#pragma once
#include "solve/newton/implicit_euler.hpp"

#include <memory>
#include <vector>

namespace meniscus {

/// Isotropic moduli of small strains.
struct ElasticModuli {
  Real shear = 0, lame = 0;  ///< mu, lambda
};

/// (quasi-statics note 3) P = T^t K T for each body: T_AB = N_B(X_A) takes coefficients to places,
/// K is the stiffness of trilinear (2D: bilinear) elements, fully integrated, whose nodes are the
/// particles. Coefficients are not places: K alone takes modes in which coefficients move and
/// places hardly do for stiff ones. T is shifted a little from where it is singular. Bodies do not
/// know of each other in P.
template <int D>
class ElementPreconditioner {
 public:
  /// Moduli are those of the strain energy of each body in its reference. In a `step` viscosity is
  /// added to them and inertia to K, whose elements are then at the places where the step begins.
  /// Throws SolveError where a body has no stiffness.
  explicit ElementPreconditioner(System<D>& system, const ImplicitEuler<D>* step = nullptr);
  ~ElementPreconditioner();

  /// For another step.
  void renew(System<D>& system, const ImplicitEuler<D>* step);

  /// z = P^-1 r; symmetric and positive. The same bits for any number of threads.
  void apply(const NodalVectors& r, NodalVectors& z) const;

  const ElasticModuli& moduli(std::size_t body) const { return at(moduli_, body); }
  /// A force per displacement: the sum of mu times the cube root of the volume (2D: mu).
  Real stiffness_scale() const { return stiffness_scale_; }
  /// An energy of the size of strains of one: the sum of mu times the volume.
  Real energy_scale() const { return energy_scale_; }

 private:
  class OfBody;
  std::vector<ElasticModuli> moduli_;
  std::vector<std::unique_ptr<OfBody>> bodies_;
  Real energy_scale_ = 0, stiffness_scale_ = 0;
};

/// Of the strain energy of a body in its reference, by its tangent along uniform strains: the mean
/// over the body and, of the shear modulus, over the planes of the axes. `rate`: of strains that
/// come with them, per strain, so that viscosity counts.
template <int D>
ElasticModuli elastic_moduli(System<D>& system, const Body<D>& body, Real rate = 0);

}  // namespace meniscus
