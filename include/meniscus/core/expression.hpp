// SPDX-License-Identifier: BSD-3-Clause
// Formulas in scenes, such as "2e9*(1 + 0.1*x)".
#pragma once
#include "meniscus/core/types.hpp"

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

/// Whether formulas know `word` themselves: a variable, pi, e or a function.
bool is_word_of_formulas(std::string_view word);

/// A real function of reference position x, y, z and time t. A formula may use
/// - the constants pi and e and those that are given, numbers, brackets, + - * / ^ (with -x^2 =
/// -(x^2)),
/// - comparisons < > <= >= == !=, && and ||, and `condition ? a : b`,
/// - sin cos tan asin acos atan atan2 sinh cosh tanh exp log (natural) log10 sqrt cbrt abs sign
///   floor ceil erf pow min max (the last two with any number of arguments).
///
/// Copies share the parsed formula. Several threads may evaluate at once, but they take turns at
/// one lock: fill arrays before the time loop instead of evaluating inside it. Constants, also
/// formulas without variables, take no lock.
class Expression {
 public:
  /// A constant.
  Expression(Real value = 0);
  /// Throws InputError (without a place) naming the offending part of the formula.
  explicit Expression(std::string formula, const NamedNumbers& constants = {});

  /// The value at X (units of the scene) and t. Throws SolveError with place, formula, X and t if
  /// that is infinite or not a number.
  Real operator()(const Eigen::Vector3d& X, Real t = 0) const;
  /// The same for callers with a range of their own; it may be infinite or not a number.
  Real unchecked(const Eigen::Vector3d& X, Real t = 0) const;
  /// The value with its exact first and second derivatives with respect to x, y, z; those of abs,
  /// sign, floor, ceil, min, max and of conditions are of the branch at X. What is not finite is
  /// for the caller to find.
  Jet<3> jet(const Eigen::Vector3d& X, Real t = 0) const;
  /// Where the formula stands, "file:line:column: key", to begin messages with.
  void set_place(std::string place);
  /// Empty if nobody said it, or of a constant.
  const std::string& place() const;

  /// The formula as given; the shortest decimal that reads back as the same number for a constant.
  const std::string& text() const { return text_; }
  /// No variable occurs.
  bool constant() const { return parsed_ == nullptr; }
  /// The variable t occurs.
  bool depends_on_time() const { return depends_on_[3]; }
  /// x, y or z occurs.
  bool depends_on_place() const { return depends_on_[0] || depends_on_[1] || depends_on_[2]; }
  /// x (0), y (1) or z (2) occurs.
  bool depends_on_axis(int axis) const { return at(depends_on_, axis); }

 private:
  struct Parsed;
  std::string text_;
  Real value_ = 0;                    ///< of a constant
  std::array<bool, 4> depends_on_{};  ///< x, y, z, t
  std::shared_ptr<Parsed> parsed_;
};

}  // namespace meniscus
