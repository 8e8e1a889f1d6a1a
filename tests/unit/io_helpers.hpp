// SPDX-License-Identifier: BSD-3-Clause
// Helpers for tests of files: a directory per test, a state, exceptions with their message.
#pragma once
#include "state/snapshot.hpp"
#include "thrown.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

namespace meniscus {

/// Removes path() before and after each test.
class TemporaryDirectory : public testing::Test {
 protected:
  TemporaryDirectory() {
    std::string name = (std::filesystem::temp_directory_path() / "meniscus-XXXXXX").string();
    if (!mkdtemp(name.data())) std::abort();
    parent_ = name;
  }
  ~TemporaryDirectory() override { std::filesystem::remove_all(parent_); }

  std::filesystem::path path() const { return parent_ / "results"; }

  static std::string content(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  /// A state that differs from step to step, with every kind of array and special numbers.
  const Snapshot& state(std::int64_t step) {
    Snapshot& state = states_[step];
    if (!state.arrays().empty()) return state;
    const Real s = static_cast<Real>(step);
    state.add_reals("velocity", std::vector<Real>{1.0 / 3.0 + s, -0.0, 5e-324, 1e308}, "m/s");
    state.add_reals("drop/contact/gap", std::vector<Real>{});
    state.add_integers("controller/steps", std::vector<std::int64_t>{step, INT64_MIN, INT64_MAX});
    state.add_text("controller/phase",
                   "gr\xc3\xb6\xc3\x9f"
                   "er\n");
    state.add_text("empty", "");
    return state;
  }

 private:
  std::filesystem::path parent_;
  std::map<std::int64_t, Snapshot> states_;
};

}  // namespace meniscus
