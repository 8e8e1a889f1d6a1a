// SPDX-License-Identifier: BSD-3-Clause
// The boundary nodes of a grid while they move along the present surface of its body.
#pragma once
#include "body/surface/quadratic_patches.hpp"
#include "remap/present_surface.hpp"

#include <algorithm>
#include <vector>

namespace meniscus {

/// Area vector of a facet through its corners (2D: normal times length).
template <int D>
Vec<D> area_of(const Facet<D>& facet, const std::vector<Vec<D>>& x) {
  const auto corner = [&](int a) { return at(x, at(facet.nodes, a)); };
  if constexpr (D == 3)
    return 0.5 * cross(corner(3) - corner(0), corner(2) - corner(1));
  else
    return Vec<2>(corner(1)[1] - corner(0)[1], corner(0)[0] - corner(1)[0]);
}

/// The boundary nodes of a grid, which move along the present surface.
template <int D>
class MovingNodes {
 public:
  using Foot = typename PresentSurface<D>::Foot;

  MovingNodes(const Grid<D>& grid, const PresentSurface<D>& surface)
      : grid_(grid),
        surface_(surface),
        x_(grid.X.size()),
        foot_(x_.size()),
        held_(x_.size(), 0),
        edge_(held_) {
    facets_at_.resize(x_.size());
    for (std::size_t f = 0; f < grid.facets.size(); ++f)
      for (const Index node : grid.facets[f].nodes)
        at(facets_at_, node).push_back(static_cast<Index>(f));
    const PatchNodes<D> numbered(grid);
    for (std::size_t f = 0; f < grid.facets.size(); ++f)
      for (int a = 0; a < PatchFunctions<D>::nodes; ++a) {
        const auto key = patch_key<D>(grid.facets[f], patch_node<D>(a));
        if (key.size() != 1) continue;
        Foot& foot = at(foot_, key.front());
        foot.patch = static_cast<Index>(f);
        foot.xi = patch_node<D>(a);
        at(x_, key.front()) = foot.x = at(surface.points(), at(numbered.facet[f], a));
      }
  }

  const std::vector<Vec<D>>& x() const { return x_; }
  const std::vector<Index>& facets_at(Index node) const { return at(facets_at_, node); }

  void hold(Index node, const Foot& foot) {
    place(node, foot);
    at(held_, node) = 1;
  }
  /// Holds a node on a sharp edge. Facets on both sides of the edge do not count as turned against
  /// each other.
  void hold_on_edge(Index node) {
    at(held_, node) = 1;
    at(edge_, node) = 1;
  }
  bool is_on_edge(Index node) const { return at(edge_, node) != 0; }
  const Foot& foot(Index node) const { return at(foot_, node); }

  /// Moves the free nodes to the weighted mean of the centres of their facets. The weights are the
  /// areas, plus eight times the turn of a facet against its neighbours.
  void relax() {
    constexpr Real weight_of_turns = 8;
    std::vector<Vec<D>> area, middle;
    for (const Facet<D>& facet : grid_.facets) {
      area.push_back(area_of(facet, x_));
      Vec<D> sum = Vec<D>::Zero();
      for (const Index node : facet.nodes) sum += at(x_, node);
      middle.push_back(sum / static_cast<Real>(facet.nodes.size()));
    }
    std::vector<Real> weight(area.size());
    for (std::size_t f = 0; f < weight.size(); ++f) {
      Real turn = 0;
      int beside = 0;
      for (const Index node : grid_.facets[f].nodes)
        for (const Index other : at(facets_at_, node))
          if (other != static_cast<Index>(f) && !at(edge_, node)) {
            turn += 1 - area[f].dot(at(area, other)) / (area[f].norm() * at(area, other).norm());
            ++beside;
          }
      weight[f] = area[f].norm() * (1 + weight_of_turns * turn / std::max(beside, 1));
    }
    for (std::size_t node = 0; node < x_.size(); ++node) {
      if (facets_at_[node].empty() || held_[node]) continue;
      Vec<D> sum = Vec<D>::Zero();
      Real whole = 0;
      for (const Index f : facets_at_[node]) {
        sum += at(weight, f) * at(middle, f);
        whole += at(weight, f);
      }
      place(static_cast<Index>(node), surface_.nearest(sum / whole, foot_[node].patch));
    }
  }

 private:
  void place(Index node, const Foot& foot) {
    at(foot_, node) = foot;
    at(x_, node) = foot.x;
  }

  const Grid<D>& grid_;
  const PresentSurface<D>& surface_;
  std::vector<Vec<D>> x_;  // [node] position; boundary nodes only
  std::vector<Foot> foot_;
  std::vector<char> held_, edge_;
  std::vector<std::vector<Index>> facets_at_;  // [node] facets with this node
};

}  // namespace meniscus
