// SPDX-License-Identifier: BSD-3-Clause
// Reads a file in every way the program has, for hostile_files.py:
//   result_reader FILE
// Prints a line for each way: what it is, and "read" or why it was refused. Only refusals by
// FileError are well.
#include "meniscus/core/error.hpp"
#include "meniscus/io/checkpoint.hpp"
#include "meniscus/io/info.hpp"

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
