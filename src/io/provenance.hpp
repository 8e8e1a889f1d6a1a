// SPDX-License-Identifier: BSD-3-Clause
// Provenance of a result: program, libraries, command and input. It contains no name of a machine
// or a person.
#pragma once
#include <string>
#include <utility>
#include <vector>

namespace meniscus {

/// Version, compiler and libraries of this program.
struct Build {
  std::string version;   ///< "0.1.0"
  std::string git_hash;  ///< commit of the sources; "unknown" outside a repository
  bool git_dirty;        ///< the sources had changes that were not committed
  std::string compiler;
  std::string flags;  ///< compiler flags that affect the bits of a result
  std::vector<std::pair<std::string, std::string>> libraries;  ///< name, version
};
Build build();

/// "meniscus 0.1.0 (0123456789ab with changes), g++ 12.2.0, Release -march=x86-64-v3".
std::string program_text(const Build&);

/// The data under /meta of every result file and checkpoint.
struct Provenance {
  Build build;
  int threads;
  std::string command_line;
  std::string input;        ///< the complete input, defaults included
  std::string started_utc;  ///< "2026-01-31T12:00:00Z"
};

/// Provenance of a run that starts now.
Provenance provenance(std::string command_line, std::string input);

/// The command line with every absolute path shortened to its last name.
std::string portable_command_line(int argc, const char* const* argv);

}  // namespace meniscus
