// SPDX-License-Identifier: BSD-3-Clause
// Named formulas of a scene (table [functions]), and formulas that call them.
#pragma once
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace meniscus {

/// Position of a name in a formula.
struct NamePlace {
  std::size_t begin, end;
};

/// Positions of all names in a formula, in order, including functions and variables, but not the e
/// of 2e9.
std::vector<NamePlace> name_places(std::string_view formula);

/// Expands calls of functions: each call is replaced by the formula of the function in brackets.
/// Code behind this class sees only constants and variables. Within a function, the name of an
/// argument hides a constant or variable of the same name, for example the position x.
class Functions {
 public:
  struct Function {
    std::string name;
    std::vector<std::string> arguments;
    std::string formula;
  };

  /// Parses the key of a function: "bump(r, a)", or "wave" for a function without arguments. Throws
  /// InputError (without a place) if the key is malformed.
  static Function signature(const std::string& key);
  void add(Function function) { functions_.push_back(std::move(function)); }
  bool empty() const { return functions_.empty(); }
  const Function* find(std::string_view name) const;
  std::vector<std::string> names() const;
  /// True if a formula calls one of these functions.
  bool in(std::string_view formula) const;

  /// The formula with all calls expanded. Throws InputError (without a place) for recursion, a
  /// wrong number of arguments, an open bracket, a result that is too long, or too many calls.
  std::string expanded(const std::string& formula) const;
  /// The formula of a function with all calls expanded; its own arguments remain names.
  std::string body(const Function& function) const;

 private:
  class Expansion;
  std::vector<Function> functions_;
};

}  // namespace meniscus
