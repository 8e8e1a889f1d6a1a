// SPDX-License-Identifier: BSD-3-Clause
// Roots of the dispersion relation by continuation from the limits of small and large viscosity.
#include "study/drop_dispersion.hpp"

#include <fmt/core.h>

#include <cmath>
#include <optional>
#include <stdexcept>

namespace meniscus {
namespace {

/// q J_(l+3/2)(q) / J_(l+1/2)(q) as a function of x = q^2, by its continued fraction
/// x / (2l+3 - x / (2l+5 - ...)).
Complex bessel_ratio(int l, Complex x) {
  // Terms fall off superexponentially once 2 k exceeds |q|.
  const int depth = 40 + static_cast<int>(std::sqrt(std::abs(x)));
  Complex tail = 0;
  for (int k = depth; k >= 1; --k) tail = x / (Real(2 * l + 1 + 2 * k) - tail);
  return tail;
}

/// The dispersion function, zero at x = - s R^2/nu (RKPM note 7). The factor x^2 makes it smooth at
/// small x.
Complex dispersion(int l, Real Oh, Complex x) {
  const Complex R = bessel_ratio(l, x);
  const Real L = l;
  return x * x * (2 * (L * L - 1) / (x - 2.0 * R) - 1.0) +
         x * (2 * L * (L - 1)) * (1.0 - (L + 1) * R / (x / 2.0 - R)) -
         L * (L - 1) * (L + 2) / (Oh * Oh);
}

/// Newton's iteration; empty if it does not converge near its start.
std::optional<Complex> root_near(int l, Real Oh, Complex x) {
  const Complex start = x;
  for (int iteration = 0; iteration < 50; ++iteration) {
    const Complex h = 1e-6 * x;
    const Complex slope = (dispersion(l, Oh, x + h) - dispersion(l, Oh, x - h)) / (2.0 * h);
    const Complex step = dispersion(l, Oh, x) / slope;
    x -= step;
    if (!(std::abs(x - start) < 0.5 * std::abs(start))) return {};
    if (std::abs(step) < 1e-14 * std::abs(x)) return x;
  }
  return {};
}

/// Follows the root from Oh = `from` to `to` in steps small enough for Newton's iteration. Between
/// steps x, in units of nu/R^2, is multiplied by scale(before, after), which predicts its change.
template <class Guess>
std::optional<Complex> follow(int l, Real from, Real to, Complex first, Guess&& scale) {
  constexpr int steps = 400;
  Real Oh = from;
  std::optional<Complex> x = root_near(l, Oh, first);
  for (int k = 1; k <= steps && x; ++k) {
    const Real next = from * std::pow(to / from, static_cast<Real>(k) / steps);
    x = root_near(l, next, *x * scale(Oh, next));
    Oh = next;
  }
  return x;
}

}  // namespace

Complex drop_mode_rate(int l, Real Oh) {
  const Real L = l, inviscid = std::sqrt(L * (L - 1) * (L + 2));
  // Small viscosity: s = -(l-1)(2l+1) Oh +- i omega, x = -s/Oh.
  const Real thin = std::min(1e-3, Oh);
  const Complex weak((L - 1) * (2 * L + 1), -inviscid / thin);
  const auto oscillating =
      follow(l, thin, Oh, weak, [](Real before, Real after) { return before / after; });
  if (oscillating && std::abs(oscillating->imag()) > 1e-6 * std::abs(*oscillating))
    return {-Oh * oscillating->real(), std::abs(Oh * oscillating->imag())};
  // Large viscosity: s = -l (l+2) (2l+1) / (2 (2l^2+4l+3) Oh).
  const Real thick = std::max(100.0, Oh);
  const Real creeping = L * (L + 2) * (2 * L + 1) / (2 * (2 * L * L + 4 * L + 3));
  const auto damped = follow(l, thick, Oh, creeping / (thick * thick), [](Real before, Real after) {
    return before * before / (after * after);
  });
  if (!damped)
    throw std::domain_error(fmt::format("no root of the drop's mode {} at Oh = {}", l, Oh));
  return -Oh * damped->real();
}

}  // namespace meniscus
