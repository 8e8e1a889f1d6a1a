// SPDX-License-Identifier: BSD-3-Clause
// Formulas in scenes, evaluated by muParser.
#include "input/expression.hpp"

#include "input/expression_jets.hpp"
#include "input/names.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>
#include <muParser.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace meniscus {

/// A parsed formula. All copies share the stack and the variables of muParser, which the lock
/// protects.
struct Expression::Parsed {
  std::mutex lock;
  std::array<Real, 4> variables{};  ///< x, y, z, t
  mu::Parser parser;
  std::string place;
  NamedNumbers constants;
  std::optional<ExpressionJets> jets;  ///< made at the first call of jet()
  Real end = 0;                        ///< of the scene; 0: not known
  std::optional<Real> steady_after;    ///< found at its first call
};

namespace {

constexpr std::array<const char*, 4> variable_names{"x", "y", "z", "t"};
constexpr std::size_t own_constants = 2;  ///< pi and e

template <Real (*function)(Real)>
Real call(Real a) {
  return function(a);
}
template <Real (*function)(Real, Real)>
Real call(Real a, Real b) {
  return function(a, b);
}
Real sign(Real a) {
  return a > 0 ? 1 : a < 0 ? -1 : 0;
}
Real least(const Real* values, int count) {
  return *std::min_element(values, values + count);
}
Real greatest(const Real* values, int count) {
  return *std::max_element(values, values + count);
}

/// Defines all functions, constants and variables of formulas, so that results do not depend on the
/// version of muParser.
void define_language(mu::Parser& parser, std::array<Real, 4>& variables) {
  parser.ClearFun();
  parser.ClearConst();
  parser.DefineFun("sin", call<std::sin>);
  parser.DefineFun("cos", call<std::cos>);
  parser.DefineFun("tan", call<std::tan>);
  parser.DefineFun("asin", call<std::asin>);
  parser.DefineFun("acos", call<std::acos>);
  parser.DefineFun("atan", call<std::atan>);
  parser.DefineFun("atan2", call<std::atan2>);
  parser.DefineFun("sinh", call<std::sinh>);
  parser.DefineFun("cosh", call<std::cosh>);
  parser.DefineFun("tanh", call<std::tanh>);
  parser.DefineFun("exp", call<std::exp>);
  parser.DefineFun("log", call<std::log>);
  parser.DefineFun("log10", call<std::log10>);
  parser.DefineFun("sqrt", call<std::sqrt>);
  parser.DefineFun("cbrt", call<std::cbrt>);
  parser.DefineFun("abs", call<std::fabs>);
  parser.DefineFun("sign", call<sign>);
  parser.DefineFun("floor", call<std::floor>);
  parser.DefineFun("ceil", call<std::ceil>);
  parser.DefineFun("erf", call<std::erf>);
  parser.DefineFun("pow", call<std::pow>);
  parser.DefineFun("min", least);
  parser.DefineFun("max", greatest);
  parser.DefineConst("pi", std::numbers::pi);
  parser.DefineConst("e", std::numbers::e);
  for (std::size_t i = 0; i < variables.size(); ++i)
    parser.DefineVar(variable_names[i], &variables[i]);
}

std::vector<std::string> known_names(const mu::Parser& parser) {
  std::vector<std::string> names(variable_names.begin(), variable_names.end());
  for (const auto& constant : parser.GetConst()) names.push_back(constant.first);
  for (const auto& function : parser.GetFunDef()) names.push_back(function.first);
  return names;
}

/// Refuses formulas that muParser would misread silently: a control character ends the formula, and
/// a single = assigns to x, y, z or t.
void refuse_traps(const std::string& formula) {
  constexpr std::string_view partners = "=!<>";
  for (std::size_t i = 0; i < formula.size(); ++i) {
    if (static_cast<unsigned char>(formula[i]) < 0x20)
      throw InputError(fmt::format("a formula has a control character (byte {}) at character {}",
                                   static_cast<int>(formula[i]), i + 1));
    if (formula[i] != '=') continue;
    const bool closes = i > 0 && partners.find(formula[i - 1]) != std::string_view::npos;
    const bool opens = i + 1 < formula.size() && formula[i + 1] == '=';
    if (!closes && !opens)
      throw InputError(fmt::format(
          "formula '{}': '=' at character {} is not allowed; equality is written ==", formula,
          i + 1));
  }
}

bool has_decimal_comma(const std::string& formula) {
  const auto digit = [&](std::size_t i) {
    return i < formula.size() && formula[i] >= '0' && formula[i] <= '9';
  };
  for (std::size_t i = 1; i < formula.size(); ++i)
    if (formula[i] == ',' && digit(i - 1) && digit(i + 1)) return true;
  return false;
}

/// The error of muParser as a message of this program.
std::string explain(const mu::ParserError& error, const mu::Parser& parser,
                    const std::string& formula) {
  const std::string& token = error.GetToken();
  const auto place = [&] {
    const int position = error.GetPos();
    const bool known = position >= 0 && static_cast<std::size_t>(position) < formula.size();
    return known ? fmt::format(" at character {}", position + 1) : std::string(" at its end");
  };
  switch (error.GetCode()) {
    case mu::ecUNASSIGNABLE_TOKEN: {
      const std::string name = token.substr(0, token.find_first_not_of(parser.ValidNameChars()));
      if (name.empty())
        return fmt::format("unexpected '{}'{}", token.substr(0, token.find(' ')), place());
      return fmt::format(
          "unknown name '{}'{}; allowed are x, y, z, t, pi, e{} and functions such as sqrt{}", name,
          place(), parser.GetConst().size() > own_constants ? ", the [constants]" : "",
          did_you_mean(name, known_names(parser)));
    }
    case mu::ecEXPRESSION_TOO_LONG:
      return fmt::format("it is longer than {} characters", int{mu::MaxLenExpression});
    case mu::ecEMPTY_EXPRESSION:
      return "it is empty";
    case mu::ecUNEXPECTED_EOF:
      return "it ends too early";
    case mu::ecMISSING_PARENS:
      return "a closing bracket is missing";
    case mu::ecTOO_MANY_PARAMS:
      return fmt::format("too many arguments of '{}'", token);
    case mu::ecTOO_FEW_PARAMS:
      return fmt::format("too few arguments of '{}'", token);
    default:
      return token.empty() ? fmt::format("it cannot be understood{}", place())
                           : fmt::format("unexpected '{}'{}", token, place());
  }
}

}  // namespace

