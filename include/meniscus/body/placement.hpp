// SPDX-License-Identifier: BSD-3-Clause
// Maps of scenes: bodies deformed by formulas, turned and moved.
#pragma once
#include "meniscus/body/geometry.hpp"
#include "meniscus/core/input.hpp"

#include <vector>

namespace meniscus {

/// x_i(X) by D formulas of the place, with their exact derivatives.
template <int D>
SmoothMap<D> formula_map(std::vector<Expression> formulas);

/// The body after `map`, with its director, if it has one: that of an unmapped wall at X0 turns to
/// F^-T N at x(X0). Throws InputError naming a place X0 if the map is not finite or det F <= 0
/// there.
template <int D>
Geometry<D> placed(const SmoothMap<D>& map, Geometry<D> geometry);

/// Reads and applies what any [[body]] may have: `map`, D formulas of the place in the shape, then
/// `rotate`, an angle about the middle of the body (3D: and `rotate_axis`), then `move`. Problems
/// are noted in the block, with the geometry as it was.
template <int D>
Geometry<D> read_placement(const Block& block, Geometry<D> geometry);

}  // namespace meniscus
