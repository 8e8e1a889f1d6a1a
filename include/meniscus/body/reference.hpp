// SPDX-License-Identifier: BSD-3-Clause
// The reference of a body that was referred anew during a run: to where its particles had come.
#pragma once
#include "meniscus/body/geometry.hpp"
#include "meniscus/core/archive.hpp"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace meniscus {

/// What a body is built on instead of the geometry of its scene, and what its material had gone
/// through by then. J = J_0 det F, with F from this reference on, is the volume relative to that in
/// the reference of the scene, in which laws are written; so are formulas of the reference
/// position.
template <int D>
struct Reference {
  Geometry<D> geometry;             ///< nodes in the order of the particles
  bool recovered = false;           ///< the surface is a RecoveredSurface, not that of the shape
  std::vector<Vec<D>> surface;      ///< points of a QuadraticSurface; empty: it is another one
  std::vector<Vec<D>> origin;       ///< [particle] its place in the reference of the scene
  std::vector<Vec<D>> cell_origin;  ///< [particle] that of the centroid of its nodal cell
  std::vector<Real> volume_ratio;   ///< [particle] J_0 of its nodal cell
  Real mass = 0;                    ///< of the body

  /// Of the body in the reference of its scene; `geometry` has the order of the particles.
  static Reference of_scene(Geometry<D> geometry, Real mass);

  /// Whether no volume has changed.
  bool undeformed() const;
  /// Reading begins with the reference of the scene of the same body. Throws FileError.
  void archive(const Archive& a);
};

/// By the name of the body. A body without one has the reference of its scene.
template <int D>
using References = std::map<std::string, std::shared_ptr<const Reference<D>>>;

/// The geometry of the same cells with their nodes at X, in the order of `geometry`. The surface is
/// that of the shape where no node of the boundary has moved, else one recovered from the facets,
/// and `recovered` says so. Throws InputError if a cell folds, or if there are edges in a surface
/// to be recovered.
template <int D>
Geometry<D> moved(const Geometry<D>& geometry, std::vector<Vec<D>> X, bool recovered);

}  // namespace meniscus
