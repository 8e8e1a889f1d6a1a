// SPDX-License-Identifier: BSD-3-Clause
// Adhesion as a formula of position and time.
#include "physics/contact/adhesion.hpp"

#include "meniscus/error.hpp"
#include "physics/contact/contact_numbers.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <string>

namespace meniscus {
namespace {

/// Calls f(formula) for each formula that is given.
template <class F>
void for_all(const AdhesionFormulas& formulas, F&& f) {
  for (const auto* formula : {&formulas.angle, &formulas.adhesion, &formulas.actin})
    if (*formula) f(**formula);
}

[[noreturn]] void refuse(const Expression& formula, const std::string& what, Real value,
                         const std::string& allowed, const Eigen::Vector3d& x, Real time) {
  throw SolveError(fmt::format(
      "{}formula '{}': {} is {:.6g} at x = {:.6g}, y = {:.6g}, z = {:.6g}, t = {:.6g}; allowed is "
      "{}",
      formula.place().empty() ? "" : formula.place() + ": ", formula.text(), what, value, x[0],
      x[1], x[2], time, allowed));
}

}  // namespace

bool AdhesionFormulas::constant() const {
  bool constant = true;
  for_all(*this, [&](const Expression& formula) { constant &= formula.constant(); });
  return constant;
}

AdhesionPattern::AdhesionPattern(AdhesionFormulas formulas, Real gamma, Real range)
    : formulas_(std::move(formulas)), gamma_(gamma), step_(1e-3 * range) {
  for_all(formulas_, [&](const Expression& formula) {
    depends_on_time_ |= formula.depends_on_time();
    steady_after_ = std::max(steady_after_, formula.steady_after());
    for (int i = 0; i < 3; ++i) at(depends_on_, i) |= formula.depends_on_axis(i);
  });
}

Real AdhesionPattern::operator()(const Eigen::Vector3d& x, Real time) const {
  Real W = 0;
  if (formulas_.angle) {
    const Real degrees = (*formulas_.angle)(x, time);
    if (!(degrees >= 1 && degrees <= 179))
      refuse(*formulas_.angle, "contact_angle", degrees, "1 to 179", x, time);
    W = adhesion_of_angle(degrees, gamma_);
  } else if (formulas_.adhesion) {
    W = (*formulas_.adhesion)(x, time);
    if (W < 0) refuse(*formulas_.adhesion, "adhesion", W, ">= 0", x, time);
  }
  if (formulas_.actin) {
    W += (*formulas_.actin)(x, time);
    if (W < 0) refuse(*formulas_.actin, "adhesion with actin", W, ">= 0", x, time);
  }
  return W;
}

Eigen::Vector3d AdhesionPattern::gradient(const Eigen::Vector3d& x, Real time) const {
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    if (!at(depends_on_, i)) continue;
    const auto beside = [&](Real steps) {
      return (*this)(x + steps * step_ * Eigen::Vector3d::Unit(i), time);
    };
    gradient[i] = (8 * (beside(1) - beside(-1)) - (beside(2) - beside(-2))) / (12 * step_);
  }
  return gradient;
}

}  // namespace meniscus
