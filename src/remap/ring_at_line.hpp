// SPDX-License-Identifier: BSD-3-Clause
// The contact line of a drop as a ring of nodes of its grid.
#pragma once
#include "remap/moving_nodes.hpp"
#include "remap/reseed.hpp"

namespace meniscus {

/// Places a ring of nodes on the contact line, at equal angles around the middle of the wetted
/// area, and holds it there. In 2D the ring is the two ends of that area. Without a contact line
/// nothing happens.
template <int D>
void hold_at_line(const ContactLine<D>& line, Real time, const Grid<D>& grid,
                  const PresentSurface<D>& surface, MovingNodes<D>& nodes);

}  // namespace meniscus
