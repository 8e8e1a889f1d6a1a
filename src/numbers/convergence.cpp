// SPDX-License-Identifier: BSD-3-Clause
// Order, limit and error bar of a result at several spacings.
#include "numbers/convergence.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace meniscus {
namespace {

constexpr Real least_order = 0.5, order_of_the_method = 2, most_order = 3;

/// Order p at which (f1 - f2)/(f2 - f3) = (h1^p - h2^p)/(h2^p - h3^p); the right side grows with p.
/// Empty if p is not between the least order and 10.
std::optional<Real> order_of(const std::array<Real, 3>& h, Real quotient) {
  const auto excess = [&](Real p) {
    return (std::pow(h[0] / h[1], p) - 1) / (1 - std::pow(h[2] / h[1], p)) - quotient;
  };
  Real low = least_order, high = 10;
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
  const auto beyond = [&](Real p) { return step / (std::pow(spacing[1] / spacing[2], p) - 1); };
  Convergence found{std::nullopt, last, 0};
  if (step == 0 && before == 0) return found;
  if (std::isnan(step + before)) return {std::nullopt, last, step + before};
  found.order = order_of(spacing, before / step);
  if (found.order) found.limit = last - beyond(*found.order);
  if (found.order && *found.order <= most_order) {
    found.error_bar = 1.25 * std::abs(beyond(std::min(*found.order, order_of_the_method)));
    return found;
  }
  const auto [least, most] = std::minmax_element(value.end() - 3, value.end());
  found.error_bar = 1.5 * (*most - *least);
  if (!found.order && step * before > 0)
    found.error_bar = std::max(found.error_bar, 1.25 * std::abs(beyond(least_order)));
  return found;
}

}  // namespace meniscus
