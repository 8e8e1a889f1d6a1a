// SPDX-License-Identifier: BSD-3-Clause
// The reference configuration of a body after updates of the reference during a run.
#pragma once
#include "body/shapes/geometry.hpp"
#include "state/archive.hpp"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace meniscus {

/// The state that a body is built on after an update of the reference, instead of the geometry of
/// its scene. J = J_0 det F is the volume ratio to the reference of the scene, with F from this
/// reference. Laws use J, and formulas of the position use the position in the reference of the
/// scene.
template <int D>
struct Reference {
  Geometry<D> geometry;             ///< nodes in the order of the particles
  bool recovered = false;           ///< the surface is a RecoveredSurface
  std::vector<Vec<D>> surface;      ///< points of a QuadraticSurface; empty: another kind
  std::vector<Vec<D>> origin;       ///< [particle] position in the reference of the scene
  std::vector<Vec<D>> cell_origin;  ///< [particle] the same for the centroid of its nodal cell
  std::vector<Real> volume_ratio;   ///< [particle] J_0 of its nodal cell
  Real mass = 0;                    ///< of the body

  /// The reference of the scene itself; the nodes of `geometry` are in the order of the particles.
  static Reference of_scene(Geometry<D> geometry, Real mass);

  /// True if no volume has changed.
  bool undeformed() const;
  /// Saves or reads. To read, call it on the reference of the scene of the same body. Throws
  /// FileError.
  void archive(const Archive& a);
};

/// Reference configurations by the name of the body, after remaps. A body without an entry starts
/// from the shape that the scene describes.
template <int D>
using References = std::map<std::string, std::shared_ptr<const Reference<D>>>;

/// The geometry of the same cells with the nodes at X, in the order of `geometry`. If `recovered`,
/// the surface is recovered from the facets. Otherwise it stays the surface of the shape, and no
/// boundary node may have moved. Throws InputError if a cell folds or a surface to recover has
/// edges.
template <int D>
Geometry<D> moved(const Geometry<D>& geometry, std::vector<Vec<D>> X, bool recovered);

}  // namespace meniscus
