// SPDX-License-Identifier: BSD-3-Clause
// Formulas of a 3D scene, in the half plane through an axis.
#include "scene/half_plane_formulas.hpp"

#include "input/functions.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace meniscus {
namespace {

constexpr std::array<Real, 4> angles{0.7, 1.5707963267948966, 2.9, 4.3};
constexpr std::array<Real, 3> times{0, 0.37, 11};
/// Allowed difference of values of the size `value`, of which the largest anywhere is `largest`.
Real round_off(Real value, Real largest) {
  return 1e-9 * value + 1e-12 * largest;
}

std::string text_of(const Eigen::Vector3d& x) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", x[0], x[1], x[2]);
}

}  // namespace

Vec<2> TwinAxis::in_half_plane(const Eigen::Vector3d& x) const {
  return {std::hypot(x[across()] - through[across()], x[normal()] - through[normal()]), x[along]};
}

Eigen::Vector3d TwinAxis::turned(const Eigen::Vector3d& x, Real angle) const {
  const int i = across(), j = normal();
  const Real a = x[i] - through[i], b = x[j] - through[j], c = std::cos(angle), s = std::sin(angle);
  Eigen::Vector3d y = x;
  y[i] = through[i] + c * a - s * b;
  y[j] = through[j] + s * a + c * b;
  return y;
}

TwinAxis axis_through_middle(int along, const std::vector<Eigen::Vector3d>& places) {
  TwinAxis axis;
  axis.along = along;
  Eigen::Vector3d low = Eigen::Vector3d::Constant(unbounded), high = -low;
  for (const Eigen::Vector3d& X : places) {
    low = low.cwiseMin(X);
    high = high.cwiseMax(X);
  }
  for (int k = 0; k < 3; ++k) {
    const Real middle = (low[k] + high[k]) / 2;
    axis.through[k] = std::abs(middle) <= 1e-9 * (high - low)[k] ? 0 : middle;
  }
  return axis;
}

HalfPlaneFormulas::HalfPlaneFormulas(const TwinAxis& axis, const Constants& constants,
                                     const std::vector<Eigen::Vector3d>& places)
    : axis_(axis), constants_(constants) {
  constexpr std::size_t most = 800;
  const std::size_t step = std::max<std::size_t>(1, places.size() / most);
  for (std::size_t A = 0; A < places.size(); A += step) samples_.push_back(places[A]);
}

std::string HalfPlaneFormulas::rewritten(const std::string& formula,
                                         const std::vector<std::string>& arguments) const {
  const auto replacement = [&](int i) -> std::string {
    if (i == axis_.along) return "y";
    const Real shift = axis_.through[i];
    if (i == axis_.normal()) return shift == 0 ? "0" : fmt::format("({})", shift);
    return shift == 0 ? "x" : fmt::format("({} + x)", shift);
  };
  std::string text;
  std::size_t done = 0;
  for (const NamePlace& place : name_places(formula)) {
    const std::string name = formula.substr(place.begin, place.end - place.begin);
    const std::size_t i = std::string_view("xyz").find(name);
    if (name.size() != 1 || i == std::string_view::npos ||
        std::find(arguments.begin(), arguments.end(), name) != arguments.end())
      continue;
    text += formula.substr(done, place.begin - done) + replacement(static_cast<int>(i));
    done = place.end;
  }
  return text + formula.substr(done);
}

Expression HalfPlaneFormulas::parsed(const std::string& formula) const {
  return Expression(constants_.functions.expanded(formula), constants_.numbers());
}

/// Calls f(x, angle, t) for samples x in the half plane, angles of turns about the axis, and times,
/// until it returns something.
template <class F>
std::optional<std::string> HalfPlaneFormulas::first_of(F&& f) const {
  for (const Eigen::Vector3d& sample : samples_) {
    const Vec<2> at = axis_.in_half_plane(sample);
    Eigen::Vector3d x = axis_.through;
    x[axis_.across()] += at[0];
    x[axis_.along] = at[1];
    for (const Real t : times)
      for (const Real angle : angles)
        if (std::optional<std::string> found = f(x, angle, t)) return found;
  }
  return std::nullopt;
}

std::optional<std::string> HalfPlaneFormulas::uneven(const std::string& formula) const {
  const Expression f = parsed(formula);
  if (!f.depends_on_place()) return std::nullopt;
  Real largest = 0;
  first_of([&](const Eigen::Vector3d& x, Real angle, Real t) -> std::optional<std::string> {
    largest = std::fmax(largest, std::abs(f.unchecked(axis_.turned(x, angle), t)));
    return std::nullopt;
  });
  return first_of([&](const Eigen::Vector3d& x, Real angle, Real t) -> std::optional<std::string> {
    const Eigen::Vector3d y = axis_.turned(x, angle);
    const Real here = f.unchecked(x, t), there = f.unchecked(y, t);
    if (here == there || (std::isnan(here) && std::isnan(there)) ||
        std::abs(here - there) <= round_off(std::abs(here), largest))
      return std::nullopt;
    return fmt::format("is {:.4g} at {} and {:.4g} at {}, as far from the axis", here, text_of(x),
                       there, text_of(y));
  });
}

std::optional<std::string> HalfPlaneFormulas::uneven(const std::array<std::string, 3>& vector,
                                                     bool place) const {
  const std::array<Expression, 3> f{parsed(vector[0]), parsed(vector[1]), parsed(vector[2])};
  TwinAxis direction = axis_;
  if (!place) direction.through.setZero();
  const auto value = [&](const Eigen::Vector3d& x, Real t) -> Eigen::Vector3d {
    return {f[0].unchecked(x, t), f[1].unchecked(x, t), f[2].unchecked(x, t)};
  };
  Real largest = 0;
  first_of([&](const Eigen::Vector3d& x, Real angle, Real t) -> std::optional<std::string> {
    for (const Real component : value(axis_.turned(x, angle), t))
      largest = std::fmax(largest, std::abs(component));
    return std::nullopt;
  });
  return first_of([&](const Eigen::Vector3d& x, Real angle, Real t) -> std::optional<std::string> {
    const Eigen::Vector3d here = value(x, t), y = axis_.turned(x, angle), there = value(y, t),
                          expected = direction.turned(here, angle);
    const Real allowed = round_off(here.cwiseAbs().maxCoeff(), largest);
    if (!(std::abs(here[axis_.normal()] - direction.through[axis_.normal()]) <= allowed))
      return fmt::format("is {} at {}, around the axis", text_of(here), text_of(x));
    if (!((there - expected).cwiseAbs().maxCoeff() <= allowed))
      return fmt::format("is {} at {}; of revolution it is {}", text_of(there), text_of(y),
                         text_of(expected));
    return std::nullopt;
  });
}

}  // namespace meniscus
