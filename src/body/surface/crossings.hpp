// SPDX-License-Identifier: BSD-3-Clause
// Crossings: places where flat simplices (3D: triangles; 2D: segments) of surfaces go through each
// other.
#pragma once
#include "numbers/box.hpp"

#include <array>
#include <optional>
#include <vector>

namespace meniscus {

/// Two simplices that pass through each other.
template <int D>
struct Crossing {
  /// Numbers in CrossingSearch::simplices(): an edge of the first simplex pierces the second.
  Index first = -1, second = -1;
  Vec<D> place = Vec<D>::Zero();  ///< where the edge pierces
  /// Depth of the overlap: the smallest of the distances of both ends of the edge from the plane of
  /// `second`, and of `place` from the rim of `second`.
  Real depth = 0;
  Real share = 0;  ///< depth over the size of the simplices
};

/// Finds the simplices that cross at given places of their corners. Boxes around neighbouring
/// simplices form a binary tree, which is made once; a search costs a fraction of a microsecond per
/// simplex while surfaces keep their distance.
template <int D>
class CrossingSearch {
 public:
  using Simplex = std::array<Index, D>;

  /// `simplices` [number][corner] are numbers of places, `group` [number] of the surface that a
  /// simplex belongs to, ascending; `X` are the places by which the tree is made.
  CrossingSearch(std::vector<Simplex> simplices, const std::vector<Index>& group,
                 const std::vector<Vec<D>>& X);

  /// Flat simplices deviate from the curved surface that they stand for by h/(8R) of their size h,
  /// R the radius of curvature. Crossings less deep than this share of the longer of edge and
  /// simplex do not count.
  static constexpr Real bearable = 0.06;

  /// The crossing of the largest share at the places `x` [place], if there is one beyond
  /// `bearable`. An edge that has a corner in common with a simplex does not cross it; surfaces
  /// that touch do not cross. Places that are not finite cross nothing.
  std::optional<Crossing<D>> deepest(const std::vector<Vec<D>>& x) const;

  /// The simplices in the order of the tree. Groups stay together and keep their order.
  const std::vector<Simplex>& simplices() const { return simplices_; }
  std::size_t bytes() const;

 private:
  /// The simplices `begin` to `end` - 1; the left child is the next node.
  struct Node {
    Index begin, end;
    Index right = -1;  // child; -1: a leaf
  };
  struct Item {
    Simplex simplex;
    Index group;
    Vec<D> centre;
  };
  struct Plane;
  struct Places;

  void divide(std::vector<Item>& items, Index begin, Index end);
  void pierce(Index first, Index second, const Places& places, Crossing<D>& deepest) const;
  void find_in(const Node& leaf, const Places& places, Crossing<D>& deepest) const;

  std::vector<Simplex> simplices_;
  std::vector<Node> nodes_;
  std::vector<Index> leaves_;                 // numbers of nodes
  std::vector<std::array<Index, 2>> beside_;  // [place] 2D: the places before and after it
};

}  // namespace meniscus
