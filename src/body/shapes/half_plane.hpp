// SPDX-License-Identifier: BSD-3-Clause
// The half plane of a body of revolution (axisymmetry note 2).
#pragma once
#include "body/shapes/geometry.hpp"

namespace meniscus {

/// The part x >= 0 of a body, turned about the axis x = 0: Grid::revolved is set, and nodes up to a
/// billionth of the body away from the axis are moved to it. Throws InputError if cells cross the
/// axis or no cell is beyond it.
Geometry<2> half_plane(Geometry<2> geometry);

}  // namespace meniscus
