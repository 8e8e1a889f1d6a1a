// SPDX-License-Identifier: BSD-3-Clause
// The one rank of a run that mpirun did not start.
#include "meniscus/core/ranks.hpp"

#include "meniscus/core/error.hpp"

#include <cstdlib>
#include <stdexcept>

namespace meniscus {
namespace {

std::unique_ptr<Ranks> (*how_to_join)() = nullptr;

std::unique_ptr<Ranks>& present() {
  static auto all = std::make_unique<Ranks>();
  return all;
}

/// A number of the environment; `otherwise` if there is none.
int number_in(const char* variable, int otherwise) {
  const char* text = std::getenv(variable);
  char* end = nullptr;
  const long number = text ? std::strtol(text, &end, 10) : 0;
  return text && end != text && *end == '\0' ? static_cast<int>(number) : otherwise;
}

/// Of Open MPI, and of what speaks the process management interface (Slurm, Hydra).
Launch launch_in_environment() {
  constexpr const char* names[][2] = {{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"},
                                      {"PMI_RANK", "PMI_SIZE"}};
  for (const auto& [rank, size] : names)
    if (const Launch found{number_in(rank, -1), number_in(size, 0)};
        found.rank >= 0 && found.rank < found.size)
      return found;
  return {};
}

}  // namespace

const Launch& launch() {
  static const Launch found = launch_in_environment();
  return found;
}

std::unique_ptr<Exchange> Ranks::exchange(Index, const std::vector<Leaf>&) {
  throw std::logic_error("a rank that is alone exchanges nothing");
}

int Ranks::leave(int exit_code, const std::string&) {
  return exit_code;
}

Ranks& ranks() {
  return *present();
}

bool can_join_ranks() {
  return how_to_join != nullptr;
}

void join_ranks() {
  present() = how_to_join();
}

bool register_ranks(std::unique_ptr<Ranks> (*join)()) {
  how_to_join = join;
  return true;
}

void on_first_rank(const std::function<void()>& work) {
  if (ranks().alone()) return work();
  constexpr char of_files = 'F', of_run = 'S';
  std::string failure;  // its kind, then what it says
  if (ranks().first()) try {
      work();
    } catch (const FileError& error) {
      failure = of_files + std::string(error.what());
    } catch (const SolveError& error) {
      failure = of_run + std::string(error.what());
    }
  failure = ranks().of_first(failure);
  if (failure.empty()) return;
  if (failure.front() == of_run) throw SolveError(failure.substr(1));
  throw FileError(failure.substr(1));
}

}  // namespace meniscus
