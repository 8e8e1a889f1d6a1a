// SPDX-License-Identifier: BSD-3-Clause
// Roughness of surfaces of contact points.
#include "physics/contact/points/contact_resolution.hpp"

#include "body/surface/surface_points.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meniscus {

Real roughness(Real gap_per_spacing, bool rigid) {
  return rigid ? 2.5 * std::exp(-4 * gap_per_spacing) : 4 * std::exp(-2.6 * gap_per_spacing);
}

Real ContactResolution::tangential_share(int points) const {
  return roughness(0.8 * gap * points / facet, rigid);
}

int ContactResolution::enough_points() const {
  constexpr Real bearable = 1e-3;
  if (rigid && width > 0) {
    constexpr Real round_off = 1e-6;
    return static_cast<int>(std::clamp(std::ceil(3 * facet / width - round_off), 3.0, 6.0));
  }
  const int most = rigid ? 4 : 8;
  int points = 2;
  while (points < most && tangential_share(points) > bearable) ++points;
  return points;
}

Real ContactResolution::longest_spacing() const {
  constexpr Real reach = 6;  // unit: equilibrium gaps; about 4 sigma0 for Lennard-Jones
  return reach * gap;
}

namespace {

/// Areas of the points of facets in the grid; in a body of revolution without their circles.
template <int D>
std::vector<Real> areas_of_grid(const Body<D>& body, int points) {
  return body.geometry.surface->points(body.geometry.grid, points, SurfacePart::whole).area;
}

}  // namespace

template <int D>
Real facet_size(const Body<D>& body) {
  const std::vector<Real> area = areas_of_grid(body, 2);
  const Real total = std::accumulate(area.begin(), area.end(), Real{0});
  return std::pow(total / static_cast<Real>(body.geometry.grid.facets.size()), 1.0 / (D - 1));
}

template <int D>
FacetEdges facet_edges(const Body<D>& body) {
  const std::vector<Real> area = areas_of_grid(body, 1);
  const auto [least, largest] = std::minmax_element(area.begin(), area.end());
  return {std::pow(*least, 1.0 / (D - 1)), std::pow(*largest, 1.0 / (D - 1))};
}

template FacetEdges facet_edges(const Body<2>&);
template FacetEdges facet_edges(const Body<3>&);
template Real facet_size(const Body<2>&);
template Real facet_size(const Body<3>&);

}  // namespace meniscus