Expression::Expression(Real value) : text_(fmt::format("{}", value)), value_(value) {}

bool is_word_of_formulas(std::string_view word) {
  mu::Parser parser;
  std::array<Real, 4> variables{};
  define_language(parser, variables);
  const std::vector<std::string> known = known_names(parser);
  return std::find(known.begin(), known.end(), word) != known.end();
}

Expression::Expression(std::string formula, const NamedNumbers& constants)
    : text_(std::move(formula)) {
  refuse_traps(text_);
  auto parsed = std::make_shared<Parsed>();
  try {
    define_language(parsed->parser, parsed->variables);
    for (const auto& [name, value] : constants) parsed->parser.DefineConst(name, value);
    parsed->parser.SetExpr(text_);
    value_ = parsed->parser.Eval();
    if (parsed->parser.GetNumResults() != 1)
      throw InputError(
          fmt::format("formula '{}': ',' outside of a function{}", text_,
                      has_decimal_comma(text_) ? "; decimals take a point, as in 0.5" : ""));
    const auto& used = parsed->parser.GetUsedVar();
    for (std::size_t i = 0; i < variable_names.size(); ++i)
      at(depends_on_, i) = used.count(variable_names[i]) != 0;
    parsed->constants = constants;
    if (!used.empty()) parsed_ = std::move(parsed);
  } catch (const mu::ParserError& error) {
    throw InputError(fmt::format("formula '{}': {}", text_, explain(error, parsed->parser, text_)));
  }
}

Real Expression::operator()(const Eigen::Vector3d& X, Real t) const {
  const Real value = unchecked(X, t);
  if (std::isfinite(value) || constant()) return value;
  throw SolveError(fmt::format(
      "{}formula '{}' is {} at x = {:.6g}, y = {:.6g}, z = {:.6g}, t = {:.6g}; allowed are finite "
      "numbers",
      parsed_->place.empty() ? "" : parsed_->place + ": ", text_,
      std::isnan(value) ? "not a number" : "infinite", X[0], X[1], X[2], t));
}

void Expression::set_place(std::string place) {
  if (parsed_) parsed_->place = std::move(place);
}

void Expression::set_end(Real end) {
  if (parsed_) parsed_->end = end;
}

Real Expression::steady_after() const {
  constexpr Real never = std::numeric_limits<Real>::infinity();
  if (!depends_on_time()) return 0;
  if (depends_on_place() || !(parsed_->end > 0)) return never;
  if (parsed_->steady_after) return *parsed_->steady_after;
  constexpr int parts = 10000;
  // Irregular times: a formula may have a period that fits into regular ones.
  const auto time = [&](int k) {
    const Real irregular = k * std::numbers::phi, within = irregular - std::floor(irregular);
    return (k + within) * parsed_->end / parts;
  };
  const Eigen::Vector3d nowhere = Eigen::Vector3d::Zero();
  const Real last = unchecked(nowhere, parsed_->end);
  int k = parts - 1;
  while (k >= 0 && unchecked(nowhere, time(k)) == last) --k;
  if (k == parts - 1 || k < 0) {
    parsed_->steady_after = k < 0 ? 0 : never;
    return *parsed_->steady_after;
  }
  Real changes = time(k), constant = time(k + 1);
  for (int halving = 0; halving < 30; ++halving) {
    const Real middle = (changes + constant) / 2;
    (unchecked(nowhere, middle) == last ? constant : changes) = middle;
  }
  parsed_->steady_after = constant;
  return constant;
}

const std::string& Expression::place() const {
  static const std::string none;
  return parsed_ ? parsed_->place : none;
}

Real Expression::unchecked(const Eigen::Vector3d& X, Real t) const {
  if (constant()) return value_;
  const std::lock_guard guard(parsed_->lock);
  parsed_->variables = {X[0], X[1], X[2], t};
  return parsed_->parser.Eval();
}

Jet<3> Expression::jet(const Eigen::Vector3d& X, Real t) const {
  if (constant()) return value_;
  const std::lock_guard guard(parsed_->lock);
  if (!parsed_->jets) parsed_->jets.emplace(text_, parsed_->constants);
  return (*parsed_->jets)(X, t);
}

}  // namespace meniscus
