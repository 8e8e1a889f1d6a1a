// SPDX-License-Identifier: BSD-3-Clause
// Remap of a body: its present configuration becomes its reference, and its motion is transferred.
#pragma once
#include "body/reference.hpp"
#include "remap/reseed.hpp"
#include "solve/system.hpp"

#include <memory>
#include <span>

namespace meniscus {

/// A new reference of a body. `nodes` are the positions, in the old reference, of the material
/// points that become the particles of the new one.
template <int D>
struct Remap {
  std::shared_ptr<const Reference<D>> reference;
  std::vector<Vec<D>> nodes;  ///< [particle of the new reference]
};

/// Node positions in the present configuration: the particle positions, stretched slightly about
/// their middle until the recovered surface encloses the present volume. Otherwise the pressure of
/// a stiff fluid would change. `volume_change` is as in remap(). Throws like remap().
template <int D>
std::vector<Vec<D>> present_nodes(const Body<D>& body, const NodalVector* u,
                                  std::span<const Real> volume_change);

/// Seeds with nodes at the present positions of the particles, and with a surface of patches
/// through their present points, so that edges are kept. `u` has the displacement coefficients of
/// the body. Throws SolveError if shape functions cannot be built.
template <int D>
Seeds<D> on_present_patches(const Body<D>& body, const NodalVector* u);

/// Makes the present configuration of a body its new reference, with the same cells and their nodes
/// at `seeds`. Seeds of boundary nodes must lie on the present surface. `volume_change` is J - 1 of
/// the nodal cells, relative to the reference of the scene.
///
/// A new nodal cell gets the J of the material point at its centroid, times a common factor. The
/// factor keeps sum V/J_0, the volume of the body in the reference of the scene. Throws InputError
/// if a cell folds, and SolveError if a position has no material.
template <int D>
Remap<D> remap(const Body<D>& body, const NodalVector* u, Seeds<D> seeds,
               std::span<const Real> volume_change);

/// Transfers the state of the system `before` to the rebuilt system `after`, whose bodies have the
/// same names and numbers of particles. `remaps` contains the bodies with a new reference, by name.
/// Such a body gets u = 0. Its velocity at material points is kept, sum_B N'_B(X'_A) v'_B = v(X_A),
/// and so are the values of other fields. Then a rigid motion is added that restores momentum and
/// angular momentum to round-off. The forces of the returned state are not valid yet.
template <int D>
State carried(const System<D>& before, const State& state, const System<D>& after,
              const std::map<std::string, Remap<D>>& remaps);

}  // namespace meniscus
