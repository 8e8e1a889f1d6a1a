// SPDX-License-Identifier: BSD-3-Clause
// Starts a rank of a run and watches over it.
#include "app/rank_process.hpp"

#include "app/child.hpp"
#include "app/hand_over.hpp"
#include "meniscus/error.hpp"
#include "parallel/ranks.hpp"

#include <fmt/core.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>

namespace meniscus {
namespace {

std::string host() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

int watch_over_rank(char** argv) {
  const std::filesystem::path program = own_directory() / "meniscus-mpi";
  std::error_code error;
  if (!std::filesystem::exists(program, error))
    throw FileError(
        fmt::format("'{}' is not there, which runs on several ranks: it is built by "
                    "cmake -DMENISCUS_MPI=ON; without it start one process",
                    program.string()));
  Children rank;
  const int status = rank.call(program.string(), argv);
  if (!WIFSIGNALED(status)) return WEXITSTATUS(status);
  if (rank.signal() == WTERMSIG(status)) return exit_signal + WTERMSIG(status);
  // print_complaint() prints on rank 0 only, but only this process has seen the end of its rank.
  fmt::print(stderr,
             "the run failed: rank {} of {} on {} was ended by signal {}; --restart continues from "
             "the newest checkpoint\n",
             launch().rank, launch().size, host(), WTERMSIG(status));
  return exit_numerical;
}

}  // namespace

int run_with_ranks(const RunRequest& request, char** argv) {
  if (launch().size == 1) return run(request);
  if (!can_join_ranks()) return watch_over_rank(argv);
  join_ranks();
  return run(request);
}

}  // namespace meniscus
