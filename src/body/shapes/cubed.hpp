// SPDX-License-Identifier: BSD-3-Clause
// Grids of the unit disk and ball: a lattice core whose boundary cells continue in shells to the
// surface. One construction for both, used by their shape files only.
#pragma once
#include "body/grid/grid.hpp"
#include "input/input.hpp"

namespace meniscus {

/// Shape of the core. A core point q in [-1, 1]^D with s = max|q| goes to
///   X = a [(1 - w s) q + b w s^2 dir(q/s)],   dir(p) = tan(pi p / 4) / |tan(pi p / 4)|,
/// and shell l of m to X + (dir(q) - X) l / m for |q|_max = 1, or by geometric sums instead of l
/// and m where shells grow.
struct CubedCore {
  Real a, w, b;
};

/// Nodes and cells of the unit disk (D = 2) or ball (D = 3) with core^D + shells 2 D core^(D-1)
/// cells, each shell `grading` times as thick as the one inside. Throws InputError unless core >= 1
/// and shells >= 1.
template <int D>
Grid<D> cubed_ball(int core, int shells, Real grading = 1);

/// How `grading` is called and what it may be.
template <class S>
Row<S> grading_row(Real S::*member) {
  return real_row("grading", member, dimension::none, {1, 4},
                  "thickness of a shell of cells / that of the one inside: fine in the middle, "
                  "coarse far from it",
                  1.0);
}

/// The cells above x_axis = 0 and their nodes; an even core has nodes, and no cells, across that
/// plane.
template <int D>
Grid<D> upper_half(const Grid<D>& whole, int axis = D - 1);

/// Nodes and cells between the spheres of radius `inner_radius` and 1: `layers` shells of 6 n^2
/// cells. n >= 1 and layers >= 1.
Grid<3> cubed_shell(int n, int layers, Real inner_radius);

}  // namespace meniscus
