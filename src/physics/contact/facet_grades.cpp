// SPDX-License-Identifier: BSD-3-Clause
// Distances from which on fewer points are enough.
#include "meniscus/physics/facet_grades.hpp"

#include <cmath>

namespace meniscus {
namespace {

Real factorial(int n) {
  return std::tgamma(n + 1.0);
}

/// c_n: of n Gauss points for a^-k over a length h, relative, times (a/h)^(2n).
Real gauss_error(int n, int k) {
  return std::pow(factorial(n), 4) * factorial(2 * n + k - 1) /
         (factorial(k - 1) * (2 * n + 1) * std::pow(factorial(2 * n), 3));
}

/// The distance from which on n points are enough for a facet of that edge.
Real distance_for(int n, const Interaction& interaction, Real edge) {
  constexpr Real bearable = 1e-6;
  const PlaneContact flat = interaction.flat();
  const Real c = gauss_error(n, *interaction.far_power());
  const auto enough = [&](Real a) {
    return c * std::pow(edge / a, 2 * n) * std::abs(interaction.at(a).pressure) <
           bearable * flat.peak_traction;
  };
  // Beyond the largest traction the error falls with the distance.
  Real near = flat.peak_gap, far = near;
  while (!enough(far)) far *= 2;
  while (far - near > 1e-6 * far) {
    const Real middle = (near + far) / 2;
    (enough(middle) ? far : near) = middle;
  }
  return far;
}

}  // namespace

FacetGrades::FacetGrades(int points, const Interaction& interaction, Real edge)
    : points_{points}, edges_away_{0} {
  // A corner of a facet is nearer than the nearest of four Gauss points by as much at most.
  constexpr Real corner = 0.3;
  if (!interaction.far_power()) return;
  while (points_.back() > 2) {
    points_.push_back((points_.back() + 1) / 2);
    edges_away_.push_back(distance_for(points_.back(), interaction, edge) / edge + corner);
  }
}

}  // namespace meniscus
