// SPDX-License-Identifier: BSD-3-Clause
// Shape imperfections.
#pragma once
#include "meniscus/body/geometry.hpp"

#include <cstdint>

namespace meniscus {

/// The body after a smooth random displacement of the root mean square length `rms` over its nodes:
/// 24 plane waves with random directions and phases, half as long to as long as the body. Surfaces
/// stay exact, and a director stays normal to its layers. The same seed gives the same body on
/// every machine. Throws InputError if a cell folds.
template <int D>
Geometry<D> with_imperfection(Geometry<D> geometry, Real rms, std::uint64_t seed);

}  // namespace meniscus
