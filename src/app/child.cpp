// SPDX-License-Identifier: BSD-3-Clause
// Child processes: signals are forwarded to all of them, and their outputs are files in memory.
#include "app/child.hpp"

#include "meniscus/error.hpp"

#include <fmt/core.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

namespace meniscus {
namespace {

volatile std::sig_atomic_t handed = 0;
volatile std::sig_atomic_t running[Children::most] = {};  // 0: none
constexpr int handed_on[] = {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGXCPU};

void hand_on(int signal) {
  const int error = errno;
  if (handed == 0) handed = signal;
  for (const volatile std::sig_atomic_t& process : running)
    if (process != 0) kill(process, signal);
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

/// The text of a file, which is closed.
std::string text_in(int file) {
  std::string text;
  std::array<char, 4096> piece{};
  lseek(file, 0, SEEK_SET);
  for (;;) {
    const ssize_t n = ::read(file, piece.data(), piece.size());
    if (n > 0) text.append(piece.data(), static_cast<std::size_t>(n));
    if (n == 0 || (n < 0 && errno != EINTR)) break;
  }
  close(file);
  return text;
}

/// Starts this program, which writes its output into a file, and returns its process id.
pid_t start_again(const std::vector<std::string>& arguments, int output) {
  std::vector<char*> words{const_cast<char*>("meniscus")};
  for (const std::string& argument : arguments)
    words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  posix_spawn_file_actions_t actions{};
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  pid_t process = 0;
  const int error =
      posix_spawn(&process, "/proc/self/exe", &actions, nullptr, words.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) child_failed("start this program again", error);
  return process;
}

void hand_on_to(pid_t process) {
  *std::find(std::begin(running), std::end(running), 0) = process;
  if (handed != 0) kill(process, handed);  // the signal came before `running` was set
}

/// Waits for the end of a process, or of any if it is -1; returns which, and its status.
std::pair<pid_t, int> end_of(pid_t process) {
  int status = 0;
  pid_t ended = 0;
  while ((ended = waitpid(process, &status, 0)) < 0 && errno == EINTR) {
  }
  if (ended < 0) child_failed("wait for a process", errno);
  std::replace(std::begin(running), std::end(running), std::sig_atomic_t{ended},
               std::sig_atomic_t{0});
  return {ended, status};
}

}  // namespace

Children::Children() {
  handed = 0;
  hand_signals_to(hand_on);
}

Children::~Children() {
  if (handed == 0) hand_signals_to(SIG_DFL);  // `timeout` may send the signal twice
}

int Children::start(const std::vector<std::string>& arguments) {
  const int output = memfd_create("stdout", MFD_CLOEXEC);
  if (output < 0) child_failed("keep the output of a run", errno);
  outputs_.emplace_back(start_again(arguments, output), output);
  hand_on_to(outputs_.back().first);
  return outputs_.back().first;
}

std::pair<int, ChildEnd> Children::next() {
  const auto [process, status] = end_of(-1);
  const auto its = [&, ended = process](const auto& output) { return output.first == ended; };
  const auto output = std::find_if(outputs_.begin(), outputs_.end(), its);
  ChildEnd end{WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status),
               text_in(output->second)};
  outputs_.erase(output);
  return {process, std::move(end)};
}

int Children::call(const std::string& program, char** argv) {
  pid_t process = 0;
  if (const int error = posix_spawn(&process, program.c_str(), nullptr, nullptr, argv, environ))
    child_failed(fmt::format("start '{}'", program).c_str(), error);
  hand_on_to(process);
  return end_of(process).second;
}

std::optional<int> Children::signal() const {
  return handed == 0 ? std::nullopt : std::optional<int>(handed);
}

}  // namespace meniscus
