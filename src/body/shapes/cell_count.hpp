// SPDX-License-Identifier: BSD-3-Clause
// Whether a body of so many cells can be numbered and held in memory, asked before it is made.
#pragma once
#include "meniscus/core/types.hpp"

namespace meniscus {

/// Throws InputError if a D-dimensional grid of so many cells cannot be numbered (2e8), or if the
/// body would take more memory than is there.
template <int D>
void require_affordable(Real cells);

}  // namespace meniscus
