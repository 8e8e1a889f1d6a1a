// SPDX-License-Identifier: BSD-3-Clause
// A scene run by as many processes as mpirun has started.
#pragma once
#include "app/commands.hpp"

namespace meniscus {

/// Runs a scene as run() does, alone or as one of the ranks. A program that was not linked with MPI
/// calls meniscus-mpi, which lies beside it, with the same `argv` and watches over it: where that
/// is ended by force, it says which rank it was and returns exit_numerical, upon which mpirun ends
/// the others. Throws FileError if meniscus-mpi was not built.
int run_with_ranks(const RunRequest& request, char** argv);

}  // namespace meniscus
