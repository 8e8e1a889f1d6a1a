// SPDX-License-Identifier: BSD-3-Clause
// The one rank of a run that mpirun did not start.
#include "parallel/ranks.hpp"

#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <cstdlib>
#include <stdexcept>

namespace meniscus {
namespace {

std::unique_ptr<Ranks> (*how_to_join)() = nullptr;
thread_local Ranks* of_thread = nullptr;

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

/// Rank and number of processes, from the environment variables of Open MPI's mpirun, of launchers
/// with the process management interface (Hydra, srun --mpi=pmi2), or of srun --mpi=pmix.
Launch launch_in_environment() {
  constexpr const char* names[][2] = {{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"},
                                      {"PMI_RANK", "PMI_SIZE"},
                                      {"PMIX_RANK", "SLURM_STEP_NUM_TASKS"}};
  for (const auto& [rank, size] : names)
    if (const Launch found{number_in(rank, -1), number_in(size, 0)};
        found.rank >= 0 && found.rank < found.size)
      return found;
  return {};
}

constexpr char of_files = 'F', of_input = 'I', of_run = 'S', of_request = 'Q', of_memory = 'M',
               of_program = 'P';

/// Calls `work`. Returns a letter for the kind of exception and its message; empty if there is
/// none.
std::string failure_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const FileError& error) {
    return of_files + std::string(error.what());
  } catch (const InputError& error) {
    return of_input + std::string(error.what());
  } catch (const SolveError& error) {
    return of_run + std::string(error.what());
  } catch (const Interrupted&) {
    return {of_request};
  } catch (const std::bad_alloc&) {
    return {of_memory};
  } catch (const std::exception& error) {
    return of_program + std::string(error.what());
  }
  return {};
}

void fail_as(const std::string& failure) {
  if (failure.empty()) return;
  const std::string said = failure.substr(1);
  if (failure.front() == of_files) throw FileError(said);
  if (failure.front() == of_input) throw InputError(said);
  if (failure.front() == of_run) throw SolveError(said);
  if (failure.front() == of_request) throw Interrupted();
  if (failure.front() == of_memory) throw OutOfMemory();
  throw std::runtime_error(said);
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
  return of_thread ? *of_thread : *present();
}

RanksOfThread::RanksOfThread(Ranks& own) {
  of_thread = &own;
}

RanksOfThread::~RanksOfThread() {
  of_thread = nullptr;
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

std::string Ranks::of_rank(int rank, std::string mine) {
  auto length = static_cast<std::int64_t>(mine.size());
  hand_out(rank, &length, sizeof length);
  mine.resize(static_cast<std::size_t>(length));
  hand_out(rank, mine.data(), mine.size());
  return mine;
}

std::string Ranks::first_said(std::string mine) {
  const std::int64_t before_last = largest(mine.empty() ? 0 : size() - rank());
  return before_last > 0 ? of_rank(size() - static_cast<int>(before_last), std::move(mine))
                         : std::string();
}

void on_first_rank(const std::function<void()>& work) {
  if (ranks().alone()) return work();
  fail_as(ranks().of_rank(0, ranks().first() ? failure_of(work) : std::string()));
}

void on_each_rank(const std::function<void()>& work) {
  if (ranks().alone()) return work();
  fail_as(ranks().first_said(failure_of(work)));
}

void require_alike(const std::string& text, const std::string& name) {
  if (ranks().alone()) return;
  const bool differs = ranks().of_rank(0, text) != text;
  const std::int64_t last = ranks().largest(differs ? ranks().rank() : 0);
  if (last > 0)
    throw FileError(
        fmt::format("the ranks 0 and {} have read another {}; expected is a directory "
                    "that all of them share",
                    last, name));
}

}  // namespace meniscus
