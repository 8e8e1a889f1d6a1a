// SPDX-License-Identifier: BSD-3-Clause
// Replaces calls of the functions of a scene by their formulas.
#include "input/functions.hpp"

#include "input/text.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <map>

namespace meniscus {
namespace {

bool is_digit_or_point(char c) {
  return (c >= '0' && c <= '9') || c == '.';
}
bool begins_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool continues_name(char c) {
  return begins_name(c) || (c >= '0' && c <= '9');
}

/// Position behind the number that begins at `i`.
std::size_t end_of_number(std::string_view text, std::size_t i) {
  while (i < text.size() && is_digit_or_point(text[i])) ++i;
  if (i == text.size() || (text[i] != 'e' && text[i] != 'E')) return i;
  std::size_t exponent = i + 1;
  if (exponent < text.size() && (text[exponent] == '+' || text[exponent] == '-')) ++exponent;
  if (exponent == text.size() || !is_digit_or_point(text[exponent])) return i;
  while (exponent < text.size() && is_digit_or_point(text[exponent])) ++exponent;
  return exponent;
}

bool is_name(std::string_view text) {
  return !text.empty() && begins_name(text.front()) &&
         std::all_of(text.begin(), text.end(), continues_name);
}

std::string trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t"), end = text.find_last_not_of(" \t");
  return begin == std::string_view::npos ? "" : std::string(text.substr(begin, end + 1 - begin));
}

/// Arguments of a call, separated at commas. `open` is the position of the opening bracket; `close`
/// becomes the position behind the closing one. Throws InputError if that is missing.
std::vector<std::string> arguments_at(std::string_view formula, std::size_t open,
                                      std::size_t& close) {
  std::vector<std::string> arguments(1);
  int depth = 0;
  for (std::size_t i = open; i < formula.size(); ++i) {
    const char c = formula[i];
    if (c == ')' && --depth == 0) {
      close = i + 1;
      if (arguments.size() == 1 && trimmed(arguments[0]).empty()) arguments.clear();
      return arguments;
    }
    if (c == ',' && depth == 1)
      arguments.emplace_back();
    else if (depth > 0)
      arguments.back() += c;
    if (c == '(') ++depth;
  }
  throw InputError(fmt::format("formula '{}': a closing bracket is missing", formula));
}

std::string written(const Functions::Function& f) {
  return f.arguments.empty() ? f.name : f.name + "(" + joined(f.arguments, ", ") + ")";
}

}  // namespace

std::vector<NamePlace> name_places(std::string_view formula) {
  std::vector<NamePlace> places;
  for (std::size_t i = 0; i < formula.size();) {
    if (is_digit_or_point(formula[i])) {
      i = end_of_number(formula, i);
    } else if (begins_name(formula[i])) {
      const std::size_t begin = i;
      while (i < formula.size() && continues_name(formula[i])) ++i;
      places.push_back({begin, i});
    } else {
      ++i;
    }
  }
  return places;
}

/// Expansion of one formula.
class Functions::Expansion {
 public:
  using Arguments = std::map<std::string, std::string, std::less<>>;  ///< [name] text without calls

  /// `trail`: names of the functions that are being expanded, to detect recursion.
  explicit Expansion(const Functions& functions, std::vector<std::string> trail = {})
      : functions_(functions), trail_(std::move(trail)) {}

  std::string of(std::string_view formula, const Arguments& known) {
    std::string text;
    std::size_t done = 0;
    for (const NamePlace& place : name_places(formula)) {
      if (place.begin < done) continue;  // part of a call that was already expanded
      text += formula.substr(done, place.begin - done);
      done = place.end;
      const std::string_view name = formula.substr(place.begin, place.end - place.begin);
      if (const auto argument = known.find(name); argument != known.end())
        text += "(" + argument->second + ")";
      else if (const Function* function = functions_.find(name))
        text += call(*function, formula, done, known);
      else
        text += name;
      constexpr std::size_t longest = 100'000;
      if (text.size() > longest)
        throw InputError(fmt::format("formula '{}' has more than {} characters without [functions]",
                                     formula.substr(0, 60), longest));
    }
    return text + std::string(formula.substr(done));
  }

 private:
  /// Expands one call. `done` is the position behind the name, and on return the position behind
  /// the call.
  std::string call(const Function& function, std::string_view formula, std::size_t& done,
                   const Arguments& known) {
    constexpr int most_calls = 10'000;
    if (++calls_ > most_calls)
      throw InputError(
          fmt::format("formula '{}' calls functions more than {} times; expected are "
                      "functions that call each other less often",
                      formula.substr(0, 60), most_calls));
    const std::size_t open = std::min(formula.find_first_not_of(' ', done), formula.size());
    std::vector<std::string> given;
    if (open < formula.size() && formula[open] == '(') given = arguments_at(formula, open, done);
    if (given.size() != function.arguments.size())
      throw InputError(fmt::format("formula '{}': '{}' has {} arguments; allowed is {}", formula,
                                   function.name, given.size(), written(function)));
    Arguments own;
    for (std::size_t i = 0; i < given.size(); ++i)
      own[function.arguments[i]] = of(trimmed(given[i]), known);
    if (std::find(trail_.begin(), trail_.end(), function.name) != trail_.end()) {
      trail_.push_back(function.name);
      throw InputError(fmt::format("'{}' needs itself: {}; allowed are formulas of other functions",
                                   function.name, joined(trail_, " -> ")));
    }
    trail_.push_back(function.name);
    std::string text = "(" + of(function.formula, own) + ")";
    trail_.pop_back();
    return text;
  }

  const Functions& functions_;
  std::vector<std::string> trail_;  ///< functions being expanded; each calls the next
  int calls_ = 0;
};

Functions::Function Functions::signature(const std::string& key) {
  const std::size_t open = key.find('(');
  Function function{trimmed(key.substr(0, open)), {}, {}};
  bool sound = is_name(function.name);
  if (sound && open != std::string::npos) {
    std::size_t close = 0;
    sound = key.find(')') == key.size() - 1;
    if (sound)
      for (const std::string& argument : arguments_at(key, open, close))
        function.arguments.push_back(trimmed(argument));
    sound = sound && !function.arguments.empty();
  }
  for (const std::string& argument : function.arguments)
    sound = sound && is_name(argument) &&
            std::count(function.arguments.begin(), function.arguments.end(), argument) == 1;
  if (!sound)
    throw InputError(
        "cannot be a function; allowed are NAME, of the place and the time, and \"NAME(a, b)\" of "
        "different arguments, with names of letters, digits and _, no digit first");
  return function;
}

const Functions::Function* Functions::find(std::string_view name) const {
  const auto found = std::find_if(functions_.begin(), functions_.end(),
                                  [&](const Function& f) { return f.name == name; });
  return found == functions_.end() ? nullptr : &*found;
}

std::vector<std::string> Functions::names() const {
  std::vector<std::string> names;
  for (const Function& function : functions_) names.push_back(function.name);
  return names;
}

bool Functions::in(std::string_view formula) const {
  if (empty()) return false;
  const std::vector<NamePlace> places = name_places(formula);
  return std::any_of(places.begin(), places.end(), [&](const NamePlace& place) {
    return find(formula.substr(place.begin, place.end - place.begin)) != nullptr;
  });
}

std::string Functions::expanded(const std::string& formula) const {
  return in(formula) ? Expansion(*this).of(formula, {}) : formula;
}

std::string Functions::body(const Function& function) const {
  Expansion::Arguments own;
  for (const std::string& argument : function.arguments) own[argument] = argument;
  return Expansion(*this, {function.name}).of(function.formula, own);
}

}  // namespace meniscus
