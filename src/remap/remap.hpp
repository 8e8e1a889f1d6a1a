// SPDX-License-Identifier: BSD-3-Clause
// Remap of a body: it is referred anew to where it is now, and its motion is carried over.
#pragma once
#include "body/reference.hpp"
#include "remap/reseed.hpp"
#include "solve/system.hpp"

#include <memory>
#include <span>

namespace meniscus {

/// A new reference for a body, and the material points that its particles and nodal cells are to
/// be at, by their places in the old one.
template <int D>
struct Remap {
  std::shared_ptr<const Reference<D>> reference;
  std::vector<Vec<D>> nodes;  ///< [particle] of the new reference
};

/// Places for the nodes of a body in its present configuration: those of its particles, stretched
/// about their middle by so little that the recovered surface encloses the present volume. Else a
/// stiff fluid would be under another pressure. `volume_change` as in remap(); throws as that.
template <int D>
std::vector<Vec<D>> present_nodes(const Body<D>& body, const NodalVector* u,
                                  std::span<const Real> volume_change);

/// The nodes where the particles are in the present configuration, and the surface the patches
/// through their present points: edges stay. `u` is that of the body. Throws SolveError if shape
/// functions cannot be built.
template <int D>
Seeds<D> on_present_patches(const Body<D>& body, const NodalVector* u);

/// Refers a body to its present configuration, with the same cells and their nodes at `seeds`;
/// those on its boundary lie on its present surface. `volume_change` is J - 1 of its nodal cells,
/// relative to the reference of the scene.
///
/// A nodal cell of the new reference has the J of the material point that its centroid is at, times
/// one number for all, so that the volume sum V/J_0 in the reference of the scene stays. Throws
/// InputError if a cell folds, SolveError if there is no material at a place.
template <int D>
Remap<D> remap(const Body<D>& body, const NodalVector* u, Seeds<D> seeds,
               std::span<const Real> volume_change);

/// The state of a system that was built again, of bodies with the same names and numbers of
/// particles; `remaps`, by body, say which of them have a new reference. Such a body is at u = 0.
/// Its velocities are those of the material points, sum_B N'_B(X'_A) v'_B = v(X_A), and so are the
/// values of other fields; then a rigid motion is added so that its momentum and angular momentum
/// are those before, to round-off. Forces are not valid yet.
template <int D>
State carried(const System<D>& before, const State& state, const System<D>& after,
              const std::map<std::string, Remap<D>>& remaps);

}  // namespace meniscus
