// SPDX-License-Identifier: BSD-3-Clause
// Bodies with exactly known forces of surface tension.
#pragma once
#include "body/body.hpp"
#include "meniscus/physics/force_term.hpp"
#include "study/support/maps.hpp"

#include <memory>

namespace meniscus::study {

/// A body and its state (displacement coefficients u_A = x(X_A) - X_A). For unit tension on the
/// exact surface of this state: the nodal forces and the power of two virtual motions.
struct ForceCase {
  std::unique_ptr<Body<3>> body;
  NodalVectors u;
  NodalVectors exact;         ///< f_A = int N_A 2 kappa n da, 8 x 8 Gauss points per facet
  Real dilation, stretching;  ///< int 2 kappa n.v da for v = x and v = (-x/2, y, -z/2)
};

/// The state map(unit ball) with n cells along an edge of the core and supports of `factor` d_20.
ForceCase mapped_ball(int n, const SmoothMap<3>& map, Real factor);

/// Young-Laplace: the reference is the twisted ellipsoid, the state is the unit sphere. A pressure
/// of 2 balances unit tension.
ForceCase rounded_ellipsoid(int n, Real factor);

NodalVectors force_of(ForceTerm& term, const NodalVectors& u);
Real dot(const NodalVectors& a, const NodalVectors& b);
inline Real norm(const NodalVectors& a) {
  return std::sqrt(dot(a, a));
}
/// a + s b
NodalVectors sum_of(NodalVectors a, Real s, const NodalVectors& b);

/// Current coefficients d_A = X_A + u_A.
NodalVectors positions(const ForceCase& c);
/// A linear virtual motion v_A = V d_A; shape functions reproduce it.
NodalVectors linear_motion(const ForceCase& c, const Mat<3>& V);

/// |sum f| / sum |f| and |sum d x f| / sum |d| |f|.
struct Balance {
  Real force, torque;
};
Balance balance_of(const ForceCase& c, const NodalVectors& force);

/// Nodal forces of a unit pressure from inside, sum_q N_A cof(F) N dA with k x k points per facet.
NodalVectors unit_pressure(const ForceCase& c, int k);

}  // namespace meniscus::study
