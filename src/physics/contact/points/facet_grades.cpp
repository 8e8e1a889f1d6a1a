// SPDX-License-Identifier: BSD-3-Clause
// Distances beyond which fewer points per facet are enough.
#include "physics/contact/points/facet_grades.hpp"

#include <cmath>

namespace meniscus {
namespace {

Real factorial(int n) {
  return std::tgamma(n + 1.0);
}

/// The coefficient c_n: relative error of n Gauss points for a^-k over a length h, times
/// (a/h)^(2n).
Real gauss_error(int n, int k) {
  return std::pow(factorial(n), 4) * factorial(2 * n + k - 1) /
         (factorial(k - 1) * (2 * n + 1) * std::pow(factorial(2 * n), 3));
}

/// The distance beyond which a quadrature error changes the pressure by at most `bearable` times
/// the largest traction. `error`: the relative error as a function of the distance, decreasing.
template <class F>
Real distance_for(const Interaction& interaction, Real bearable, F&& error) {
  const PlaneContact flat = interaction.flat();
  const auto enough = [&](Real a) {
    return error(a) * std::abs(interaction.at(a).pressure) < bearable * flat.peak_traction;
  };
  // Beyond the largest traction the error falls with the distance. A law without a finite traction
  // has no such distance: then `far` becomes infinite and no grade is used.
  Real near = flat.peak_gap, far = near;
  while (far > 0 && std::isfinite(far) && !enough(far)) far *= 2;
  constexpr int most = 100;  // halvings; enough for all digits of a number
  for (int step = 0; step < most && far - near > 1e-6 * far; ++step) {
    const Real middle = (near + far) / 2;
    (enough(middle) ? far : near) = middle;
  }
  return far;
}

}  // namespace

template <class F>
void FacetGrades::add_grades(Real part, F&& distance_for) {
  while (points_.back() > 2) {
    points_.push_back(std::max(2, static_cast<int>(std::ceil(part * points_.back()))));
    edges_away_.push_back(distance_for(points_.back()));
  }
}

FacetGrades::FacetGrades(int points, const Interaction& interaction, Real edge)
    : FacetGrades(points) {
  // A corner of a facet may be nearer than the nearest of its four Gauss points by this share of
  // the edge.
  constexpr Real corner = 0.3, bearable = 1e-6;
  if (!interaction.far_power()) return;
  add_grades(0.5, [&](int n) {
    const Real c = gauss_error(n, *interaction.far_power());
    const auto error = [&](Real a) { return c * std::pow(edge / a, 2 * n); };
    return distance_for(interaction, bearable, error) / edge + corner;
  });
}

FacetGrades FacetGrades::of_pairs(int points, const Interaction& interaction, Real edge) {
  constexpr Real bearable = 1e-5, part = 0.6;
  constexpr int fewest = 3;
  FacetGrades grades(points);
  if (!interaction.far_power() || points <= fewest) return grades;
  grades.add_grades(part, [&](int n) {
    if (n < fewest) return unbounded;
    const Real c = gauss_error(n, *interaction.far_power() + 2);
    const auto error = [&](Real a) {
      const Real from = a / edge + 0.58, to = a / edge - 0.42;
      return to > 0 ? 2 * c * std::pow(from * to, -n) : unbounded;
    };
    return distance_for(interaction, bearable, error) / edge;
  });
  return grades;
}

}  // namespace meniscus
