// SPDX-License-Identifier: BSD-3-Clause
// Lists the points of a wetted face.
#include "body/surface/wetted_points.hpp"

#include "body/surface/surface_points.hpp"
#include "numbers/dense.hpp"

#include <algorithm>

namespace meniscus {
namespace {

/// The nodes of one side of a patch, in order, and the node of the patch that faces it.
template <int D>
struct Side {
  std::array<int, LinePart<D>::nodes> node;
  int behind;
};
template <int D>
constexpr auto sides_of_patch() {
  if constexpr (D == 3)
    return std::array<Side<3>, 4>{{{{0, 1, 2}, 4}, {{6, 7, 8}, 4}, {{0, 3, 6}, 4}, {{2, 5, 8}, 4}}};
  else
    return std::array<Side<2>, 2>{{{{0}, 1}, {{2}, 1}}};
}

template <int D>
Real area_of(const CellPoint<D, D - 1>& place) {
  if constexpr (D == 3)
    return cross(Eigen::Vector3d(place.J.col(0)), Eigen::Vector3d(place.J.col(1))).norm();
  else
    return place.J.norm();
}

}  // namespace

/// A side lies on the contact line if its middle belongs to a patch of another face, too.
template <int D>
WettedPoints<D>::WettedPoints(const Geometry<D>& geometry, const std::string& face) {
  const PatchNodes<D> nodes(geometry.grid);
  const auto gauss = patch_functions<D>(3);
  std::vector<Index> number(static_cast<std::size_t>(nodes.count()), -1);
  std::vector<std::uint8_t> elsewhere(number.size(), 0);
  std::vector<std::array<Index, PatchFunctions<D>::nodes>> patches;
  for (std::size_t f = 0; f < nodes.facet.size(); ++f) {
    const Facet<D>& facet = geometry.grid.facets[f];
    if (geometry.surface->face_name(facet.patch) != face) {
      for (const Index node : nodes.facet[f]) at(elsewhere, node) = 1;
      continue;
    }
    auto& patch = patches.emplace_back();
    for (std::size_t a = 0; a < patch.size(); ++a) {
      Index& known = at(number, nodes.facet[f][a]);
      if (known < 0) {
        known = static_cast<Index>(X.size());
        number_on_surface.push_back(nodes.facet[f][a]);
        X.push_back(surface_point<D>(geometry, facet, patch_node<D>(static_cast<int>(a))));
      }
      patch[a] = known;
    }
  }
  std::vector<std::uint8_t> on_line(X.size(), 0);
  for (std::size_t node = 0; node < number.size(); ++node)
    if (number[node] >= 0) at(on_line, number[node]) = elsewhere[node];
  area.assign(X.size(), 0);
  for (const auto& patch : patches) {
    for (const PatchFunctions<D>& f : gauss) {
      const auto place = patch_place<D>(f, patch, X);
      const Real dA = f.weight * area_of(place) * circle(geometry.grid, place.X);
      for (std::size_t a = 0; a < patch.size(); ++a) at(area, patch[a]) += f.L[a] * dA;
    }
    for (const Side<D>& side : sides_of_patch<D>()) {
      LinePart<D> part;
      part.behind = at(patch, side.behind);
      for (int k = 0; k < LinePart<D>::nodes; ++k) at(part.point, k) = at(patch, at(side.node, k));
      if (at(on_line, at(part.point, LinePart<D>::nodes / 2))) line.push_back(part);
    }
  }
  for (Real& a : area) a = std::max(a, 0.0);
}

template struct WettedPoints<2>;
template struct WettedPoints<3>;

}  // namespace meniscus
