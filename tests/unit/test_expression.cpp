// SPDX-License-Identifier: BSD-3-Clause
// Formulas: values, syntax, sharing between threads, and exact messages.
#include "input/expression.hpp"
#include "meniscus/error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <thread>
#include <vector>

namespace meniscus::test_expression {
namespace {

const Eigen::Vector3d X(0.5, -2.0, 3.0);

Real value(const std::string& formula, Real t = 0) {
  return Expression(formula)(X, t);
}

std::string message(const std::string& formula) {
  try {
    Expression{formula};
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Expression, KnowsWhenItBecomesConstant) {
  const auto steady_after = [](const std::string& formula, Real end = 200) {
    Expression e(formula);
    e.set_end(end);
    return e.steady_after();
  };
  EXPECT_NEAR(steady_after("min(max(t - 30, 0)/100, 1)"), 130, 0.04);
  EXPECT_NEAR(steady_after("t < 50 ? sin(t) : 2"), 50, 0.04);
  EXPECT_EQ(steady_after("3*x"), 0);
  EXPECT_EQ(steady_after("0*t + 3"), 0);
  EXPECT_EQ(steady_after("2"), 0);
  constexpr Real never = std::numeric_limits<Real>::infinity();
  EXPECT_EQ(steady_after("min(t, 250)"), never);
  EXPECT_EQ(steady_after("sin(100*pi*t)"), never);           // a period that fits 10,000 times
  EXPECT_EQ(steady_after("x*min(t, 1)"), never);             // it is not known where the bodies are
  EXPECT_EQ(Expression("min(t, 1)").steady_after(), never);  // no scene
}

TEST(Expression, Values) {
  EXPECT_EQ(value("2e9*(1 + 0.1*x)"), 2e9 * (1 + 0.1 * 0.5));
  EXPECT_EQ(value("x + 10*y + 100*z + 1000*t", 7), 0.5 - 20 + 300 + 7000);
  EXPECT_EQ(value("-y^2"), -4);
  EXPECT_EQ(value("2^3^2"), 512);
  EXPECT_EQ(value("pi"), std::numbers::pi);
  EXPECT_EQ(value("e"), std::numbers::e);
  EXPECT_EQ(value("log(e^2)"), 2);
  EXPECT_EQ(value("log10(1000)"), 3);
  EXPECT_EQ(value("x > 0 && y < 0 ? 1 : 2"), 1);
  EXPECT_EQ(value("x == 0.5"), 1);
  EXPECT_EQ(value("min(x, y, z) + max(x, y, z)"), 1);
  EXPECT_EQ(value("sign(y) + abs(y)"), 1);
  EXPECT_DOUBLE_EQ(value("sin(x)+cos(x)+tan(x)"), std::sin(0.5) + std::cos(0.5) + std::tan(0.5));
  EXPECT_DOUBLE_EQ(value("asin(x)"), std::asin(0.5));
  EXPECT_DOUBLE_EQ(value("acos(x)"), std::acos(0.5));
  EXPECT_DOUBLE_EQ(value("atan(x)"), std::atan(0.5));
  EXPECT_DOUBLE_EQ(value("atan2(y, x)"), std::atan2(-2.0, 0.5));
  EXPECT_DOUBLE_EQ(value("sinh(x)"), std::sinh(0.5));
  EXPECT_DOUBLE_EQ(value("cosh(x)"), std::cosh(0.5));
  EXPECT_DOUBLE_EQ(value("tanh(x)"), std::tanh(0.5));
  EXPECT_DOUBLE_EQ(value("exp(x)"), std::exp(0.5));
  EXPECT_DOUBLE_EQ(value("sqrt(x)"), std::sqrt(0.5));
  EXPECT_DOUBLE_EQ(value("cbrt(y)"), std::cbrt(-2.0));
  EXPECT_DOUBLE_EQ(value("erf(x)"), std::erf(0.5));
  EXPECT_EQ(value("pow(z, 2)"), 9);
  EXPECT_EQ(value("floor(x) + 10*ceil(x)"), 10);
}

TEST(Expression, ConstantsAreFolded) {
  EXPECT_TRUE(Expression("2e9*(1 + sin(pi))").constant());
  EXPECT_EQ(Expression("2e9*3")(X), 6e9);
  EXPECT_FALSE(Expression("2*x").constant());
  EXPECT_FALSE(Expression("2*x").depends_on_time());
  EXPECT_TRUE(Expression("2*x*t").depends_on_time());
  EXPECT_EQ(Expression(0.1)(X), 0.1);
  EXPECT_EQ(Expression(0.1).text(), "0.1");
  EXPECT_EQ(Expression()(X), 0);
}

TEST(Expression, TextIsTheFormulaAsGiven) {
  EXPECT_EQ(Expression(" 2 * x").text(), " 2 * x");
}

TEST(Expression, CopiesDoNotDisturbEachOther) {
  const Expression f("x*t");
  const Expression g = f;
  EXPECT_EQ(f({2, 0, 0}, 3), 6);
  EXPECT_EQ(g({5, 0, 0}, 7), 35);
  EXPECT_EQ(f({2, 0, 0}, 3), 6);
}

TEST(Expression, SeveralThreadsMayEvaluate) {
  const Expression f("x + 1000*y");
  std::vector<int> wrong(4, 0);
  std::vector<std::thread> threads;
  for (int n = 0; n < 4; ++n)
    threads.emplace_back([&f, &wrong, n] {
      for (int i = 0; i < 20000; ++i)
        if (f({Real(i), Real(n), 0}) != i + 1000 * n) ++wrong[static_cast<std::size_t>(n)];
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, std::vector<int>(4, 0));
}

TEST(Expression, Messages) {
  EXPECT_EQ(
      message("2*radius"),
      "formula '2*radius': unknown name 'radius' at character 3; allowed are x, y, z, t, pi, e "
      "and functions such as sqrt");
  EXPECT_EQ(message("sqt(x)"),
            "formula 'sqt(x)': unknown name 'sqt' at character 1; allowed are x, y, z, t, pi, e "
            "and functions such as sqrt; did you mean 'sqrt'?");
  EXPECT_EQ(message("2*(x"), "formula '2*(x': a closing bracket is missing");
  EXPECT_EQ(message("2*x)"), "formula '2*x)': unexpected ')' at character 4");
  EXPECT_EQ(message("2*"), "formula '2*': it ends too early");
  EXPECT_EQ(message(""), "formula '': it is empty");
  EXPECT_EQ(message("2 x"), "formula '2 x': unexpected 'x' at character 3");
  EXPECT_EQ(message("2 $ x"), "formula '2 $ x': unexpected '$' at character 3");
  EXPECT_EQ(message("x = 3"),
            "formula 'x = 3': '=' at character 3 is not allowed; equality is written ==");
  EXPECT_EQ(message("x, y"), "formula 'x, y': ',' outside of a function");
  EXPECT_EQ(message("0,5*x"),
            "formula '0,5*x': ',' outside of a function; decimals take a point, as in 0.5");
  EXPECT_EQ(message(std::string("x\0*q", 4)),
            "a formula has a control character (byte 0) at character 2");
  EXPECT_NE(message("\"x\""), "no error");
  EXPECT_NE(message("x=y"), "no error");
  EXPECT_NE(message("x <== y"), "no error");
  EXPECT_NE(message("x === y"), "no error");
  EXPECT_NE(message("x\xff"), "no error");
  EXPECT_NE(message("rnd()"), "no error");
  EXPECT_NE(message("min()"), "no error");
  EXPECT_EQ(message("sin(x, y)"), "formula 'sin(x, y)': too many arguments of 'sin'");
  EXPECT_EQ(message("atan2(x)"), "formula 'atan2(x)': too few arguments of 'atan2'");
}

}  // namespace
}  // namespace meniscus::test_expression
