// SPDX-License-Identifier: BSD-3-Clause
// Numbers computed from a history and compared with the expectations of a scene.
#include "scene/expectations.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

namespace meniscus::test_expectations {
namespace {

/// Columns 2 exp(-0.3 t), t - 4, and an oscillating -exp(-0.3 t), with rows at t = 0, 0.5, ..., 10.
class Expectations : public ::testing::Test {
 protected:
  Expectations() {
    for (int k = 0; k <= 20; ++k) {
      const Real t = 0.5 * k;
      columns_["time"].push_back(t);
      columns_["decay"].push_back(2 * std::exp(-0.3 * t));
      columns_["line"].push_back(t - 4);
      columns_["wave"].push_back((k % 2 ? -1 : 1) * std::exp(-0.3 * t));
      columns_["zero"].push_back(0);
    }
  }

  ExpectationResult evaluate(ExpectSettings e, Real end = 10) const {
    if (!e.judged()) e.within = 1e-12;
    return evaluate_as_it_is(std::move(e), end);
  }
  ExpectationResult evaluate_as_it_is(ExpectSettings e, Real end = 10) const {
    return evaluate_expectations(
               {{"name", std::move(e)}},
               [&](const std::string& name) -> const std::vector<Real>& {
                 return columns_.at(name);
               },
               end)
        .front();
  }

  static ExpectSettings over(std::string of, std::string reduce, Real value) {
    ExpectSettings e;
    e.of = std::move(of);
    e.reduce = std::move(reduce);
    e.value = value;
    return e;
  }
  static ExpectSettings at(std::string of, std::optional<Real> time, Real value) {
    ExpectSettings e = over(std::move(of), "at", value);
    e.at = time;
    return e;
  }

