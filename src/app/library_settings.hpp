// SPDX-License-Identifier: BSD-3-Clause
// Settings of the C library and of OpenMP that they read once, where a program begins.
#pragma once

namespace meniscus {

/// Begins the program anew, once, with these in its environment where it says nothing of them:
/// memory in pages of 2 MB (GLIBC_TUNABLES), threads that wait for each other for microseconds
/// before they sleep (GOMP_SPINCOUNT, unless there is OMP_WAIT_POLICY). `argv`: that of main.
void begin_with_settings(char** argv);

}  // namespace meniscus
