// SPDX-License-Identifier: BSD-3-Clause
// Signal handlers that only set a flag.
#include "meniscus/app/interruption.hpp"

#include <csignal>
#include <sstream>

#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

volatile std::sig_atomic_t caught = 0;

void note(int signal) {
  caught = signal;
  std::signal(signal, SIG_DFL);  // the second one is not waited for
}

double seconds_of(const std::string& text) {
  if (text.empty()) return 1e300;
  double seconds = 0;
  std::istringstream parts(text);
  std::string part;
  int count = 0;
  while (std::getline(parts, part, ':') && ++count <= 3) {
    std::size_t used = 0;
    double number = -1;
    try {
      number = std::stod(part, &used);
    } catch (const std::exception&) {
      used = 0;
    }
    if (used == 0 || used != part.size() || !(number >= 0)) count = 99;
    seconds = seconds * 60 + number;
  }
  if (count > 3 || !(seconds > 0))
    throw InputError("--max-walltime '" + text + "' is not a time; write H:M:S, M:S or seconds");
  return seconds;
}

}  // namespace

Interruption::Interruption(const std::string& max_walltime)
    : begin_(std::chrono::steady_clock::now()), limit_seconds_(seconds_of(max_walltime)) {
  caught = 0;
  std::signal(SIGINT, note);
  std::signal(SIGTERM, note);
}

Interruption::~Interruption() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

std::optional<int> Interruption::requested() const {
  if (caught) return static_cast<int>(caught);
  if (elapsed_seconds() > limit_seconds_) return SIGALRM;
  return std::nullopt;
}

double Interruption::elapsed_seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

}  // namespace meniscus
