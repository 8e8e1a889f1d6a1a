// SPDX-License-Identifier: BSD-3-Clause
// Smooth pieces of the surface of a mesh, and the sharp curves between them.
#pragma once
#include "body/grid/grid.hpp"
#include "numbers/dense.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace meniscus {

/// Key of an edge or a facet: its grid nodes in ascending order.
using MeshKey = std::vector<Index>;

/// Sorts the nodes and removes duplicates.
inline MeshKey mesh_key(MeshKey nodes) {
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

/// Keys of the borders that a facet shares with its neighbours: its edges (2D: its two ends).
template <int D>
std::vector<MeshKey> facet_borders(const Facet<D>& facet) {
  if constexpr (D == 2) {
    return {{facet.nodes[0]}, {facet.nodes[1]}};
  } else {
    std::vector<MeshKey> edges;
    for (const auto& [a, b] : {std::pair(0, 1), {1, 3}, {3, 2}, {2, 0}})
      if (MeshKey edge = mesh_key({at(facet.nodes, a), at(facet.nodes, b)}); edge.size() == 2)
        edges.push_back(std::move(edge));
    return edges;
  }
}

/// A normal of the facet. Its length is proportional to the area.
template <int D>
Vec<D> facet_normal_of(const Facet<D>& facet, const std::vector<Vec<D>>& X) {
  const Vec<D> along = at(X, facet.nodes[1]) - at(X, facet.nodes[0]);
  if constexpr (D == 2) {
    return Vec<2>(along[1], -along[0]);
  } else {
    return cross(at(X, facet.nodes[3]) - at(X, facet.nodes[0]),
                 at(X, facet.nodes[2]) - at(X, facet.nodes[1]));
  }
}

/// Divides the boundary facets of a grid into smooth pieces. The grid must outlive this object.
template <int D>
class MeshPieces {
 public:
  explicit MeshPieces(const Grid<D>& grid) : grid_(grid) {
    for (std::size_t f = 0; f < grid.facets.size(); ++f) {
      normal_.push_back(facet_normal_of(grid.facets[f], grid.X).normalized());
      for (const MeshKey& border : facet_borders(grid.facets[f])) at_border_[border].push_back(f);
    }
    for (const auto& [border, facets] : at_border_)
      if (D == 3 && is_sharp(border)) {
        sharp_at_[border.front()].push_back(border.back());
        sharp_at_[border.back()].push_back(border.front());
      }
    piece_ = flooded([&](const MeshKey& border) { return !is_sharp(border); });
    part_ = flooded([](const MeshKey&) { return true; });
    find_inner();
  }

  bool is_sharp(const MeshKey& border) const {
    const auto& facets = at_border_.at(border);
    return facets.size() != 2 || at(normal_, facets[0]).dot(at(normal_, facets[1])) < least_cosine;
  }
  bool any_sharp() const {
    return std::any_of(at_border_.begin(), at_border_.end(),
                       [&](const auto& border) { return is_sharp(border.first); });
  }
  int count() const { return 1 + *std::max_element(piece_.begin(), piece_.end()); }
  int of(std::size_t facet) const { return at(piece_, facet); }
  /// True if the facet belongs to a closed surface around a cavity.
  bool inner(std::size_t facet) const { return at(inner_, at(part_, facet)); }

  /// Middle of the sharp edge between nodes a and b, on the curve through its neighbours: the mean
  /// of the parabolas through a, b and the next node of the curve at either end, if there is one.
  Vec<D> middle_of_curve(Index a, Index b) const {
    const Vec<D>&A = at(grid_.X, a), &B = at(grid_.X, b);
    const Real h = (B - A).norm();
    Vec<D> bend = Vec<D>::Zero();  // 1/8 of the second derivative over an edge
    int found = 0;
    for (const auto& [end, other] : {std::pair(a, b), std::pair(b, a)})
      if (const auto next = next_on_curve(end, other)) {
        const Vec<D> on = (at(grid_.X, *next) - at(grid_.X, end)),
                     back = at(grid_.X, other) - at(grid_.X, end);
        const Real l = on.norm();
        bend += 2 * h * h / (h + l) * (on / l + back / h) / 8;
        ++found;
      }
    return 0.5 * (A + B) - (found ? Vec<D>(bend / found) : bend);
  }

 private:
  std::vector<int> flooded(const auto& passes) const {
    std::vector<int> number(grid_.facets.size(), -1);
    int count = 0;
    for (std::size_t first = 0; first < number.size(); ++first) {
      if (number[first] >= 0) continue;
      std::vector<std::size_t> open{first};
      number[first] = count;
      while (!open.empty()) {
        const std::size_t f = open.back();
        open.pop_back();
        for (const MeshKey& border : facet_borders(grid_.facets[f])) {
          if (!passes(border)) continue;
          for (const std::size_t other : at_border_.at(border))
            if (number[other] < 0) {
              number[other] = count;
              open.push_back(other);
            }
        }
      }
      ++count;
    }
    return number;
  }

  void find_inner() {
    std::vector<Real> volume(
        static_cast<std::size_t>(1 + *std::max_element(part_.begin(), part_.end())), 0.0);
    for (std::size_t f = 0; f < grid_.facets.size(); ++f) {
      Vec<D> middle = Vec<D>::Zero();
      for (const Index node : grid_.facets[f].nodes) middle += at(grid_.X, node);
      at(volume, part_[f]) +=
          facet_normal_of(grid_.facets[f], grid_.X).dot(middle / (1 << (D - 1)) - grid_.X.front());
    }
    for (const Real v : volume) inner_.push_back(v < 0);
  }

  /// The next node of a sharp curve beyond `end`, coming from node `from`. Empty at a corner of the
  /// curve.
  std::optional<Index> next_on_curve(Index end, Index from) const {
    const std::vector<Index>& beside = sharp_at_.at(end);
    if (beside.size() != 2) return {};
    const Index next = beside[0] == from ? beside[1] : beside[0];
    const Vec<D> ahead = at(grid_.X, end) - at(grid_.X, from),
                 further = at(grid_.X, next) - at(grid_.X, end);
    if (further.normalized().dot(ahead.normalized()) < least_cosine) return {};
    return next;
  }

  static constexpr Real least_cosine = 0.643;  // cosine of 50 degrees
  const Grid<D>& grid_;
  std::vector<Vec<D>> normal_;
  std::map<MeshKey, std::vector<std::size_t>> at_border_;
  std::map<Index, std::vector<Index>> sharp_at_;  ///< 3D: [node] neighbours on sharp edges
  std::vector<int> piece_, part_;
  std::vector<char> inner_;
};

}  // namespace meniscus
