// SPDX-License-Identifier: BSD-3-Clause
// Gauss-Legendre points as roots of the Legendre polynomial, by Newton's method.
#include "body/grid/gauss.hpp"

#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <cmath>
#include <numbers>

namespace meniscus {

namespace {

// Extended precision makes points and weights correctly rounded doubles.
using Extended = long double;

struct Legendre {
  Extended value, slope;
};

/// P_k(x) and P_k'(x) for |x| < 1 by the three-term recurrence.
Legendre legendre(int k, Extended x) {
  Extended previous = 1, current = x;
  for (int j = 2; j <= k; ++j) {
    const Extended next = ((2 * j - 1) * x * current - (j - 1) * previous) / j;
    previous = current;
    current = next;
  }
  return {current, k * (previous - x * current) / (1 - x * x)};
}

constexpr int most_points = 20;

GaussRule find_gauss_rule(int k) {
  GaussRule rule{std::vector<Real>(static_cast<std::size_t>(k)),
                 std::vector<Real>(static_cast<std::size_t>(k))};
  for (int i = 0; 2 * i < k; ++i) {
    Extended x = std::cos(std::numbers::pi_v<Extended> * (i + 0.75L) / (k + 0.5L));
    if (2 * i + 1 == k) x = 0;
    for (int iteration = 0; iteration < 20; ++iteration) {
      const Legendre p = legendre(k, x);
      const Extended step = p.value / p.slope;
      x -= step;
      if (std::abs(step) < 1e-19L) break;
    }
    const Extended slope = legendre(k, x).slope;
    at(rule.x, i) = static_cast<Real>(-x);
    at(rule.x, k - 1 - i) = static_cast<Real>(x);
    at(rule.w, i) = at(rule.w, k - 1 - i) = static_cast<Real>(2 / ((1 - x * x) * slope * slope));
  }
  return rule;
}

}  // namespace

const GaussRule& gauss_rule(int k) {
  if (k < 1 || k > most_points)
    throw InputError(
        fmt::format("a Gauss rule has 1 to {} points per direction, not {}.", most_points, k));
  static const std::vector<GaussRule> all = [] {
    std::vector<GaussRule> rules;
    for (int points = 1; points <= most_points; ++points) rules.push_back(find_gauss_rule(points));
    return rules;
  }();
  return at(all, k - 1);
}

}  // namespace meniscus
