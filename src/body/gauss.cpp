// SPDX-License-Identifier: BSD-3-Clause
// Gauss-Legendre points as roots of the Legendre polynomial, by Newton's method.
#include "meniscus/body/gauss.hpp"

#include "meniscus/core/error.hpp"

#include <cmath>
#include <numbers>

namespace meniscus {

namespace {

// Extended precision, so that points and weights are correctly rounded doubles.
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

}  // namespace

GaussRule gauss_rule(int k) {
  if (k < 1 || k > 20)
    throw InputError("a Gauss rule has 1 to 20 points per direction, not " + std::to_string(k) +
                     ".");
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

}  // namespace meniscus
