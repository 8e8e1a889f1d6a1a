// SPDX-License-Identifier: BSD-3-Clause
// Named numbers of a scene, the table [constants], and the values of formulas with them.
#pragma once
#include "input/expression.hpp"
#include "input/functions.hpp"
#include "input/units.hpp"

#include <array>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

/// The names in a formula, in order, including functions and variables, without the e of 2e9.
std::vector<std::string> names_in(std::string_view formula);

/// Named numbers in units of the scene, with their dimensions. Each constant is stored four times:
/// once in these units, and once each with the unit of length, time or mass halved. The change of a
/// formula between these sets gives its dimension. Plain numbers may have any dimension: in the
/// other sets they, and constants that depend on them, are NaN.
class Constants {
 public:
  /// Adds a constant: a plain number without `Dimension`, else a number in units of the scene.
  void add(const std::string& name, Real value, std::optional<Dimension> = {});
  /// Adds the value of a formula of the constants added so far. Throws InputError (without a place)
  /// if the formula uses anything else or is not finite.
  void add_formula(const std::string& name, const std::string& formula);
  /// Adds a constant given in deg or rad. Formulas use its radians. Constants that depend on it
  /// count as angles, too.
  void add_angle(const std::string& name, Real radians);
  /// Adds a constant whose problem was already reported: formulas with it get no message of their
  /// own.
  void add_broken(const std::string& name) { broken_.insert(name); }

  bool empty() const { return numbers().empty() && broken_.empty() && functions.empty(); }
  const NamedNumbers& numbers() const { return numbers_[0]; }
  /// True if the formula uses a constant (broken ones included) or a function of [functions].
  bool in(std::string_view formula) const;
  bool broken_in(std::string_view formula) const;
  bool angle_in(std::string_view formula) const;

  /// The value of a formula without variables. Throws InputError (without a place) if the formula
  /// has variables, or if its constants give it a dimension other than `expected`. A formula
  /// without dimension is accepted as any.
  Real value(const std::string& formula, Dimension expected) const;
  /// The dimension that its constants give to a formula without variables. Empty if it is unknown
  /// (plain numbers) or impossible, as of radius + 1.
  std::optional<Dimension> dimension_of(const std::string& formula) const;

  /// "; did you mean 'bump'?" if the formula has an unknown name that resembles a function of
  /// [functions].
  std::string hint(std::string_view formula) const;

  /// The functions of [functions]. The members above expect formulas in which calls of these are
  /// already expanded; in() and hint() take any formula.
  Functions functions;

 private:
  bool plain_number_in(std::string_view formula) const;

  std::array<NamedNumbers, 4> numbers_;  ///< the values; the values with half the unit of length,
                                         ///< of time, of mass
  std::set<std::string> broken_, angles_;
};

}  // namespace meniscus
