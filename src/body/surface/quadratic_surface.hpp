// SPDX-License-Identifier: BSD-3-Clause
// Surfaces of biquadratic (2D: quadratic) patches through given points.
#pragma once
#include "body/shapes/geometry.hpp"
#include "body/surface/quadratic_patches.hpp"

#include <map>
#include <vector>

namespace meniscus {

/// A surface whose boundary facets are Lagrange patches through given points. Neighbouring patches
/// meet without a gap; the angle between them is of the order of their size squared.
template <int D>
class QuadraticSurface final : public Surface<D> {
 public:
  /// `points` are positions by the numbers of PatchNodes(grid); corner points are nodes of the
  /// grid. `inner` [patch] is nonzero if the patch bounds a cavity; it is empty if there is no
  /// cavity.
  QuadraticSurface(const Grid<D>& grid, const std::vector<Vec<D>>& points, bool smooth = true,
                   std::vector<char> inner = {});

  SurfacePoints<D> points(const Grid<D>& grid, int k, SurfacePart part) const override;
  Vec<D> point(const Grid<D>& grid, const Facet<D>& facet, const Vec<D - 1>& xi) const override;
  bool smooth() const override { return smooth_; }
  bool hollow() const override;
  std::shared_ptr<const Surface<D>> renumbered(std::span<const Index> order) const override;
  std::shared_ptr<const Surface<D>> mapped(const SmoothMap<D>& map,
                                           const Grid<D>& grid) const override;

 private:
  using Key = typename PatchNodes<D>::Key;
  /// A quadratic surface with the same properties through other points.
  std::shared_ptr<const Surface<D>> through(std::map<Key, Vec<D>> point) const;
  /// The points of a facet.
  std::vector<Vec<D>> of(const Facet<D>& facet) const;

  QuadraticSurface() = default;

  std::map<Key, Vec<D>> point_;
  bool smooth_ = true;
  std::vector<char> inner_;
};

/// The body of a grid (X and cells) with a quadratic surface through `points`. `smooth`: the
/// surface has no edges. Throws InputError if a cell folds.
template <int D>
Geometry<D> quadratic_geometry(Grid<D> grid, const std::vector<Vec<D>>& points, bool smooth = true);

}  // namespace meniscus
