// SPDX-License-Identifier: BSD-3-Clause
// Reference values of shape functions (tests/data/rkpm.json).
#pragma once
#include "kernel/kernel_function.hpp"

#include <nlohmann/json.hpp>

#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace meniscus::test {

/// The reference cases whose name begins with `prefix`.
inline std::vector<nlohmann::json> rkpm_cases(const std::string& prefix) {
  std::ifstream file(MENISCUS_TEST_DATA "/rkpm.json");
  std::vector<nlohmann::json> found;
  const nlohmann::json data = nlohmann::json::parse(file);
  for (const auto& test : data.at("cases"))
    if (test.at("name").get<std::string>().rfind(prefix, 0) == 0) found.push_back(test);
  return found;
}

inline KernelFunction function_called(const std::string& name) {
  static const std::map<std::string, KernelFunction> functions{
      {"cubic", KernelFunction::cubic_spline},
      {"quintic", KernelFunction::quintic_spline},
      {"quartic", KernelFunction::quartic_spline},
      {"wc2", KernelFunction::wendland_c2},
      {"wc4", KernelFunction::wendland_c4}};
  return functions.at(name);
}

template <int D>
std::vector<Vec<D>> points_of(const nlohmann::json& rows) {
  std::vector<Vec<D>> points;
  for (const auto& row : rows) {
    Vec<D> x;
    for (int i = 0; i < D; ++i) x[i] = row.at(static_cast<std::size_t>(i)).get<Real>();
    points.push_back(x);
  }
  return points;
}

}  // namespace meniscus::test
