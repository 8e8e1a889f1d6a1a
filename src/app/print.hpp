// SPDX-License-Identifier: BSD-3-Clause
// Printing that never fails: a stream that is full or gone loses the text, not the run.
#pragma once
#include <fmt/core.h>

#include <string>
#include <string_view>

namespace meniscus {

/// Makes closed standard streams lead to the null device, so that no file of a run gets their
/// numbers and with them the messages; ignores signals about pipes and file sizes, whose errors are
/// reported where they occur. To be called first.
void secure_streams();

/// Writes to stdout what is printable() of the text. Here and below, only the first of several
/// ranks writes.
void print_text(std::string_view text);
/// Writes the text over the present line of a terminal.
void print_over_line(std::string_view text);
/// Writes what is readable() of the text to stderr, as a line.
void print_complaint(std::string_view text);
/// Keeps the text as the complaint of this rank without writing it.
void keep_complaint(std::string_view text);
/// The complaint printed or kept last, also on ranks that do not write; empty if there was none.
const std::string& last_complaint();
template <class... T>
void say(fmt::format_string<T...> format, T&&... arguments) {
  print_text(fmt::vformat(format, fmt::make_format_args(arguments...)));
}

/// Throws FileError if something printed to stdout was lost: for commands that do nothing else.
void require_printed();

}  // namespace meniscus
