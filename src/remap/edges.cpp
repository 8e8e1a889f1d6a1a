// SPDX-License-Identifier: BSD-3-Clause
// Nodes at which the normal of the surface jumps.
#include "remap/edges.hpp"

#include "numbers/dense.hpp"

#include <algorithm>

namespace meniscus {

template <int D>
std::vector<Index> nodes_on_edges(const Grid<D>& grid, const PresentSurface<D>& surface) {
  constexpr Real least_cosine = 0.7;
  std::vector<std::vector<Vec<D>>> normals(grid.X.size());
  for (std::size_t f = 0; f < grid.facets.size(); ++f)
    for (int a = 0; a < PatchFunctions<D>::nodes; ++a) {
      const auto key = patch_key<D>(grid.facets[f], patch_node<D>(a));
      if (key.size() != 1) continue;
      const auto place = patch_place<D>(PatchFunctions<D>(patch_node<D>(a)),
                                        at(surface.patches(), f), surface.points());
      if constexpr (D == 3)
        at(normals, key.front()).push_back(cross(place.J.col(0), place.J.col(1)).normalized());
      else
        at(normals, key.front()).push_back(place.J.col(0).normalized());  // turns as the normal
    }
  std::vector<Index> found;
  for (std::size_t node = 0; node < normals.size(); ++node) {
    const std::vector<Vec<D>>& n = normals[node];
    if (std::any_of(n.begin(), n.end(),
                    [&](const Vec<D>& other) { return n.front().dot(other) < least_cosine; }))
      found.push_back(static_cast<Index>(node));
  }
  return found;
}

template std::vector<Index> nodes_on_edges(const Grid<2>&, const PresentSurface<2>&);
template std::vector<Index> nodes_on_edges(const Grid<3>&, const PresentSurface<3>&);

}  // namespace meniscus
