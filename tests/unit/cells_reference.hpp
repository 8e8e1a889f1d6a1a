// SPDX-License-Identifier: BSD-3-Clause
// Exact solutions of surfaces with elasticity and viscosity and of nematic drops
// (tests/data/cells.json).
#pragma once
#include <nlohmann/json.hpp>

#include <fstream>
#include <string>

namespace meniscus::test {

inline const nlohmann::json& cells_reference() {
  static const nlohmann::json all = [] {
    std::ifstream file(MENISCUS_TEST_DATA "/cells.json");
    return nlohmann::json::parse(file);
  }();
  return all;
}

}  // namespace meniscus::test
