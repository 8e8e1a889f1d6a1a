// SPDX-License-Identifier: BSD-3-Clause
// Random numbers that do not depend on the standard library.
#pragma once
#include "numbers/types.hpp"

#include <random>

namespace meniscus {

/// Uniform in [0, 1), from the upper 53 bits.
inline Real uniform(std::mt19937_64& bits) {
  return static_cast<Real>(bits() >> 11) * 0x1p-53;
}

/// Uniform in [-1, 1).
inline Real symmetric_uniform(std::mt19937_64& bits) {
  return 2 * uniform(bits) - 1;
}

}  // namespace meniscus
