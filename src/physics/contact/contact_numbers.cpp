// SPDX-License-Identifier: BSD-3-Clause
// Two half spaces: in closed form without a cut-off, by quadrature over one surface with one.
#include "physics/contact/contact_numbers.hpp"

#include "body/grid/gauss.hpp"
#include "meniscus/error.hpp"
#include "physics/contact/rigid/plane_field.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

namespace meniscus {
namespace {

/// Integral of f(r, rho), r^2 = gap^2 + rho^2, over the plane (2D: the line) at the distance `gap`
/// from a point, within the cut-off. Panels are as wide as their distance from the point, so that
/// 20 Gauss points each are exact to rounding.
template <class F>
Real over_plane(const ContactLaw& law, Real gap, F&& f) {
  constexpr Real pi = std::numbers::pi;
  const auto rho_of = [gap](Real r) { return r > gap ? std::sqrt((r - gap) * (r + gap)) : 0; };
  const std::array<Real, 2> ends{rho_of(switch_begin * law.reach()), rho_of(law.reach())};
  const GaussRule& rule = gauss_rule(20);
  const bool line = dimension_of(law.kernel) == 2;
  Real sum = 0, begin = 0;
  for (const Real end : ends)
    while (begin < end) {
      const Real half = std::min(end - begin, std::hypot(begin, gap)) / 2;
      if (!(half > 0)) return std::numeric_limits<Real>::quiet_NaN();  // the gap is too small
      for (int q = 0; q < 20; ++q) {
        const Real rho = begin + half * (1 + at(rule.x, q));
        const Real area = half * at(rule.w, q) * (line ? 2 : 2 * pi * rho);
        sum += area * f(pair_functions(law, std::hypot(gap, rho)), std::hypot(gap, rho));
      }
      begin = 2 * half < end - begin ? begin + 2 * half : end;
    }
  return sum;
}

/// The zero of a function that changes its sign between a and b, to rounding.
template <class F>
Real bisect(Real a, Real b, F&& f) {
  const bool rises = f(b) > 0;
  while (true) {
    const Real middle = a + (b - a) / 2;
    if (!(a < middle && middle < b)) return middle;  // also true if one of them is NaN
    ((f(middle) > 0) == rises ? b : a) = middle;
  }
}

/// The position between a and b at which f is least, to half the digits (golden section).
template <class F>
Real minimum(Real a, Real b, F&& f) {
  constexpr Real golden = 1 / std::numbers::phi_v<Real>;
  constexpr int most = 100;  // steps; enough for all digits of a number
  for (int step = 0; step < most && b - a > 1e-9 * b; ++step) {
    const Real left = b - golden * (b - a), right = a + golden * (b - a);
    f(left) < f(right) ? b = right : a = left;
  }
  return (a + b) / 2;
}

}  // namespace

PlaneState plane_state(const ContactLaw& law, Real beta_product, Real gap) {
  if (!law.cut()) {
    const PlaneField field(law);
    return {-beta_product * field.S(gap), beta_product * field.U(gap),
            -beta_product * field.dU(gap)};
  }
  using Pair = PairFunctions<Real>;
  const Real u = over_plane(law, gap, [](const Pair& f, Real) { return f.u; });
  const Real psi = over_plane(law, gap, [](const Pair& f, Real) { return f.psi; });
  const Real bend = over_plane(law, gap, [](const Pair& f, Real r) { return f.dpsi / r; });
  return {-beta_product * u, beta_product * gap * psi, -beta_product * (psi + gap * gap * bend)};
}

PlaneContact plane_contact(const ContactLaw& law, Real beta_product) {
  const auto state = [&](Real gap) { return plane_state(law, beta_product, gap); };
  const PlaneField uncut(law);
  PlaneContact c;
  c.equilibrium_gap = uncut.root(0);
  c.peak_gap = uncut.root(1);
  c.softening_gap = uncut.root(2);
  c.uncut_adhesion = beta_product * uncut.S(c.equilibrium_gap);
  if (law.cut()) {
    const auto stiffness = [&](Real gap) { return state(gap).stiffness; };
    c.softening_gap = minimum(c.peak_gap, 1.5 * c.softening_gap, stiffness);
    c.peak_gap = bisect(c.equilibrium_gap, c.softening_gap, stiffness);
    c.equilibrium_gap =
        bisect(c.equilibrium_gap / 2, c.peak_gap, [&](Real gap) { return state(gap).pressure; });
  }
  const PlaneState rest = state(c.equilibrium_gap);
  c.adhesion = -rest.energy;
  c.stiffness = rest.stiffness;
  c.peak_traction = -state(c.peak_gap).pressure;
  c.softening = -state(c.softening_gap).stiffness;
  return c;
}

void require_finite(const PlaneContact& contact, const std::string& place) {
  const auto require = [&](const char* name, Real value, bool may_be_zero) {
    if (std::isfinite(value) && (may_be_zero ? value >= 0 : value > 0)) return;
    throw InputError(fmt::format(
        "{}: the {} of this contact is {:.4g}, which no calculation can use; expected are numbers "
        "of the interaction (epsilon, sigma0, beta, adhesion, range, offset) of a usual size: look "
        "at their units",
        place, name, value));
  };
  require("adhesion", contact.adhesion, false);
  require("adhesion without cut-off", contact.uncut_adhesion, false);
  require("equilibrium gap", contact.equilibrium_gap, false);
  require("peak traction", contact.peak_traction, false);
  require("gap of the peak traction", contact.peak_gap, false);
  require("stiffness", contact.stiffness, true);
  require("softening", contact.softening, true);
}

std::optional<Real> contact_angle(Real adhesion, Real gamma) {
  if (adhesion >= 2 * gamma) return std::nullopt;
  return std::acos(adhesion / gamma - 1);
}

Real adhesion_of_angle(Real degrees, Real gamma) {
  return gamma * (1 + std::cos(degrees * std::numbers::pi / 180));
}

std::string contact_angle_text(Real adhesion, Real gamma) {
  const std::optional<Real> angle = contact_angle(adhesion, gamma);
  return angle ? fmt::format("{:.4g} degrees", *angle * 180 / std::numbers::pi)
               : std::string("complete wetting");
}

}  // namespace meniscus
