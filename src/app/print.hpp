// SPDX-License-Identifier: BSD-3-Clause
// Printing that never fails: if a stream is full or closed, the text is lost but the run goes on.
#pragma once
#include <fmt/core.h>

#include <string>
#include <string_view>

namespace meniscus {

/// Opens /dev/null in place of closed standard streams. Otherwise a file of the run could get the
/// descriptor of a standard stream, and with it the messages. Also ignores the signals for broken
/// pipes and exceeded file sizes; these errors are reported where they occur. Call this first.
void secure_streams();

/// Writes printable(text) to stdout. Of several ranks, only rank 0 writes; this also holds for the
/// functions below.
void print_text(std::string_view text);
/// Overwrites the current line of the terminal with the text.
void print_over_line(std::string_view text);
/// Writes readable(text) to stderr as one line.
void print_complaint(std::string_view text);
/// Stores the text as the complaint of this rank without writing it.
void keep_complaint(std::string_view text);
/// The complaint that was printed or stored last, on every rank. Empty if there was none.
/// was none.
const std::string& last_complaint();
template <class... T>
void say(fmt::format_string<T...> format, T&&... arguments) {
  print_text(fmt::vformat(format, fmt::make_format_args(arguments...)));
}

/// Throws FileError if text for stdout was lost. For commands whose only result is this text.
void require_printed();

}  // namespace meniscus
