// SPDX-License-Identifier: BSD-3-Clause
// The smallest distance between two particles of a body.
#pragma once
#include "body/body.hpp"

#include <deque>

namespace meniscus {

/// Of all bodies, in their references; length. All ranks call this.
template <int D>
Real least_spacing(const std::deque<Body<D>>& bodies);

}  // namespace meniscus
