// SPDX-License-Identifier: BSD-3-Clause
// Whether bodies of so many cells can be numbered and held in memory, asked before they are made.
#pragma once
#include "meniscus/core/input.hpp"

#include <string>

namespace meniscus {

/// Numbers of cells along an edge or through a layer that a key of a shape may give.
inline constexpr Range count_in_plane{1, 10000}, count_in_space{1, 1000};

/// Throws InputError if a D-dimensional grid of so many cells cannot be numbered (2e8), or if its
/// particles would take more memory than is there even with the narrowest supports, in single
/// precision.
template <int D>
void require_affordable(Real cells, Real cells_per_particle = 1);

/// Throws InputError if `what` takes more bytes than are there.
void require_memory(Real bytes, const std::string& what);

}  // namespace meniscus
