// SPDX-License-Identifier: BSD-3-Clause
// Reference values of the interaction of bodies (tests/data/cgcm.json).
#pragma once
#include "physics/contact/contact_law.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <string>
#include <vector>

namespace meniscus::test {

struct ContactReference {
  nlohmann::json inputs;
  std::vector<Real> value;
  Real rel_tol;
};

/// All entries whose name begins with `name`; the test fails if there are none.
inline std::vector<ContactReference> contact_references(const std::string& name) {
  static const nlohmann::json data =
      nlohmann::json::parse(std::ifstream(MENISCUS_TEST_DATA "/cgcm.json"));
  std::vector<ContactReference> found;
  for (const auto& e : data["entries"]) {
    if (e["name"].get<std::string>().rfind(name, 0) != 0) continue;
    const auto& v = e["value"];
    found.push_back({e["inputs"],
                     v.is_array() ? v.get<std::vector<Real>>() : std::vector<Real>{v.get<Real>()},
                     e["rel_tol"]});
  }
  EXPECT_FALSE(found.empty()) << name;
  return found;
}

/// epsilon and sigma0 of an entry; 1 if the entry has none.
inline ContactLaw law_of(const ContactReference& reference, PairKernel kernel) {
  return {kernel, reference.inputs.value("eps", 1.0), reference.inputs.value("s0", 1.0)};
}

inline void expect_relative(Real value, Real expected, Real tolerance, const std::string& what) {
  EXPECT_NEAR(value, expected, tolerance * std::abs(expected)) << what;
}

/// Every kernel, without and with a cut-off.
inline std::vector<ContactLaw> contact_laws() {
  std::vector<ContactLaw> laws;
  for (const PairKernel kernel : {PairKernel::space, PairKernel::integrated, PairKernel::planar})
    for (const Real cutoff : {std::numeric_limits<Real>::infinity(), 4.0, 2.5})
      laws.push_back({kernel, 1.7, 0.8, cutoff});
  return laws;
}

}  // namespace meniscus::test
