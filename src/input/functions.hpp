// SPDX-License-Identifier: BSD-3-Clause
// Named formulas of a scene, the table [functions], and formulas in which they are called.
#pragma once
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace meniscus {

/// Where a name stands in a formula.
struct NamePlace {
  std::size_t begin, end;
};

/// Names in a formula, in their order, functions and variables included; not the e of 2e9.
std::vector<NamePlace> name_places(std::string_view formula);

/// A function is put in the place of its calls, as a formula in brackets: what is made of formulas
/// knows constants and variables alone. A name in a function is that of an argument, or else means
/// what it means everywhere: an argument called x hides the place x in that function only.
class Functions {
 public:
  struct Function {
    std::string name;
    std::vector<std::string> arguments;
    std::string formula;
  };

  /// Of a key: "bump(r, a)", or "wave" of none. Throws InputError (without a place) if it is none.
  static Function signature(const std::string& key);
  void add(Function function) { functions_.push_back(std::move(function)); }
  bool empty() const { return functions_.empty(); }
  const Function* find(std::string_view name) const;
  std::vector<std::string> names() const;
  /// A formula calls one of them.
  bool in(std::string_view formula) const;

  /// The formula without calls. Throws InputError (without a place): a function that needs itself,
  /// a wrong count of arguments, a bracket that does not close, a formula that becomes too long or
  /// calls functions too often.
  std::string expanded(const std::string& formula) const;
  /// The formula of a function without calls, its arguments as they are.
  std::string body(const Function& function) const;

 private:
  class Expansion;
  std::vector<Function> functions_;
};

}  // namespace meniscus
