// SPDX-License-Identifier: BSD-3-Clause
// Runs a scene on several processes (ranks) that mpirun has started.
#pragma once
#include "app/commands.hpp"

namespace meniscus {

/// Runs a scene like run(), alone or as one rank of several. A program that is not linked with MPI
/// starts meniscus-mpi, which lies beside it, with the same `argv` and waits for it. If
/// meniscus-mpi is killed, this function prints the number of the rank and returns exit_numerical;
/// mpirun then ends the other ranks. Throws FileError if meniscus-mpi was not built.
int run_with_ranks(const RunRequest& request, char** argv);

}  // namespace meniscus
