// SPDX-License-Identifier: BSD-3-Clause
// Derivatives of formulas. muParser computes with doubles only. A jet is passed through it as a NaN
// whose bits are an index into a list of jets.
#include "input/expression_jets.hpp"

#include <muParser.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <functional>
#include <numbers>
#include <vector>

namespace meniscus {
namespace {
namespace jet_language {

using Number = Jet<3>;

constexpr std::uint64_t tag = 0x7ff94a4500000000, low_half = 0xffffffff;

/// The jets of the current evaluation in this thread.
thread_local std::vector<Number> jets;

Real handle(const Number& jet) {
  if (jet.gradient.isZero(0) && jet.hessian.isZero(0)) return jet.value;
  jets.push_back(jet);
  return std::bit_cast<Real>(tag | (jets.size() - 1));
}

Number number(Real value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  return (bits & ~low_half) == tag ? at(jets, bits & low_half) : Number(value);
}

/// Value and derivatives of a function of one number.
struct Slopes {
  Real f, first, second;
};

Slopes of_sin(Real a) {
  return {std::sin(a), std::cos(a), -std::sin(a)};
}
Slopes of_cos(Real a) {
  return {std::cos(a), -std::sin(a), -std::cos(a)};
}
Slopes of_tan(Real a) {
  const Real f = std::tan(a), slope = 1 + f * f;
  return {f, slope, 2 * f * slope};
}
Slopes of_asin(Real a) {
  const Real slope = 1 / std::sqrt(1 - a * a);
  return {std::asin(a), slope, a * slope * slope * slope};
}
Slopes of_acos(Real a) {
  const Slopes s = of_asin(a);
  return {std::acos(a), -s.first, -s.second};
}
Slopes of_atan(Real a) {
  const Real slope = 1 / (1 + a * a);
  return {std::atan(a), slope, -2 * a * slope * slope};
}
Slopes of_sinh(Real a) {
  return {std::sinh(a), std::cosh(a), std::sinh(a)};
}
Slopes of_cosh(Real a) {
  return {std::cosh(a), std::sinh(a), std::cosh(a)};
}
Slopes of_tanh(Real a) {
  const Real f = std::tanh(a), slope = 1 - f * f;
  return {f, slope, -2 * f * slope};
}
Slopes of_exp(Real a) {
  const Real f = std::exp(a);
  return {f, f, f};
}
Slopes of_log(Real a) {
  return {std::log(a), 1 / a, -1 / (a * a)};
}
Slopes of_log10(Real a) {
  const Real unit = 1 / std::numbers::ln10;
  return {std::log10(a), unit / a, -unit / (a * a)};
}
Slopes of_sqrt(Real a) {
  const Real f = std::sqrt(a);
  return {f, 0.5 / f, -0.25 / (f * a)};
}
Slopes of_cbrt(Real a) {
  const Real f = std::cbrt(a);
  return {f, f / (3 * a), -2 * f / (9 * a * a)};
}
Slopes of_abs(Real a) {
  return {std::fabs(a), a < 0 ? -1.0 : 1.0, 0};
}
Slopes of_sign(Real a) {
  return {a > 0 ? 1.0 : a < 0 ? -1.0 : 0.0, 0, 0};
}
Slopes of_floor(Real a) {
  return {std::floor(a), 0, 0};
}
Slopes of_ceil(Real a) {
  return {std::ceil(a), 0, 0};
}
Slopes of_erf(Real a) {
  const Real slope = 2 * std::numbers::inv_sqrtpi * std::exp(-a * a);
  return {std::erf(a), slope, -2 * a * slope};
}

template <Slopes (*function)(Real)>
Real call(Real a) {
  const Number x = number(a);
  const Slopes s = function(x.value);
  return handle(x.chain(s.f, s.first, s.second));
}

Real add(Real a, Real b) {
  return handle(number(a) + number(b));
}
Real subtract(Real a, Real b) {
  return handle(number(a) - number(b));
}
Real multiply(Real a, Real b) {
  return handle(number(a) * number(b));
}
Real divide(Real a, Real b) {
  Number quotient = number(a) / number(b);
  quotient.value = number(a).value / number(b).value;  // the same bits as for numbers
  return handle(quotient);
}
Real negative(Real a) {
  return handle(number(a).chain(-number(a).value, -1, 0));
}
Real same(Real a) {
  return a;
}

/// c a^n, also where c = 0 and a^n is not finite.
Real power_term(Real c, Real a, Real n) {
  return c == 0 ? 0 : c * std::pow(a, n);
}

Real power(Real a, Real b) {
  const Number x = number(a), n = number(b);
  const Real f = std::pow(x.value, n.value), m = n.value;
  const Real f_x = power_term(m, x.value, m - 1), f_xx = power_term(m * (m - 1), x.value, m - 2);
  if (n.gradient.isZero(0) && n.hessian.isZero(0)) return handle(x.chain(f, f_x, f_xx));
  const Real l = std::log(x.value);
  return handle(
      chain(x, n, f, f_x, f * l, f_xx, std::pow(x.value, m - 1) * (1 + m * l), f * l * l));
}

Real angle(Real a, Real b) {
  const Number y = number(a), x = number(b);
  const Real r2 = x.value * x.value + y.value * y.value, twist = 2 * x.value * y.value / (r2 * r2);
  return handle(chain(y, x, std::atan2(y.value, x.value), x.value / r2, -y.value / r2, -twist,
                      (y.value * y.value - x.value * x.value) / (r2 * r2), twist));
}

/// The smallest value with std::less, or the largest with std::greater.
template <class Before>
Real first_by(const Real* values, int count) {
  return *std::min_element(values, values + count, [](Real a, Real b) {
    return Before()(number(a).value, number(b).value);
  });
}

Real is_less(Real a, Real b) {
  return number(a).value < number(b).value;
}
Real is_greater(Real a, Real b) {
  return number(a).value > number(b).value;
}
Real is_at_most(Real a, Real b) {
  return number(a).value <= number(b).value;
}
Real is_at_least(Real a, Real b) {
  return number(a).value >= number(b).value;
}
Real is_equal(Real a, Real b) {
  return number(a).value == number(b).value;
}
Real is_other(Real a, Real b) {
  return number(a).value != number(b).value;
}
Real both(Real a, Real b) {
  return number(a).value != 0 && number(b).value != 0;
}
Real either(Real a, Real b) {
  return number(a).value != 0 || number(b).value != 0;
}

/// Defines the functions and operators of Expression for jets.
void define_language(mu::Parser& parser) {
  parser.ClearFun();
  parser.ClearConst();
  parser.ClearOprt();
  parser.ClearInfixOprt();
  parser.EnableBuiltInOprt(false);
  parser.DefineFun("sin", call<of_sin>);
  parser.DefineFun("cos", call<of_cos>);
  parser.DefineFun("tan", call<of_tan>);
  parser.DefineFun("asin", call<of_asin>);
  parser.DefineFun("acos", call<of_acos>);
  parser.DefineFun("atan", call<of_atan>);
  parser.DefineFun("atan2", angle);
  parser.DefineFun("sinh", call<of_sinh>);
  parser.DefineFun("cosh", call<of_cosh>);
  parser.DefineFun("tanh", call<of_tanh>);
  parser.DefineFun("exp", call<of_exp>);
  parser.DefineFun("log", call<of_log>);
  parser.DefineFun("log10", call<of_log10>);
  parser.DefineFun("sqrt", call<of_sqrt>);
  parser.DefineFun("cbrt", call<of_cbrt>);
  parser.DefineFun("abs", call<of_abs>);
  parser.DefineFun("sign", call<of_sign>);
  parser.DefineFun("floor", call<of_floor>);
  parser.DefineFun("ceil", call<of_ceil>);
  parser.DefineFun("erf", call<of_erf>);
  parser.DefineFun("pow", power);
  parser.DefineFun("min", first_by<std::less<Real>>);
  parser.DefineFun("max", first_by<std::greater<Real>>);
  parser.DefineConst("pi", std::numbers::pi);
  parser.DefineConst("e", std::numbers::e);
  parser.DefineInfixOprt("-", negative);
  parser.DefineInfixOprt("+", same);
  parser.DefineOprt("||", either, mu::prLOR);
  parser.DefineOprt("&&", both, mu::prLAND);
  parser.DefineOprt("<", is_less, mu::prCMP);
  parser.DefineOprt(">", is_greater, mu::prCMP);
  parser.DefineOprt("<=", is_at_most, mu::prCMP);
  parser.DefineOprt(">=", is_at_least, mu::prCMP);
  parser.DefineOprt("==", is_equal, mu::prCMP);
  parser.DefineOprt("!=", is_other, mu::prCMP);
  parser.DefineOprt("+", add, mu::prADD_SUB);
  parser.DefineOprt("-", subtract, mu::prADD_SUB);
  parser.DefineOprt("*", multiply, mu::prMUL_DIV);
  parser.DefineOprt("/", divide, mu::prMUL_DIV);
  parser.DefineOprt("^", power, mu::prPOW, mu::oaRIGHT);
}

}  // namespace jet_language
}  // namespace

struct ExpressionJets::Parsed {
  std::array<Real, 4> variables{};  ///< handles of x, y, z, and t
  mu::Parser parser;
};

ExpressionJets::ExpressionJets(const std::string& formula, const NamedNumbers& constants)
    : parsed_(std::make_unique<Parsed>()) {
  constexpr std::array<const char*, 4> names{"x", "y", "z", "t"};
  jet_language::define_language(parsed_->parser);
  for (const auto& [name, value] : constants) parsed_->parser.DefineConst(name, value);
  for (std::size_t i = 0; i < names.size(); ++i)
    parsed_->parser.DefineVar(names[i], &parsed_->variables[i]);
  parsed_->parser.SetExpr(formula);
}

ExpressionJets::~ExpressionJets() = default;

Jet<3> ExpressionJets::operator()(const Eigen::Vector3d& X, Real t) {
  jet_language::jets.clear();
  for (int k = 0; k < 3; ++k)
    at(parsed_->variables, k) = jet_language::handle(Jet<3>::variable(X, k));
  parsed_->variables[3] = t;
  return jet_language::number(parsed_->parser.Eval());
}

}  // namespace meniscus
