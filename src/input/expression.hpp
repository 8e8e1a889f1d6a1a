// SPDX-License-Identifier: BSD-3-Clause
// Formulas in scenes, such as "2e9*(1 + 0.1*x)".
#pragma once
#include "numbers/types.hpp"

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace meniscus {

template <int D>
struct Jet;

/// Numbers that formulas may use by name.
using NamedNumbers = std::vector<std::pair<std::string, Real>>;

/// True if `word` has a meaning in formulas: a variable, pi, e or a function.
bool is_word_of_formulas(std::string_view word);

/// A real function of reference position x, y, z and time t. Formulas may contain:
///
/// - the constants pi and e, given constants, numbers, brackets, + - * / ^ (with -x^2 = -(x^2));
///
/// - comparisons < > <= >= == !=, && and ||, and `condition ? a : b`;
///
/// - sin cos tan asin acos atan atan2 sinh cosh tanh exp log (natural) log10 sqrt cbrt abs sign
///   floor ceil erf pow min max (the last two with any number of arguments).
///
/// Copies share the parsed formula. Threads that evaluate a formula wait for each other at one
/// lock: fill arrays before the time loop instead of evaluating inside it. Constants and formulas
/// without variables take no lock.
class Expression {
 public:
  /// A constant.
  Expression(Real value = 0);
  /// Throws InputError (without a place) naming the offending part of the formula.
  explicit Expression(std::string formula, const NamedNumbers& constants = {});

  /// The value at X (units of the scene) and t. Throws SolveError with place, formula, X and t if
  /// the value is infinite or NaN.
  Real operator()(const Eigen::Vector3d& X, Real t = 0) const;
  /// Like operator(), but returns infinite values and NaN: the caller has to check the range.
  Real unchecked(const Eigen::Vector3d& X, Real t = 0) const;
  /// The value with its exact first and second derivatives with respect to x, y, z. At a kink (abs,
  /// sign, floor, ceil, min, max, conditions) the derivatives belong to the branch taken at X. The
  /// caller has to check that all numbers are finite.
  Jet<3> jet(const Eigen::Vector3d& X, Real t = 0) const;
  /// Sets the place of the formula in the input, "file:line:column: key", which begins messages.
  void set_place(std::string place);
  /// The place set by set_place(); empty for a constant or if none was set.
  const std::string& place() const;

  /// Sets the end time of the scene, up to which steady_after() looks.
  void set_end(Real end);
  /// The time after which the value is constant until the end of the scene: 0 without t; for a
  /// formula of t alone found from its values, which are seen at intervals of 1e-4 of the end;
  /// otherwise infinity, also if it is not finite at the end.
  Real steady_after() const;

  /// The formula as given. For a constant, the shortest decimal that reads back as the same number.
  const std::string& text() const { return text_; }
  /// True if no variable occurs.
  bool constant() const { return parsed_ == nullptr; }
  /// True if the variable t occurs.
  bool depends_on_time() const { return depends_on_[3]; }
  /// True if x, y or z occurs.
  bool depends_on_place() const { return depends_on_[0] || depends_on_[1] || depends_on_[2]; }
  /// True if x (0), y (1) or z (2) occurs.
  bool depends_on_axis(int axis) const { return at(depends_on_, axis); }

 private:
  struct Parsed;
  std::string text_;
  Real value_ = 0;                    ///< the value of a constant
  std::array<bool, 4> depends_on_{};  ///< x, y, z, t
  std::shared_ptr<Parsed> parsed_;
};

}  // namespace meniscus
