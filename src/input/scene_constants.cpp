// SPDX-License-Identifier: BSD-3-Clause
// Reads [constants] (numbers, quantities, and formulas of other constants) and [functions].
#include "input/input.hpp"
#include "input/input_node.hpp"
#include "input/input_values.hpp"
#include "input/names.hpp"
#include "input/quantity.hpp"
#include "input/text.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace meniscus {
namespace {

/// Throws InputError (without a place) if the name has another meaning in formulas.
void require_free_name(const std::string& name) {
  const bool plain = std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return c < 0x80 && (std::isalnum(c) != 0 || c == '_');
  });
  if (name.empty() || !plain || std::isdigit(static_cast<unsigned char>(name.front())) != 0)
    throw InputError(
        "cannot be the name of a constant; allowed are letters, digits and _, no digit first");
  if (is_word_of_formulas(name))
    throw InputError(
        fmt::format("'{}' has a meaning in formulas already; allowed is any other name, "
                    "such as {}_0",
                    name, name));
  if (is_unit(name))
    throw InputError(fmt::format(
        "'{0}' is a unit, and 2*{0} could be both; allowed is any other name, such as {0}_0",
        name));
}

}  // namespace

/// Evaluates constants in the order of their dependencies.
class Block::Node::ConstantsReader {
 public:
  explicit ConstantsReader(Node& table) : table_(table) {}

  void read(const scene_tree::Entry& entry) {
    if (!begun_.insert(entry.key).second) return;
    under_way_.push_back(entry.key);
    const auto sound =
        table_.attempt(entry.value, scene_tree::joined(table_.path, entry.key),
                       [&](const scene_tree::Value& value) { return number(entry.key, value); });
    if (!sound.value_or(false)) constants().add_broken(entry.key);
    under_way_.pop_back();
  }

 private:
  Constants& constants() { return table_.document->constants; }
  const UnitSystem& units() const { return table_.document->units; }

  /// Adds the constant. Returns false if a constant that it needs is broken, which is already
  /// reported.
  bool number(const std::string& name, const scene_tree::Value& value) {
    require_free_name(name);
    if (constants().functions.find(name) != nullptr)
      throw InputError("is the name of one of [functions], too; allowed is any other name");
    if (const auto* given = std::get_if<std::string>(&value.data)) {
      if (constants().broken_in(*given)) return false;
      const std::string text = constants().functions.expanded(*given);
      if (!read_needed(text)) return false;
      constants().functions.in(*given) ? constants().add_formula(name, text) : add(name, text);
    } else {
      constants().add(name, plain_number(value));
    }
    const auto dimension = constants().dimension_of(name).value_or(dimension::none);
    table_.echo(name, input_values::toml(constants().numbers().back().second),
                dimension == dimension::none ? "" : units().symbol(dimension), false);
    return true;
  }

  Real plain_number(const scene_tree::Value& value) {
    if (std::holds_alternative<Real>(value.data) ||
        std::holds_alternative<std::int64_t>(value.data))
      return table_.number(dimension::none, range::any).real(value);
    input_values::refuse_kind(value, "a number, a text with a unit, or a formula of [constants]");
  }

  /// Reads the constants that occur in a text. Returns true if all of them are valid.
  bool read_needed(const std::string& text) {
    for (const std::string& needed : names_in(text)) {
      const scene_tree::Entry* entry = table_.table->find(needed);
      if (entry == nullptr) continue;
      if (const auto begin = std::find(under_way_.begin(), under_way_.end(), needed);
          begin != under_way_.end()) {
        std::vector<std::string> circle(begin, under_way_.end());
        circle.push_back(needed);
        throw InputError(fmt::format("needs itself: {}; allowed are formulas of other constants",
                                     joined(circle, " -> ")));
      }
      read(*entry);
    }
    return !constants().broken_in(text);
  }

