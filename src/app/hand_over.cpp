// SPDX-License-Identifier: BSD-3-Clause
// Commands that are programs of their own: the studies, and the Python scripts that draw and fit.
#include "app/hand_over.hpp"

#include "app/documents.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <vector>

namespace meniscus {

namespace {

std::filesystem::path this_program() {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error);
}

}  // namespace

std::filesystem::path own_directory() {
  return this_program().parent_path();
}

void hand_over_to_studies(char** argv) {
  const std::string program = (own_directory() / "meniscus-study").string();
  argv[1] = const_cast<char*>(program.c_str());
  execv(program.c_str(), argv + 1);
  throw FileError(
      fmt::format("'{}' is not there: studies are built on demand, by: cmake --build {} --target "
                  "meniscus-study",
                  program, own_directory().string()));
}

void hand_over_to_python(const std::string& name, char** argv) {
  // The Python for which numpy, h5py and matplotlib are installed.
  constexpr const char* python = "/usr/bin/python3";
  const std::filesystem::path installed = own_directory().parent_path() / "share/meniscus/plotting",
                              sources = plotting_sources();
  std::error_code error;
  const std::string script =
      ((std::filesystem::exists(installed, error) ? installed : sources) / (name + ".py")).string();
  if (!std::filesystem::exists(script, error))
    throw FileError(fmt::format("neither '{}' nor '{}' is there", installed.string(), script));
  std::vector<char*> words{const_cast<char*>(python), const_cast<char*>("-B"),
                           const_cast<char*>(script.c_str())};
  for (char** word = argv + 2; *word != nullptr; ++word) words.push_back(*word);
  words.push_back(nullptr);
  setenv("MENISCUS_COMMAND", ("meniscus " + name).c_str(), 1);
  setenv("MENISCUS_PROGRAM", this_program().c_str(), 1);
  execv(python, words.data());
  throw FileError(fmt::format("'{}' is not there, which draws and fits", python));
}

}  // namespace meniscus
