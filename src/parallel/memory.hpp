// SPDX-License-Identifier: BSD-3-Clause
// Memory that the program has used and memory that is available to it.
#pragma once
#include "numbers/types.hpp"

namespace meniscus {

/// Bytes that the process can still allocate: the free memory of the machine, within the limits of
/// the process (ulimit -v) and of its control group. Infinite if none of them is known.
Real available_memory();

/// The peak of resident memory in bytes since the start, or since the last forget_peak_memory().
Real peak_memory();
/// Restarts the measurement of peak_memory(). Has no effect if the system does not support it.
void forget_peak_memory();

}  // namespace meniscus
