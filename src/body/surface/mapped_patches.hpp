// SPDX-License-Identifier: BSD-3-Clause
// Exact surfaces: patches of a unit shape and a smooth map onto the body.
#pragma once
#include "body/surface/reference_surface.hpp"

#include <string>
#include <utility>
#include <vector>

namespace meniscus {

/// A piece of the surface of a unit shape: plane (2D: line) or round (sphere, cylinder, circle).
template <int D>
struct SurfacePatch {
  /// Projection of a point onto the patch, with the derivative of the projection.
  struct Foot {
    Vec<D> X, N;        ///< nearest point of the patch, outward unit normal there
    Mat<D> grad_N;      ///< N_K,L along the surface
    Mat<D> derivative;  ///< dX_foot / dX
  };

  static SurfacePatch plane(const Vec<D>& point, const Vec<D>& normal);
  static SurfacePatch sphere(const Vec<D>& centre, Real radius);  ///< in 2D a circle
  static SurfacePatch cavity(const Vec<D>& centre, Real radius);  ///< the normal points inwards
  /// A cylinder with the given radius about the line through `point` along the unit vector `axis`.
  static SurfacePatch cylinder(const Vec<D>& point, const Vec<D>& axis, Real radius);

  Foot project(const Vec<D>& X) const;
  Real distance(const Vec<D>& X) const { return (project(X).X - X).norm(); }
  bool inner() const { return radius < 0; }
  /// Sets the name of the face that the patch belongs to.
  SurfacePatch named(std::string face) && {
    name = std::move(face);
    return std::move(*this);
  }

  Vec<D> origin = Vec<D>::Zero();
  /// Orthogonal projection onto the directions in which the patch is round; zero for a plane.
  Mat<D> round = Mat<D>::Zero();
  Vec<D> normal = Vec<D>::Zero();  ///< of a plane
  Real radius = 0;                 ///< of a round patch; negative if it bounds a cavity
  std::string name = {};           ///< name of the face that it belongs to
};

/// A surface made of patches. Points of a facet are projected onto its patch of the unit shape,
/// with exact tangents, and then mapped.
template <int D>
class MappedPatches final : public Surface<D> {
 public:
  /// `unit_X`: positions of the nodes in the unit shape; boundary nodes lie on the patches. Facets
  /// of the grid have the numbers of their patches.
  MappedPatches(std::vector<Vec<D>> unit_X, std::vector<SurfacePatch<D>> patches, bool smooth,
                SmoothMap<D> map);

  SurfacePoints<D> points(const Grid<D>& grid, int k, SurfacePart part) const override;
  Vec<D> point(const Grid<D>& grid, const Facet<D>& facet, const Vec<D - 1>& xi) const override;
  bool smooth() const override { return smooth_; }
  bool hollow() const override;
  std::string face_name(int patch) const override { return at(patches_, patch).name; }
  std::shared_ptr<const Surface<D>> renumbered(std::span<const Index> order) const override;
  std::shared_ptr<const Surface<D>> mapped(const SmoothMap<D>& map,
                                           const Grid<D>& grid) const override;

  const std::vector<Vec<D>>& unit_X() const { return unit_X_; }
  const std::vector<SurfacePatch<D>>& patches() const { return patches_; }
  /// The map from the unit shape to the body.
  const SmoothMap<D>& map() const { return map_; }

 private:
  std::vector<Vec<D>> unit_X_;
  std::vector<SurfacePatch<D>> patches_;
  bool smooth_;
  SmoothMap<D> map_;
};

/// `surface` as MappedPatches. Throws std::logic_error if it is another kind of surface.
template <int D>
const MappedPatches<D>& mapped_patches(const Surface<D>& surface);

}  // namespace meniscus
