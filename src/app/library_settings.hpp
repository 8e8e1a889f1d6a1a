// SPDX-License-Identifier: BSD-3-Clause
// Settings that the C library and OpenMP read only when a program starts.
#pragma once

namespace meniscus {

/// Restarts the program once with two settings in its environment, unless they are set already.
/// GLIBC_TUNABLES makes malloc use pages of 2 MB. GOMP_SPINCOUNT makes waiting threads spin for
/// microseconds before they sleep; it is not set if OMP_WAIT_POLICY is. `argv` is the argument of
/// main().
void begin_with_settings(char** argv);

}  // namespace meniscus
