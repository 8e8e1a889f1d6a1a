// SPDX-License-Identifier: BSD-3-Clause
// The smallest distance between two particles of the same body.
#pragma once
#include "body/body.hpp"

#include <deque>

namespace meniscus {

/// The smallest distance over all bodies, in their references. All processes call this.
template <int D>
Real least_spacing(const std::deque<Body<D>>& bodies);

}  // namespace meniscus
