// SPDX-License-Identifier: BSD-3-Clause
// Checks, before a body is made, that its cells can be numbered and its particles fit into memory.
#pragma once
#include "input/input.hpp"

#include <string>

namespace meniscus {

/// Allowed numbers of cells along an edge or of layers in a key of a shape, in 2D and in 3D.
inline constexpr Range count_in_plane{1, 10000}, count_in_space{1, 1000};

/// Number of cells along a length that are at most as long as the spacing; at least 1. Round-off
/// adds no cell where the spacing divides the length.
Real cells_along(Real length, Real spacing);

/// Throws InputError if a D-dimensional grid with so many cells cannot be numbered (2e8), or if its
/// particles would need more memory than is available. The estimate is a lower bound.
template <int D>
void require_affordable(Real cells, Real cells_per_particle = 1);

/// Throws InputError if `what` needs more bytes than are available.
void require_memory(Real bytes, const std::string& what);

}  // namespace meniscus
