// SPDX-License-Identifier: BSD-3-Clause
// Order, limit and error bar of a result at several spacings.
#include "numbers/convergence.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace meniscus {
namespace {

/// Order p at which (f1 - f2)/(f2 - f3) = (h1^p - h2^p)/(h2^p - h3^p); the right side grows with p.
/// Empty if the quotient is not positive, or p is not between 0.1 and 10.
std::optional<Real> order_of(const std::array<Real, 3>& h, Real quotient) {
  const auto excess = [&](Real p) {
    return (std::pow(h[0] / h[1], p) - 1) / (1 - std::pow(h[2] / h[1], p)) - quotient;
  };
  Real low = 0.1, high = 10;
  if (!(excess(low) <= 0) || !(excess(high) >= 0)) return std::nullopt;
  for (int k = 0; k < 60; ++k) {
    const Real middle = (low + high) / 2;
    (excess(middle) < 0 ? low : high) = middle;
  }
  return low;
}

}  // namespace

Convergence convergence_of(const std::vector<Real>& h, const std::vector<Real>& value) {
  const std::size_t n = h.size();
  const std::array<Real, 3> spacing{h[n - 3], h[n - 2], h[n - 1]};
  const Real last = value[n - 1], step = value[n - 2] - last, before = value[n - 3] - value[n - 2];
  Convergence found{std::nullopt, last, 0};
  if (step == 0 && before == 0) return found;
  found.order = order_of(spacing, before / step);
  if (!found.order) {
    const auto [least, most] = std::minmax_element(value.begin(), value.end());
    found.error_bar = *most - *least;
    return found;
  }
  const auto beyond = [&](Real p) { return step / (std::pow(spacing[1] / spacing[2], p) - 1); };
  found.limit = last - beyond(*found.order);
  found.error_bar = 1.25 * std::abs(beyond(std::clamp(*found.order, 0.5, 2.0)));
  return found;
}

}  // namespace meniscus
