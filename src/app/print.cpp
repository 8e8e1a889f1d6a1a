// SPDX-License-Identifier: BSD-3-Clause
// Standard streams that may be closed or full.
#include "meniscus/app/print.hpp"

#include "meniscus/core/error.hpp"
#include "meniscus/core/ranks.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <string>

namespace meniscus {
namespace {

int lost = 0;  ///< errno of the first text that could not be written to stdout
std::string complaint;

}  // namespace

void secure_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0) open("/dev/null", O_RDWR);  // the lowest free number: this one
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void print_text(std::string_view text) {
  if (launch().rank > 0) return;  // the first rank speaks for all
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (!written && lost == 0) lost = errno;
}

void print_complaint(std::string_view text) {
  complaint = text;
  if (launch().rank > 0) return;
  std::string line(text);
  std::replace_if(
      line.begin(), line.end(),
      [](unsigned char c) { return (c < 0x20 && c != '\n') || c == 0x7f; }, '?');
  line += '\n';
  std::fwrite(line.data(), 1, line.size(), stderr);
}

const std::string& last_complaint() {
  return complaint;
}

void require_printed() {
  if (std::fflush(stdout) != 0 && lost == 0) lost = errno;
  if (lost != 0) throw FileError(fmt::format("cannot print: {}", std::strerror(lost)));
}

}  // namespace meniscus
