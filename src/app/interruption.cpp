// SPDX-License-Identifier: BSD-3-Clause
// Signal handlers that only set a flag.
#include "meniscus/app/interruption.hpp"

#include <csignal>
#include <limits>
#include <regex>

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

void note(int signal) {
  caught = signal;
  handle_by(SIG_DFL);  // a second one is not waited for
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
  handle_by(SIG_DFL);
}

std::optional<int> Interruption::requested() const {
  if (caught) return static_cast<int>(caught);
  if (elapsed_seconds() > limit_seconds_) return SIGALRM;
  return std::nullopt;
}

double Interruption::elapsed_seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

std::optional<double> parse_duration(const std::string& text) {
  static const std::regex form(R"((?:(?:(\d{1,6}):)?(\d{1,6}):)?(\d{1,9}(?:\.\d{1,9})?))");
  std::smatch parts;
  if (!std::regex_match(text, parts, form)) return std::nullopt;
  const auto number = [&](std::size_t k) { return parts[k].matched ? std::stod(parts[k]) : 0.0; };
  const double seconds = 3600 * number(1) + 60 * number(2) + number(3);
  return seconds > 0 ? std::optional(seconds) : std::nullopt;
}

}  // namespace meniscus