  std::map<std::string, std::vector<Real>> columns_;
};

TEST_F(Expectations, ValueAtATimeIsInterpolated) {
  EXPECT_TRUE(evaluate(at("line", 3.3, -0.7)).met);
  EXPECT_TRUE(evaluate(at("line", 0.0, -4)).met);
  EXPECT_TRUE(evaluate(at("decay", 2.5, 2 * std::exp(-0.75))).met);
  EXPECT_TRUE(evaluate(at("line", std::nullopt, 6)).met);
  EXPECT_FALSE(evaluate(at("line", 3.3, -0.7001)).met);
}

TEST_F(Expectations, Reductions) {
  EXPECT_TRUE(evaluate(over("line", "max", 6)).met);
  EXPECT_TRUE(evaluate(over("line", "min", -4)).met);
  EXPECT_TRUE(evaluate(over("line", "mean", 1)).met);
  EXPECT_TRUE(evaluate(over("line", "max_abs", 6)).met);
  EXPECT_TRUE(evaluate(over("decay", "decay_rate", 0.3)).met);
  EXPECT_TRUE(evaluate(over("wave", "decay_rate", 0.3)).met);
}

TEST_F(Expectations, FallsBelowALevelAreCounted) {
  ExpectSettings e = over("wave", "falls", 10);
  e.level = 0;
  EXPECT_TRUE(evaluate(e).met);
  e.level = 0.5;  // exp(-0.3 t) at t = 0, 1, 2
  e.value = 3;
  EXPECT_TRUE(evaluate(e).met);
  e.from = 0.5;
  e.value = 2;
  EXPECT_TRUE(evaluate(e).met);
  e.of = "line";
  e.value = 0;
  EXPECT_TRUE(evaluate(e).met);
}

TEST_F(Expectations, SpansIncludeTheirEnds) {
  ExpectSettings e = over("line", "mean", -2.5);
  e.from = 1;
  e.to = 2;
  EXPECT_TRUE(evaluate(e).met);
  e.reduce = "max_abs";
  e.value = 3;
  EXPECT_TRUE(evaluate(e).met);
}

TEST_F(Expectations, TheLargerToleranceCounts) {
  ExpectSettings e = at("line", std::nullopt, 5);
  e.within = 0.1;
  EXPECT_FALSE(evaluate(e).met);
  e.within_relative = 0.2;
  EXPECT_TRUE(evaluate(e).met);
  EXPECT_DOUBLE_EQ(evaluate(e).tolerance.value(), 1);
  e.within = 3;
  EXPECT_DOUBLE_EQ(evaluate(e).tolerance.value(), 3);
}

TEST_F(Expectations, WhatTheHistoryDoesNotCoverIsNotReached) {
  const auto reached = [&](const ExpectSettings& e, Real end) { return evaluate(e, end).reached; };
  EXPECT_TRUE(reached(at("line", std::nullopt, 6), 10 * (1 + 1e-15)));
  EXPECT_FALSE(reached(at("line", std::nullopt, 6), 10.1));
  EXPECT_TRUE(reached(at("line", 9.9, 0), 20));
  EXPECT_FALSE(reached(at("line", 10.1, 0), 20));
  EXPECT_FALSE(reached(over("line", "max", 6), 20));
  ExpectSettings e = over("line", "max", 1);
  e.to = 5;
  EXPECT_TRUE(evaluate(e, 20).met);

  for (auto& [name, values] : columns_) values.erase(values.begin(), values.begin() + 4);  // t < 2
  EXPECT_FALSE(reached(at("line", 1.0, 0), 10));
  EXPECT_FALSE(reached(over("line", "max", 6), 10));
  e.from = 2;
  EXPECT_TRUE(evaluate(e).met);

  for (auto& [name, values] : columns_) values.clear();
  EXPECT_FALSE(reached(at("line", 1.0, 0), 10));
}

TEST_F(Expectations, WhatCannotBeToldIsMissed) {
  ExpectSettings e = over("decay", "decay_rate", 0.3);
  e.within = 1e9;
  e.from = 2.1;
  e.to = 3.4;  // two rows
  const ExpectationResult result = evaluate(e);
  EXPECT_TRUE(result.reached);
  EXPECT_FALSE(result.met);
  EXPECT_TRUE(std::isnan(result.obtained));
  e.of = "zero";
  e.to = 9;
  EXPECT_FALSE(evaluate(e).met);

  columns_["line"][5] = std::numeric_limits<Real>::quiet_NaN();
  ExpectSettings mean = over("line", "mean", 1);
  mean.within = 1e9;
  EXPECT_FALSE(evaluate(mean).met);
  mean.reduce = "max";
  EXPECT_FALSE(evaluate(mean).met);
  mean.reduce = "max_abs";
  EXPECT_FALSE(evaluate(mean).met);
}

TEST_F(Expectations, WithoutAToleranceTheNumberIsReported) {
  ExpectSettings e = over("line", "max", 5);
  ExpectationResult result = evaluate_as_it_is(e);
  EXPECT_TRUE(result.met);
  EXPECT_FALSE(result.tolerance);
  EXPECT_EQ(result.expected, 5);
  EXPECT_EQ(result.obtained, 6);
  e.value.reset();
  EXPECT_FALSE(evaluate_as_it_is(e).expected);
  e.within = 6;  // without a value of 0
  EXPECT_TRUE(evaluate_as_it_is(e).met);
  EXPECT_EQ(evaluate_as_it_is(e).expected, 0);
  e = over("decay", "decay_rate", 0);
  e.from = 2.1;
  e.to = 3.4;  // two rows
  EXPECT_FALSE(evaluate_as_it_is(e).met);
}

TEST_F(Expectations, Table) {
  ExpectationResult met{"aspect", 1.00193, 1.0019, 0.005, true, true}, missed = met, open = met;
  ExpectationResult told{"told", -1.0 / 3, {}, {}, true, true}, wrong = told;
  wrong.obtained = std::nan("");
  wrong.met = false;
  missed.name = "a_long_name_of_a_rate";
  missed.met = false;
  open.reached = open.met = false;
  EXPECT_EQ(expectation_table({met, missed, open, told, wrong}),
            "expectation                    obtained        expected      within  \n"
            "aspect                          1.00193          1.0019       0.005  met\n"
            "a_long_name_of_a_rate           1.00193          1.0019       0.005  MISSED\n"
            "aspect                                -          1.0019       0.005  not reached\n"
            "told                      -0.3333333333               -           -  reported\n"
            "told                                nan               -           -  MISSED\n");
}

}  // namespace
}  // namespace meniscus::test_expectations
