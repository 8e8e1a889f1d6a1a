// SPDX-License-Identifier: BSD-3-Clause
// Maps in scenes: bodies deformed by formulas, rotated and moved.
#pragma once
#include "body/shapes/geometry.hpp"
#include "input/input.hpp"

#include <vector>

namespace meniscus {

/// The map x_i(X) given by D formulas of the place, with exact derivatives.
template <int D>
SmoothMap<D> formula_map(std::vector<Expression> formulas);

/// The body after `map`. A director N of the wall at X0 becomes F^-T N at x(X0), normalised. Throws
/// InputError naming a place X0 if the map is not finite or det F <= 0 there.
template <int D>
Geometry<D> placed(const SmoothMap<D>& map, Geometry<D> geometry);

/// Reads and applies the keys that every [[body]] may have: `map` (D formulas of the place), then
/// `rotate` (an angle about the middle of the body; 3D: with `rotate_axis`), then `move`. Problems
/// are noted in the block; the geometry is then returned unchanged.
template <int D>
Geometry<D> read_placement(const Block& block, Geometry<D> geometry);

}  // namespace meniscus
