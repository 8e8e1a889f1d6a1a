// SPDX-License-Identifier: BSD-3-Clause
#include "study/drop_dispersion.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace meniscus::test_drop_dispersion {
namespace {

TEST(DropDispersion, MatchesReference) {
  std::ifstream file(MENISCUS_TEST_DATA "/drop_modes.json");
  int cases = 0;
  const nlohmann::json data = nlohmann::json::parse(file);
  for (const auto& test : data.at("cases")) {
    if (!test.at("value").is_object() || !test.at("value").contains("s_times_capillary_time"))
      continue;
    const auto& inputs = test.at("inputs");
    const auto slow = test.at("value").at("s_times_capillary_time").at(0);
    const Complex expected(slow.at(0).get<Real>(), slow.at(1).get<Real>());
    const Complex s = drop_mode_rate(inputs.at("l").get<int>(), inputs.at("Oh").get<Real>());
    EXPECT_LT(std::abs(s - expected), 1e-11 * std::abs(expected)) << test.at("name");
    ++cases;
  }
  EXPECT_EQ(cases, 5);
}

// The drop of Fan 2014, 6.1: decay times of l = 2 and 4 (RKPM note 7).
TEST(DropDispersion, MatchesTheNanoDrop) {
  constexpr Real Oh = 0.9295056102087423, capillary_time = 5.0749871433821886e-11;
  EXPECT_NEAR(-drop_mode_rate(2, Oh).real() / capillary_time / 28460536782.121216, 1, 1e-11);
  EXPECT_NEAR(-drop_mode_rate(4, Oh).real() / capillary_time / 49530790455.85702, 1, 1e-11);
  EXPECT_EQ(drop_mode_rate(2, Oh).imag(), 0);
}

TEST(DropDispersion, HasItsLimits) {
  // Lamb's limits are (l-1)(2l+1) Oh and sqrt(l (l-1) (l+2)), the creeping limit is 20/19 / Oh.
  EXPECT_NEAR(drop_mode_rate(3, 1e-5).imag(), std::sqrt(30.0), 1e-3);
  EXPECT_NEAR(drop_mode_rate(3, 1e-5).real(), -14e-5, 2e-6);
  EXPECT_NEAR(drop_mode_rate(2, 1e3).real(), -20.0 / 19 * 1e-3, 1e-8);
  // The critical Oh of l = 2 is 0.76646.
  EXPECT_GT(drop_mode_rate(2, 0.7660).imag(), 0);
  EXPECT_EQ(drop_mode_rate(2, 0.7670).imag(), 0);
}

}  // namespace
}  // namespace meniscus::test_drop_dispersion
