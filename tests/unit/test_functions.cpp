// SPDX-License-Identifier: BSD-3-Clause
// Named formulas ([functions]) of a scene: values of their calls, and messages.
#include "input/input.hpp"
#include "input_scene.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>

namespace meniscus::test_functions {
namespace {

using input_test::report;

const std::string functions = R"toml(
[functions]
wave = "0.1*sin(2*x + t)"
"bump(r, width)" = "exp(-(r/width)^2)"
"twice(x)" = "2*x"                # x hides the place, here only
"shifted(a)" = "a + x"            # the place
"both(x)" = "twice(x) + shifted(x)"
depth = "radius*(1 + half)"
half = 0.5
[constants]
radius = "5 nm"
wide = "twice(radius)"
layers = 3
)toml";

Real value_of(const std::string& formula, Real x, Real t = 0) {
  const SceneInput input =
      SceneInput::from_text("key = '" + formula + "'" + functions, "s.toml", {});
  const Expression read = input.root().expression("key", dimension::none, std::nullopt);
  input.check();
  return read({x, 0.25, 0}, t);
}

std::string complaint(const std::string& formula) {
  return report("key = '" + formula + "'" + functions,
                [](const Block& root) { root.expression("key", dimension::none, std::nullopt); });
}

std::string wrong(const std::string& lines, const std::string& formula = "1") {
  return report("key = '" + formula + "'\n[functions]\n" + lines,
                [](const Block& root) { root.expression("key", dimension::none, std::nullopt); });
}

TEST(Functions, CallsAreTheirFormulas) {
  EXPECT_DOUBLE_EQ(value_of("1 + wave", 0.3, 0.2), 1 + 0.1 * std::sin(0.8));
  EXPECT_DOUBLE_EQ(value_of("wave()*wave", 0.3), std::pow(0.1 * std::sin(0.6), 2));
  EXPECT_DOUBLE_EQ(value_of("bump(sqrt(x^2 + y^2), 0.5)", 0.3),
                   std::exp(-(0.3 * 0.3 + 0.25 * 0.25) / 0.25));
  // A call has the precedence of brackets. Arguments may contain calls, with commas and brackets.
  EXPECT_DOUBLE_EQ(value_of("-twice(1 + x)^2/2", 0.3), -std::pow(2 * 1.3, 2) / 2);
  EXPECT_DOUBLE_EQ(value_of("twice(max(twice(x), min(1, 2)))", 0.3), 2);
  EXPECT_DOUBLE_EQ(value_of("bump (twice( x ), half)", 0.3), std::exp(-std::pow(0.6 / 0.5, 2)));
  EXPECT_DOUBLE_EQ(value_of("2e0*half", 0), 1);
}

TEST(Functions, NamesMeanTheSameEverywhere) {
  EXPECT_DOUBLE_EQ(value_of("twice(y)", 0.3), 0.5);
  EXPECT_DOUBLE_EQ(value_of("shifted(y)", 0.3), 0.25 + 0.3);
  // In `shifted`, x is the position, even if `shifted` is called by a function with an argument x.
  EXPECT_DOUBLE_EQ(value_of("both(y)", 0.3), 0.5 + 0.25 + 0.3);
}

TEST(Functions, NumbersAndConstantsMayCallThem) {
  const SceneInput input = SceneInput::from_text(
      "a = 'depth'\nb = 'wide'\nn = 'twice(layers)'" + functions, "s.toml", {});
  EXPECT_DOUBLE_EQ(input.root().real("a", dimension::length, range::any, {}), 7.5e-9);
  EXPECT_DOUBLE_EQ(input.root().real("b", dimension::length, range::any, {}), 1e-8);
  EXPECT_EQ(input.root().integer("n", range::any, {}), 6);
  input.check();
  // The complete input contains values instead of calls, and no functions.
  const std::string complete = input.complete();
  EXPECT_EQ(complete.find("twice"), std::string::npos);
  // Dimensions are checked as in formulas without calls.
  const std::string other = report("key = 'depth'" + functions, [](const Block& root) {
    root.real("key", dimension::time, range::any, {});
  });
  EXPECT_NE(other.find("'depth' by [functions]: formula '(radius*(1 + (0.5)))' is "),
            std::string::npos)
      << other;
}

/// Each of 60 functions calls the previous one twice, which would be 2^60 calls.
TEST(Functions, CallsAreCounted) {
  std::string lines = "'f0(a)' = 'a'\n";
  for (int k = 1; k < 60; ++k) lines += fmt::format("'f{}(a)' = 'f{}(f{}(a))'\n", k, k - 1, k - 1);
  const std::string said = wrong(lines, "f59(x)");
  EXPECT_NE(said.find("calls functions more than 10000 times"), std::string::npos) << said;
  // If each function calls the previous one once, there is no problem.
  lines = "'f0(a)' = 'a'\n";
  for (int k = 1; k < 60; ++k) lines += fmt::format("'f{}(a)' = '1 + f{}(a)'\n", k, k - 1);
  EXPECT_EQ(wrong(lines, "f59(x)"), "");
}

TEST(Functions, SettingsReplaceThem) {
  const SceneInput input = SceneInput::from_text(
      "key = 'wave'" + functions, "s.toml", {"functions.wave=3*x", "functions.'twice(x)'=3*x"});
  const Expression read = input.root().expression("key", dimension::none, std::nullopt);
  input.check();
  EXPECT_DOUBLE_EQ(read({0.5, 0, 0}), 1.5);
}

TEST(Functions, WrongCallsAreRefused) {
  EXPECT_NE(complaint("bump(x)").find("s.toml:1:7: key: formula 'bump(x)': 'bump' has 1 arguments; "
                                      "allowed is bump(r, width)"),
            std::string::npos)
      << complaint("bump(x)");
  EXPECT_NE(complaint("1 + bump").find("'bump' has 0 arguments; allowed is bump(r, width)"),
            std::string::npos);
  EXPECT_NE(complaint("wave(1)").find("'wave' has 1 arguments; allowed is wave"),
            std::string::npos);
  EXPECT_NE(complaint("bump(x, 1").find("a closing bracket is missing"), std::string::npos);
  EXPECT_NE(
      complaint("twice(q)").find("'twice(q)' by [functions]: formula '(2*(q))': unknown name 'q'"),
      std::string::npos)
      << complaint("twice(q)");
  EXPECT_NE(complaint("bmp(x, 1)").find("did you mean 'bump'?"), std::string::npos)
      << complaint("bmp(x, 1)");
}

TEST(Functions, WrongFunctionsAreRefusedWhereTheyStand) {
  EXPECT_EQ(wrong("f = '1 + u'\nu = 'w(2)'\n'w(a)' = 'a*f'"),
            "s.toml:3:5: functions.f: 'f' needs itself: f -> u -> w -> f; allowed are formulas of "
            "other functions\n"
            "s.toml:4:5: functions.u: 'u' needs itself: u -> w -> f -> u; allowed are formulas of "
            "other functions\n"
            "s.toml:5:10: functions.\"w(a)\": 'w' needs itself: w -> f -> u -> w; allowed are "
            "formulas of other functions");
  EXPECT_NE(wrong("'f(r)' = 'r + q'")
                .find("s.toml:3:10: functions.\"f(r)\": formula '(r) + q': "
                      "unknown name 'q'"),
            std::string::npos)
      << wrong("'f(r)' = 'r + q'");
  // One message for a broken function, not one for each call.
  EXPECT_EQ(wrong("f = '1 + q'", "f + 1"), wrong("f = '1 + q'"));
  for (const char* name : {"2f", "f(", "f()", "f(a", "f(a, a)", "f(2)", "f(a)b", "f g", "f(a b)"})
    EXPECT_NE(
        wrong("'" + std::string(name) + "' = '1'").find("cannot be a function; allowed are NAME"),
        std::string::npos)
        << name << ": " << wrong("'" + std::string(name) + "' = '1'");
  EXPECT_NE(wrong("sin = 'x'").find("'sin' has a meaning in formulas already"), std::string::npos);
  EXPECT_NE(wrong("m = 'x'").find("'m' is a unit"), std::string::npos);
  EXPECT_NE(wrong("'f(pi)' = '1'").find("the argument 'pi' has a meaning"), std::string::npos);
  EXPECT_NE(wrong("f = 'x'\n'f(a)' = 'a'").find("is the name of another function, too"),
            std::string::npos);
  EXPECT_NE(wrong("f = true").find("functions.f: is a boolean; allowed is a formula"),
            std::string::npos)
      << wrong("f = true");
  EXPECT_NE(
      wrong("f = 'x'\n[constants]\nf = 2").find("constants.f: is the name of one of [functions]"),
      std::string::npos);
}

TEST(Functions, FormulasMayNotGrowWithoutBound) {
  std::string lines = "f0 = 'x";
  for (int k = 0; k < 500; ++k) lines += " + x";
  lines += "'\n";
  for (int k = 1; k < 40; ++k)
    lines += "f" + std::to_string(k) + " = 'f" + std::to_string(k - 1) + "*f" +
             std::to_string(k - 1) + "'\n";
  EXPECT_NE(wrong(lines).find("more than 100000 characters without [functions]"),
            std::string::npos);
}

}  // namespace
}  // namespace meniscus::test_functions
