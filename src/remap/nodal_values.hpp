// SPDX-License-Identifier: BSD-3-Clause
// Values of nodal fields at points, and coefficients that give prescribed values.
#pragma once
#include "body/body.hpp"

#include <span>

namespace meniscus {

/// sum_B N_B(p_q) c_B at the points of the rows.
template <int D>
NodalVectors values_at(const PointRows<D>& rows, const NodalVector* c);

/// New values of a nodal field after particles (or cells) have moved to other points: f_A + sum_B
/// (N_B(to_A) - N_B(from_A)) f_B. `from` and `to` are the interpolated values of the field at the
/// old and new points. The part of f_A that shape functions smooth away stays with the particle, so
/// a particle that does not move keeps its value.
NodalVectors shifted(NodalVectors f, const NodalVectors& from, const NodalVectors& to);

/// Coefficients c of a field with given values f_A at the particles, sum_B N_B(X_A) c_B = f_A.
/// Makes eight steps c += f - N c, starting at `guess`. The exact solution would be rough, since
/// shape functions strongly damp changes from particle to particle.
template <int D>
NodalVectors coefficients_of(const Body<D>& body, const NodalVectors& f, NodalVectors guess);

/// Current positions of the particles, [particle]: x(X_A) = X_A + sum_B N_B(X_A) u_B. `u` has the
/// displacement coefficients of the body.
template <int D>
std::vector<Vec<D>> places(const Body<D>& body, const NodalVector* u);

/// Reference positions X of the material points that are now at `x`, [point]: X + sum_A N_A(X) u_A
/// = x, up to 1e-13 of a spacing. Newton's method starts at the nearest particle. `u` has the
/// displacement coefficients of the body. Throws SolveError with body and point if there is no such
/// material point.
template <int D>
std::vector<Vec<D>> pre_images(const Body<D>& body, const NodalVector* u,
                               std::span<const Vec<D>> x);

}  // namespace meniscus
