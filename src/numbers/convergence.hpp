// SPDX-License-Identifier: BSD-3-Clause
// Order, limit and error bar of a result at several spacings.
#pragma once
#include "numbers/types.hpp"

#include <optional>
#include <string>
#include <vector>

namespace meniscus {

/// The limit of a result by its last three levels.
struct Convergence {
  std::optional<Real> order;  ///< p of f = f0 + C h^p; empty if the values do not approach one
  Real limit = 0;             ///< f0; without an order the value of the finest level
  /// 1.25 |limit - finest value| with the order taken between 1/2 and 2, as the grid convergence
  /// index (Roache 1994); without an order the spread of all values.
  Real error_bar = 0;
};

/// `h`: spacings, falling, at least three; `value`: the result at each.
Convergence convergence_of(const std::vector<Real>& h, const std::vector<Real>& value);

}  // namespace meniscus