  /// Reads a text as a formula if a constant occurs in it, else as a quantity if possible.
  void add(const std::string& name, const std::string& text) {
    if (constants().in(text)) return constants().add_formula(name, text);
    std::optional<Unit> unit;
    std::string not_quantity;
    try {
      unit = read_quantity(text).unit;
    } catch (const InputError& error) {
      not_quantity = error.what();
    }
    if (unit) {
      const Real number = units().quantity(text, unit->dimension);
      if (unit->dimension != dimension::none) return constants().add(name, number, unit->dimension);
      return unit->angle ? constants().add_angle(name, number) : constants().add(name, number);
    }
    try {
      constants().add_formula(name, text);
    } catch (const InputError& error) {
      throw InputError(
          fmt::format("neither a quantity ({}) nor a formula ({})", not_quantity, error.what()));
    }
  }

  Node& table_;
  std::set<std::string> begun_;
  std::vector<std::string> under_way_;  ///< constants being evaluated; each depends on the next
};

void Block::Node::read_constants() {
  std::vector<std::string> in_file;
  for (const scene_tree::Entry& entry : table->entries)
    if (entry.place.setting == place.setting) in_file.push_back(entry.key);
  ConstantsReader reader(*this);
  for (const scene_tree::Entry& entry : table->entries) {
    was_read.push_back(entry.key);
    if (entry.place.setting != place.setting)
      note(entry.place, scene_tree::joined(path, entry.key),
           "no such constant in the scene; " + allowed_names(entry.key, in_file));
    reader.read(entry);
  }
}

void Block::Node::read_functions() {
  Constants& constants = document->constants;
  for (const scene_tree::Entry& entry : table->entries) {
    was_read.push_back(entry.key);
    std::string name = entry.key.substr(0, entry.key.find('('));
    const auto sound = attempt(
        entry.value, scene_tree::joined(path, entry.key), [&](const scene_tree::Value& value) {
          Functions::Function function = Functions::signature(entry.key);
          name = function.name;
          require_free_name(name);
          if (constants.functions.find(name) != nullptr)
            throw InputError("is the name of another function, too; allowed is any other name");
          for (const std::string& argument : function.arguments)
            if (is_word_of_formulas(argument) && argument.find_first_not_of("xyzt") == 0)
              throw InputError(fmt::format(
                  "the argument '{}' has a meaning in formulas already; allowed is any other name",
                  argument));
          if (const auto* real = std::get_if<Real>(&value.data))
            function.formula = input_values::toml(*real);
          else if (const auto* integer = std::get_if<std::int64_t>(&value.data))
            function.formula = input_values::toml(*integer);
          else
            function.formula = input_values::exactly<std::string>(value, "a formula");
          constants.functions.add(std::move(function));
          return true;
        });
    if (!sound) constants.add_broken(name);
  }
}

void Block::Node::check_functions() {
  Constants& constants = document->constants;
  for (const scene_tree::Entry& entry : table->entries) {
    const std::size_t bracket = std::min(entry.key.find('('), entry.key.size());
    const std::string name = entry.key.substr(0, bracket);
    const Functions::Function* function = constants.functions.find(name);
    if (function == nullptr || constants.broken_in(name)) continue;
    const auto sound =
        attempt(entry.value, scene_tree::joined(path, entry.key), [&](const scene_tree::Value&) {
          const std::string formula = constants.functions.body(*function);
          if (constants.broken_in(formula)) return false;
          NamedNumbers numbers = constants.numbers();
          for (const std::string& argument : function->arguments) {
            std::erase_if(numbers,
                          [&](const auto& constant) { return constant.first == argument; });
            if (!is_word_of_formulas(argument)) numbers.emplace_back(argument, 1);
          }
          try {
            Expression{formula, numbers};
          } catch (const InputError& error) {
            throw InputError(error.what() + constants.hint(formula));
          }
          return true;
        });
    if (!sound.value_or(false)) constants.add_broken(name);
  }
}

}  // namespace meniscus
