// SPDX-License-Identifier: BSD-3-Clause
// Linear elastostatics with the force terms of the program: a free body in equilibrium with an
// exactly known displacement.
#pragma once
#include "body/body.hpp"
#include "physics/internal/material.hpp"

#include <memory>
#include <string>
#include <vector>

namespace meniscus::study {

/// The unit square or cube of n cells per edge h. Each coordinate of each node is moved at random
/// by up to +-`jitter` h, along the boundary too.
template <int D>
Geometry<D> unit_box_geometry(int n, Real jitter, std::uint64_t seed = 1);
/// The body of these particles; supports are enlarged where needed.
template <int D>
std::unique_ptr<Body<D>> box_of(Geometry<D> geometry, ParticleSet<D> particles);
/// The body of unit_box_geometry() with supports of 2.6 h.
template <int D>
std::unique_ptr<Body<D>> unit_box(int n, Real jitter, std::uint64_t seed = 1);

struct Moduli {
  Real mu = 1, lambda = 1;
};

template <int D>
struct ElasticCase {
  std::unique_ptr<Body<D>> body;
  SmoothMap<D> exact;  ///< displacement, with derivatives
  Moduli moduli;
  /// Nodal forces of the exact tractions and body forces, from the points of the nodal cells (RKPM
  /// note 5.3).
  NodalVectors load;
};
template <int D>
ElasticCase<D> elastic_case(std::unique_ptr<Body<D>> body, SmoothMap<D> exact, Moduli moduli);

/// A way to integrate the internal force.
struct Rule {
  std::string name;
  Integration integration;
};
/// q_scni, Gauss points 2, 3, 5 and nodal; only the first two if `brief`.
std::vector<Rule> elastic_rules(bool brief);

/// The internal force of a linear elastic body. It is a St.Venant-Kirchhoff solid with
/// displacements scaled by 2^-200, so that terms of second order vanish.
template <int D>
class LinearBody {
 public:
  LinearBody(Body<D>& body, const Integration& integration, Moduli moduli);

  /// K u
  NodalVectors stiffness_times(const NodalVectors& u);
  /// u . K u / 2
  Real energy(const NodalVectors& u);
  const ForceTerm& term() const { return *term_; }
  Index size() const { return size_; }

 private:
  Index size_;
  std::unique_ptr<ForceTerm> term_;
};

/// Rigid motions, orthonormal as vectors of coefficients.
template <int D>
std::vector<NodalVectors> rigid_modes(const Body<D>& body);

struct Solution {
  NodalVectors u;  ///< without rigid part
  int iterations;
  Real residual;  ///< |f - K u| / |f|
};
/// Solves K u = load up to a rigid motion, by conjugate gradients. Ends when the residual is below
/// `tolerance` or stops falling.
template <int D>
Solution solve(LinearBody<D>& linear, const ElasticCase<D>& c, Real tolerance);

/// Relative errors of displacement and gradient after removal of the best rigid motion.
struct ElasticErrors {
  Real L2, H1;
};
template <int D>
ElasticErrors errors_of(const ElasticCase<D>& c, NodalVectors u);

}  // namespace meniscus::study
