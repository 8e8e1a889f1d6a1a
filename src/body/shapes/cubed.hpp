// SPDX-License-Identifier: BSD-3-Clause
// Grids of the unit disk and ball, for their shape files. The boundary cells of a core lattice
// continue in shells up to the surface.
#pragma once
#include "body/grid/grid.hpp"
#include "input/input.hpp"

namespace meniscus {

/// Shape of the core. A core point q in [-1, 1]^D with s = max|q| is mapped to
///   X = a [(1 - w s) q + b w s^2 dir(q/s)];   dir(p) = tan(pi p / 4) / |tan(pi p / 4)|.
/// A surface point of the core (|q|_max = 1) continues in shell l of m to X + (dir(q) - X) l / m.
/// If shells grow, geometric sums replace l and m.
struct CubedCore {
  Real a, w, b;
};

/// Nodes and cells of the unit disk (D = 2) or ball (D = 3) with core^D + shells 2 D core^(D-1)
/// cells, each shell `grading` times as thick as the one inside. Throws InputError unless core >= 1
/// and shells >= 1.
template <int D>
Grid<D> cubed_ball(int core, int shells, Real grading = 1);

/// The input key `grading` with its range.
template <class S>
Row<S> grading_row(Real S::*member) {
  return real_row("grading", member, dimension::none, {1, 4},
                  "thickness of a shell of cells / that of the one inside: fine in the middle, "
                  "coarse far from it",
                  1.0);
}

/// The cells above the plane x_axis = 0 and their nodes. With an even core the plane runs through
/// nodes and cuts no cell.
template <int D>
Grid<D> upper_half(const Grid<D>& whole, int axis = D - 1);

/// Nodes and cells between the spheres of radius `inner_radius` and 1: `layers` shells of 6 n^2
/// cells. n >= 1 and layers >= 1.
Grid<3> cubed_shell(int n, int layers, Real inner_radius);

/// The ring between the circles of radius `inside` and 1, with nodes at angles of 2 pi k / around
/// from x.
Grid<2> unit_ring(int around, int layers, Real inside);

}  // namespace meniscus
