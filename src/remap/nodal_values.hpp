// SPDX-License-Identifier: BSD-3-Clause
// Values of fields of a body at points, and the coefficients that make given values.
#pragma once
#include "body/body.hpp"

#include <span>

namespace meniscus {

/// sum_B N_B(p_q) c_B at the points of the rows.
template <int D>
NodalVectors values_at(const PointRows<D>& rows, const NodalVector* c);

/// The values f_A that go with particles or their cells, when these move from points where the
/// field has the values `from` to those with the values `to`: f_A + sum_B (N_B(to_A) - N_B(from_A))
/// f_B. What the shape functions smooth away stays with the particle, so that nothing changes where
/// nothing moves.
NodalVectors shifted(NodalVectors f, const NodalVectors& from, const NodalVectors& to);

/// Coefficients c of a field whose values at the particles are given, sum_B N_B(X_A) c_B = f_A: by
/// eight steps c += f - N c from a guess. Exact solutions would be rough, for the shape functions
/// hardly pass on what changes from particle to particle.
template <int D>
NodalVectors coefficients_of(const Body<D>& body, const NodalVectors& f, NodalVectors guess);

/// The places of the particles now, [particle] x(X_A) = X_A + sum_B N_B(X_A) u_B; `u` is that of
/// the body.
template <int D>
std::vector<Vec<D>> places(const Body<D>& body, const NodalVector* u);

/// The material points of a body, by their places in its reference, that are now at `x`:
/// X + sum_A N_A(X) u_A = x, up to 1e-13 of a spacing, found by Newton's method from the particle
/// that is nearest. `u` is that of the body. Throws SolveError naming body and point where there is
/// none.
template <int D>
std::vector<Vec<D>> pre_images(const Body<D>& body, const NodalVector* u,
                               std::span<const Vec<D>> x);

}  // namespace meniscus
