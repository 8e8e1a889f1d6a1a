// SPDX-License-Identifier: BSD-3-Clause
// Surfaces of bodies that are known by their grid alone: imported, or seeded anew.
#pragma once
#include "meniscus/body/geometry.hpp"

#include <vector>

namespace meniscus {

/// A smooth surface through the nodes of the boundary facets. At each node the height above the
/// tangent plane is the quadratic polynomial that fits the nodes of the facets within two rings
/// best (least squares, weights falling to zero at 1.2 of their distance). A facet is the
/// multilinear blend of those of its corners: neighbours meet without a gap; places are of order
/// h^3 at least, normals h^2, curvatures h (on an ellipsoid: 3.9, 2.6 and 2).
template <int D>
class RecoveredSurface final : public Surface<D> {
 public:
  /// Throws InputError if facets meet at an edge or a corner.
  explicit RecoveredSurface(const Grid<D>& grid);
  /// Null if facets meet at an edge or a corner.
  static std::shared_ptr<const RecoveredSurface> if_smooth(const Grid<D>& grid);
  /// Of facets that are a part of a surface up to its edges, however few they are.
  static std::shared_ptr<const RecoveredSurface> of_piece(const Grid<D>& grid);

  SurfacePoints<D> points(const Grid<D>& grid, int k, SurfacePart part) const override;
  Vec<D> point(const Grid<D>& grid, const Facet<D>& facet, const Vec<D - 1>& xi) const override;
  bool smooth() const override { return true; }
  bool hollow() const override;
  std::shared_ptr<const Surface<D>> renumbered(std::span<const Index> order) const override;
  /// Recovered anew from the mapped nodes.
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
  std::vector<Index> number_;  ///< [node] of its quadric; -1: inside the body
};

/// The body of a grid (X and cells), its surface recovered. Throws InputError as RecoveredSurface,
/// or if a cell folds.
template <int D>
Geometry<D> recovered_geometry(Grid<D> grid);

}  // namespace meniscus
