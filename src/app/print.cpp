// SPDX-License-Identifier: BSD-3-Clause
// Printing to standard streams that may be closed or on a full disk.
#include "app/print.hpp"

#include "input/text.hpp"
#include "meniscus/error.hpp"
#include "parallel/ranks.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <string>

namespace meniscus {
namespace {

int lost = 0;  ///< errno of the first text that could not be written to stdout
std::string complaint;

void write_out(std::string_view text) {
  if (launch().rank > 0) return;  // only rank 0 prints
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (!written && lost == 0) lost = errno;
}

}  // namespace

void secure_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0) open("/dev/null", O_RDWR);  // the lowest free number: `stream`
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void print_text(std::string_view text) {
  write_out(printable(text));
}

void print_over_line(std::string_view text) {
  write_out("\r\033[K" + printable(text));
}

void keep_complaint(std::string_view text) {
  complaint = readable(text);
}

void print_complaint(std::string_view text) {
  keep_complaint(text);
  if (launch().rank > 0) return;
  const std::string line = complaint + '\n';
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
