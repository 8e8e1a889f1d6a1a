// SPDX-License-Identifier: BSD-3-Clause
// Shape imperfections: smooth random displacements of a body.
#pragma once
#include "body/shapes/geometry.hpp"

#include <cstdint>

namespace meniscus {

/// The body after a smooth random displacement with root mean square length `rms` over its nodes.
/// It is a sum of 24 plane waves with random directions and phases, with wavelengths of half to one
/// length of the body. Surfaces stay exact and the director stays normal to the wall. The result
/// depends on the seed only, not on the machine. Throws InputError if a cell folds.
template <int D>
Geometry<D> with_imperfection(Geometry<D> geometry, Real rms, std::uint64_t seed);

}  // namespace meniscus
