// SPDX-License-Identifier: BSD-3-Clause
// Surfaces recovered from the grid alone: of imported or reseeded bodies.
#pragma once
#include "body/shapes/geometry.hpp"

#include <vector>

namespace meniscus {

/// A smooth surface through the nodes of the boundary facets. At each node the height above the
/// tangent plane is a quadratic polynomial: the least-squares fit to the nodes within two rings of
/// facets, with weights that fall to zero at 1.2 times the largest distance. On a facet the
/// surfaces of its corners are blended multilinearly, so neighbours meet without a gap. Positions
/// are of order h^3 at least, normals h^2, curvatures h (on an ellipsoid: 3.9, 2.6 and 2).
template <int D>
class RecoveredSurface final : public Surface<D> {
 public:
  /// Throws InputError if the surface has an edge or corner.
  explicit RecoveredSurface(const Grid<D>& grid);
  /// Returns null if the surface has an edge or corner.
  static std::shared_ptr<const RecoveredSurface> if_smooth(const Grid<D>& grid);
  /// The surface of facets that form a part of a surface up to its edges; works for few facets,
  /// too.
  static std::shared_ptr<const RecoveredSurface> of_piece(const Grid<D>& grid);

  SurfacePoints<D> points(const Grid<D>& grid, int k, SurfacePart part) const override;
  Vec<D> point(const Grid<D>& grid, const Facet<D>& facet, const Vec<D - 1>& xi) const override;
  bool smooth() const override { return true; }
  bool hollow() const override;
  std::shared_ptr<const Surface<D>> renumbered(std::span<const Index> order) const override;
  /// Recovered again from the mapped nodes.
  std::shared_ptr<const Surface<D>> mapped(const SmoothMap<D>& map,
                                           const Grid<D>& grid) const override;

 private:
  /// The surface around a node: X + t s + n h(s), h = slope.s + s.bend s / 2.
  struct Quadric {
    Vec<D> X, n;
    Eigen::Matrix<Real, D, D - 1> t;
    Vec<D - 1> slope;
    Mat<D - 1> bend;
    bool inner;  ///< on a closed part of the surface that bounds a cavity
  };
  struct Place;

  RecoveredSurface() = default;
  void recover(const Grid<D>& grid, Real least_curvature);
  const Quadric& around(Index node) const { return at(quadrics_, at(number_, node)); }
  Place blended(const Grid<D>& grid, const Facet<D>& facet, const Vec<D - 1>& xi) const;

  std::vector<Quadric> quadrics_;
  std::vector<Index> number_;  ///< [node] number of its quadric; -1: inside the body
};

/// The body of a grid (X and cells) with a recovered surface. Throws InputError if the surface has
/// an edge or corner or if a cell folds.
template <int D>
Geometry<D> recovered_geometry(Grid<D> grid);

}  // namespace meniscus
