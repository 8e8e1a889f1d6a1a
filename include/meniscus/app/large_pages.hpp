// SPDX-License-Identifier: BSD-3-Clause
// Memory in pages of 2 MB.
#pragma once

namespace meniscus {

/// Begins the program anew, once, with a C library that takes memory from the system in pages of 2
/// MB, unless GLIBC_TUNABLES of the environment says how it shall. `argv`: that of main.
void begin_with_large_pages(char** argv);

}  // namespace meniscus
