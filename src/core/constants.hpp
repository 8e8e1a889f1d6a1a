// SPDX-License-Identifier: BSD-3-Clause
// Named numbers of a scene, the table [constants], and what formulas of them are.
#pragma once
#include "meniscus/core/expression.hpp"
#include "meniscus/core/units.hpp"

#include <array>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "functions.hpp"

namespace meniscus {

/// Names in a formula, in their order, functions and variables included; not the e of 2e9.
std::vector<std::string> names_in(std::string_view formula);

/// Named numbers in units of the scene. What has a unit keeps its dimension: beside its number in
/// the scene's units, each constant has those it would have if one of length, time and mass were
/// measured in half of its unit, so that the dimension of a formula is seen by how it changes.
/// Plain numbers may be of any dimension: those are not numbers then, nor is what follows from
/// them.
class Constants {
 public:
  /// A plain number, or one of that dimension in units of the scene.
  void add(const std::string& name, Real value, std::optional<Dimension> = {});
  /// What a formula of the constants so far gives. Throws InputError (without a place) if it
  /// depends on anything else or is not finite.
  void add_formula(const std::string& name, const std::string& formula);
  /// One given in deg or rad, of which formulas know the radians; so is what follows from it.
  void add_angle(const std::string& name, Real radians);
  /// One with a problem that was noted; formulas of it need no message of their own.
  void add_broken(const std::string& name) { broken_.insert(name); }

  bool empty() const { return numbers().empty() && broken_.empty() && functions.empty(); }
  const NamedNumbers& numbers() const { return numbers_[0]; }
  /// A formula uses one of them, or one of the functions, broken ones included.
  bool in(std::string_view formula) const;
  bool broken_in(std::string_view formula) const;
  bool angle_in(std::string_view formula) const;

  /// The number of a formula without variables. Throws InputError (without a place) if there are
  /// some, or if it has a dimension by its constants that is not `expected`; plain numbers are
  /// whatever is needed.
  Real value(const std::string& formula, Dimension expected) const;
  /// The dimension that a formula without variables has by its constants; nothing if it is none, as
  /// of radius + 1.
  std::optional<Dimension> dimension_of(const std::string& formula) const;

  /// "; did you mean 'bump'?" of a name in the formula that nobody knows, if a function is called
  /// nearly so.
  std::string hint(std::string_view formula) const;

  /// Those of [functions]. What stands above is said of formulas without calls of them.
  Functions functions;

 private:
  bool plain_number_in(std::string_view formula) const;

  std::array<NamedNumbers, 4> numbers_;  ///< as measured; with half the unit of length, time, mass
  std::set<std::string> broken_, angles_;
};

}  // namespace meniscus
