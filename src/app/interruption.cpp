// SPDX-License-Identifier: BSD-3-Clause
// Signal handlers that only set a flag.
#include "app/interruption.hpp"

#include "parallel/ranks.hpp"

#include <atomic>
#include <csignal>
#include <cstdint>
#include <ctime>
#include <limits>
#include <string_view>
#include <vector>

namespace meniscus {
namespace {

volatile std::sig_atomic_t caught = 0;

constexpr int asking_to_stop[] = {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGXCPU};

void handle_by(void (*handler)(int)) {
  for (const int signal : asking_to_stop) {
    struct sigaction present {};
    sigaction(signal, nullptr, &present);
    if (present.sa_handler != SIG_IGN) std::signal(signal, handler);
  }
}

using Nanoseconds = std::int64_t;
std::atomic<Nanoseconds> caught_at = 0;
static_assert(std::atomic<Nanoseconds>::is_always_lock_free, "as signal handlers need it");

Nanoseconds now() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return Nanoseconds{1'000'000'000} * time.tv_sec + time.tv_nsec;
}

/// Signal handler. The first signal asks the run to stop; a later one ends the program at once.
/// Signals within one second of the first are ignored, because `timeout` sends its signal to the
/// program and then to the process group.
void note(int signal) {
  constexpr Nanoseconds same_request = 1'000'000'000;
  if (!caught) {
    caught_at = now();  // set first: another thread may get the next signal
    caught = signal;
  } else if (now() - caught_at > same_request) {
    handle_by(SIG_DFL);
    std::raise(signal);
  }
}

/// True if the text consists of 1 to `most` decimal digits.
bool digits(std::string_view text, std::size_t most) {
  return !text.empty() && text.size() <= most && text.find_first_not_of("0123456789") == text.npos;
}

}  // namespace

Interruption::Interruption(std::optional<double> max_walltime)
    : begin_(std::chrono::steady_clock::now()),
      limit_seconds_(max_walltime.value_or(std::numeric_limits<double>::infinity())) {
  caught = 0;
}

void Interruption::catch_signals() {
  handle_by(note);
}

Interruption::~Interruption() {
  if (!caught) handle_by(SIG_DFL);  // otherwise the signal may come again at the end
}

std::optional<int> Interruption::noticed() const {
  if (caught) return static_cast<int>(caught);
  if (elapsed_seconds() > limit_seconds_) return SIGALRM;
  return std::nullopt;
}

std::optional<int> Interruption::requested() const {
  const auto of_all = static_cast<int>(ranks().largest(noticed().value_or(0)));
  return of_all > 0 ? std::optional(of_all) : std::nullopt;
}

double Interruption::elapsed_seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

std::optional<double> parse_duration(const std::string& text) {
  std::vector<std::string> parts(1);
  for (const char c : text)
    if (c == ':')
      parts.emplace_back();
    else
      parts.back() += c;
  if (parts.size() > 3) return std::nullopt;
  double seconds = 0;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const bool last = k + 1 == parts.size();
    const std::size_t point = last ? parts[k].find('.') : std::string::npos;
    if (!digits(parts[k].substr(0, point), last ? 9 : 6)) return std::nullopt;
    if (point != std::string::npos && !digits(parts[k].substr(point + 1), 9)) return std::nullopt;
    seconds = 60 * seconds + std::stod(parts[k]);
  }
  return seconds > 0 ? std::optional(seconds) : std::nullopt;
}

}  // namespace meniscus
