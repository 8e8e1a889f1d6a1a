// SPDX-License-Identifier: BSD-3-Clause
// Order, limit and error bar of a result at several spacings.
#pragma once
#include "numbers/types.hpp"

#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace meniscus {

/// The limit of a result by its last three levels, for a method of second order.
struct Convergence {
  /// p of f = f0 + C h^p; empty if the values do not approach a limit so, or with p below 1/2.
  std::optional<Real> order;
  Real limit = 0;  ///< f0; without an order the value of the finest level
  /// Error bar of the finest level: 1.25 |limit - value| with p not above 2, the grid convergence
  /// index (Roache 1994). Without an order, or with p above 3, which is chance: 1.5 times the
  /// spread of the three values, and at least 1.25 |limit - value| of p = 1/2 if they rise or fall;
  /// in the manner of Eca and Hoekstra (2014).
  Real error_bar = 0;

  /// Error bar of the coarsest level.
  Real error_of(Real coarsest) const { return std::abs(coarsest - limit) + error_bar; }
};

/// `h`: spacings, falling, at least three; `value`: the result at each.
Convergence convergence_of(const std::vector<Real>& h, const std::vector<Real>& value);

}  // namespace meniscus
