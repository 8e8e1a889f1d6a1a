// SPDX-License-Identifier: BSD-3-Clause
// Child processes: signals are forwarded to the child, and its output is read through a pipe.
#include "app/child.hpp"

#include "meniscus/error.hpp"

#include <fmt/core.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

namespace meniscus {
namespace {

volatile std::sig_atomic_t handed = 0, running = 0;
constexpr int handed_on[] = {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGXCPU};

void hand_on(int signal) {
  const int error = errno;
  if (handed == 0) handed = signal;
  if (running != 0) kill(running, signal);
  errno = error;
}

void hand_signals_to(void (*handler)(int)) {
  for (const int signal : handed_on) {
    struct sigaction action {};
    sigaction(signal, nullptr, &action);
    if (action.sa_handler == SIG_IGN) continue;  // ignored by nohup, for example
    action.sa_handler = handler;
    sigaction(signal, &action, nullptr);
  }
}

[[noreturn]] void child_failed(const char* doing, int error) {
  throw FileError(fmt::format("cannot {}: {}", doing, std::strerror(error)));
}

std::string read_all(int file) {
  std::string text;
  std::array<char, 4096> piece{};
  for (;;) {
    const ssize_t n = ::read(file, piece.data(), piece.size());
    if (n == 0 || (n < 0 && errno != EINTR)) return text;
    if (n > 0) text.append(piece.data(), static_cast<std::size_t>(n));
  }
}

/// Starts the program and returns its process id. `pipe_in` and `pipe_out` are the two ends of the
/// pipe for its output.
pid_t start(const std::vector<std::string>& arguments, int pipe_in, int pipe_out) {
  std::vector<char*> words{const_cast<char*>("meniscus")};
  for (const std::string& argument : arguments)
    words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  posix_spawn_file_actions_t actions{};
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, pipe_out, STDOUT_FILENO);
  posix_spawn_file_actions_addclose(&actions, pipe_in);
  posix_spawn_file_actions_addclose(&actions, pipe_out);
  pid_t process = 0;
  const int error =
      posix_spawn(&process, "/proc/self/exe", &actions, nullptr, words.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) child_failed("start this program again", error);
  return process;
}

void hand_on_to(pid_t process) {
  running = process;
  if (handed != 0) kill(process, handed);  // the signal came before `running` was set
}

int status_at_end(pid_t process) {
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  running = 0;
  return status;
}

}  // namespace

Child::Child() {
  handed = 0;
  hand_signals_to(hand_on);
}

Child::~Child() {
  if (handed == 0) hand_signals_to(SIG_DFL);  // `timeout` may send the signal twice
}

ChildEnd Child::call(const std::vector<std::string>& arguments) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) child_failed("make a pipe", errno);
  const pid_t process = start(arguments, ends[0], ends[1]);
  hand_on_to(process);
  close(ends[1]);
  ChildEnd end{0, read_all(ends[0])};
  close(ends[0]);
  const int status = status_at_end(process);
  end.exit_code = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  return end;
}

int Child::call(const std::string& program, char** argv) {
  pid_t process = 0;
  if (const int error = posix_spawn(&process, program.c_str(), nullptr, nullptr, argv, environ))
    child_failed(fmt::format("start '{}'", program).c_str(), error);
  hand_on_to(process);
  return status_at_end(process);
}

std::optional<int> Child::signal() const {
  return handed == 0 ? std::nullopt : std::optional<int>(handed);
}

}  // namespace meniscus
