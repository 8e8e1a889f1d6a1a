// SPDX-License-Identifier: BSD-3-Clause
// Reads a file with every reader of the program, for hostile_files.py:
//   result_reader FILE
// Prints a line for each reader: its name, and "read" or the reason for refusal. Only a FileError
// counts as a refusal.
#include "io/checkpoint.hpp"
#include "io/info.hpp"
#include "meniscus/error.hpp"

#include <cstdio>
#include <exception>
#include <functional>

using namespace meniscus;

namespace {

void attempt(const char* way, const std::function<void()>& read) {
  try {
    read();
    std::printf("%s: read\n", way);
  } catch (const FileError& refusal) {
    std::printf("%s: refused: %s\n", way, refusal.what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  try {
    attempt("info", [&] { describe_file(argv[1]); });
    attempt("checkpoint", [&] { read_checkpoint(argv[1]); });
    attempt("frame", [&] { read_checkpoint(argv[1], 0); });
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "%s\n", failure.what());
    return 1;
  }
}
