// SPDX-License-Identifier: BSD-3-Clause
// Memory that is left to the program.
#pragma once
#include "meniscus/core/types.hpp"

namespace meniscus {

/// Bytes that the process can still ask for: what the machine has free, within the limits of the
/// process (ulimit -v) and of its control group. Infinite where nothing is known.
Real available_memory();

}  // namespace meniscus
