// SPDX-License-Identifier: BSD-3-Clause
// The contact line of a drop as a ring of nodes of its grid.
#pragma once
#include "remap/moving_nodes.hpp"
#include "remap/reseed.hpp"

namespace meniscus {

/// Puts a ring of nodes on the contact line, evenly about the middle of the wetted facets, and holds
/// it there. In 2D it is the two ends of the wetted part. Without a contact line nothing happens.
template <int D>
void hold_at_line(const ContactLine<D>& line, Real time, const Grid<D>& grid,
                  const PresentSurface<D>& surface, MovingNodes<D>& nodes);

}  // namespace meniscus
