// SPDX-License-Identifier: BSD-3-Clause
// Memory that the program has used, and that is left to it.
#pragma once
#include "meniscus/core/types.hpp"

namespace meniscus {

/// Bytes that the process can still ask for: what the machine has free, within the limits of the
/// process (ulimit -v) and of its control group. Infinite where nothing is known.
Real available_memory();

/// Bytes that the process has had in memory at most, since forget_peak_memory() where that was
/// called.
Real peak_memory();
/// Does nothing where the system keeps the peak of the whole process only.
void forget_peak_memory();

}  // namespace meniscus
