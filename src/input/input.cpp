// SPDX-License-Identifier: BSD-3-Clause
// Reading the keys of one table.
#include "input/input.hpp"

#include "input/input_node.hpp"
#include "input/input_values.hpp"
#include "input/names.hpp"
#include "input/text.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>

namespace meniscus {

using scene_tree::Array;
using scene_tree::Entry;
using scene_tree::joined;
using scene_tree::Table;
using scene_tree::Value;

// ---- node
// ----------------------------------------------------------------------------------------

namespace {

bool contains(const std::vector<std::string>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

const Entry* Block::Node::find(std::string_view key) const {
  if (const Entry* entry = table == nullptr ? nullptr : table->find(key)) return entry;
  for (const Supplied& one : supplied)
    if (one.entry.key == key) return &one.entry;
  return nullptr;
}

std::string Block::Node::called(std::string_view key) const {
  for (const Supplied& one : supplied)
    if (one.entry.key == key && find(key) == &one.entry)
      return fmt::format("{}: {}, which follows from it", joined(path, one.source), key);
  return joined(path, key);
}

const Entry* Block::Node::ask(std::string_view key) {
  if (!contains(known, key)) known.emplace_back(key);
  return find(key);
}

const Entry* Block::Node::take(std::string_view key) {
  const Entry* entry = ask(key);
  if (entry != nullptr && !contains(was_read, key)) was_read.emplace_back(key);
  return entry;
}

void Block::Node::note(const scene_tree::Place& where, const std::string& full_path,
                       const std::string& what) {
  wrong = true;
  document->problems.push_back({where, full_path.empty() ? what : full_path + ": " + what});
}

void Block::Node::mark_guess(const Value& value) {
  if (const auto* array = std::get_if<Array>(&value.data))
    for (const Value& element : *array) mark_guess(element);
  const auto* text = std::get_if<std::string>(&value.data);
  if (text == nullptr || !document->constants.broken_in(*text)) return;
  wrong = guessed = true;
}

void Block::Node::note_missing(std::string_view key, const std::string& allowed) {
  if (!quiet) note(place, joined(path, key), "missing; allowed is " + allowed);
}

void Block::Node::forget_missing(std::string_view given) {
  const std::string meant = did_you_mean(given, known);
  if (meant.empty()) return;
  for (const std::string& key : known) {
    const std::string begin = joined(path, key) + ": missing";
    if (did_you_mean(given, {key}) == meant)
      std::erase_if(document->problems,
                    [&](const Problem& problem) { return problem.text.starts_with(begin); });
  }
}

void Block::Node::echo(std::string_view key, std::string value, const std::string& unit,
                       bool fallback) {
  const auto same = std::find_if(echoes.begin(), echoes.end(),
                                 [&](const Echo& earlier) { return earlier.key == key; });
  const bool is_supplied = std::any_of(supplied.begin(), supplied.end(),
                                       [&](const Supplied& one) { return one.entry.key == key; });
  if (same != echoes.end() || is_supplied) return;
  const char* separator = !unit.empty() && fallback ? ", " : "";
  echoes.push_back(
      {std::string(key), std::move(value), unit + separator + (fallback ? "default" : "")});
}

std::shared_ptr<Block::Node> Block::Node::child(std::string_view key, bool in_array,
                                                const std::string& full_path, const Table* of,
                                                const scene_tree::Place& where) {
  for (const Child& earlier : children)
    if (earlier.node->path == full_path) return earlier.node;
  auto node = std::make_shared<Node>();
  node->document = document;
  node->table = of;
  node->path = full_path;
  node->place = where;
  children.push_back({std::string(key), in_array, node});
  return node;
}

input_values::Number Block::Node::number(Dimension dimension, const Range& range) const {
  return {document->units, document->units.settled(dimension), range, document->constants,
          document->in_plane};
}

template <class T, class Convert>
T Block::Node::read(std::string_view key, const std::string& allowed, const std::string& unit,
                    const std::optional<T>& fallback, const T& harmless, Convert convert) {
  const Entry* entry = take(key);
  if (entry == nullptr) {
    if (!fallback) {
      note_missing(key, allowed);
      return harmless;
    }
    echo(key, input_values::toml(*fallback), unit, true);
    return *fallback;
  }
  const std::optional<T> value = attempt(entry->value, called(key), convert);
  if constexpr (!std::is_same_v<T, std::string> && !std::is_same_v<T, std::vector<std::string>>)
    mark_guess(entry->value);
  if (!value) return fallback.value_or(harmless);
  echo(key, input_values::toml(*value), unit, false);
  return *value;
}

template <class T, class Convert>
std::vector<T> Block::Node::read_list(std::string_view key, std::size_t count,
                                      const std::string& allowed, const std::string& unit,
                                      const std::optional<std::vector<T>>& fallback,
                                      const T& harmless, Convert convert) {
  const std::string number = count == 0 ? "any number" : std::to_string(count);
  const std::string allowed_list = "an array of " + number + " of: " + allowed;
  const std::string full_path = joined(path, key);
  return read<std::vector<T>>(
      key, allowed_list, unit, fallback, std::vector<T>(count, harmless), [&](const Value& value) {
        const auto* array = std::get_if<Array>(&value.data);
        if (array == nullptr) input_values::refuse_kind(value, allowed_list);
        if (count != 0 && array->size() != count)
          throw InputError(fmt::format("has {} {}; allowed is {}", array->size(),
                                       array->size() == 1 ? "entry" : "entries", allowed_list));
        std::vector<T> elements;
        for (std::size_t i = 0; i < array->size(); ++i)
          elements.push_back(attempt((*array)[i], fmt::format("{}[{}]", full_path, i), convert)
                                 .value_or(harmless));
        return elements;
      });
}

// ---- keys
// ----------------------------------------------------------------------------------------

bool Block::has(std::string_view key) const {
  return node_->ask(key) != nullptr;
}
const std::string& Block::path() const {
  return node_->path;
}
Real Block::refinement() const {
  return node_->document->refine;
}

const UnitSystem& Block::units() const {
  return node_->document->units;
}

std::string Block::place(std::string_view key) const {
  const Entry* entry = node_->find(key);
  const std::string where =
      node_->document->place_text(entry == nullptr ? node_->place : entry->value.place);
  const std::string full_path = key.empty() ? path() : node_->called(key);
  return full_path.empty() ? where : where + ": " + full_path;
}

Real Block::real(std::string_view key, Dimension dimension, Range range,
                 std::optional<Real> fallback) const {
  const input_values::Number number = node_->number(dimension, range);
  return node_->read<Real>(key, number.allowed(), number.unit(), fallback,
                           input_values::harmless(range),
                           [&](const Value& value) { return number.real(value); });
}

std::optional<Dimension> Block::own_dimension(std::string_view key) const {
  const Entry* entry = node_->ask(key);
  return entry == nullptr ? std::nullopt
                          : input_values::own_dimension(entry->value, node_->document->constants);
}

std::int64_t Block::integer(std::string_view key, Range range,
                            std::optional<std::int64_t> fallback) const {
  return node_->read<std::int64_t>(
      key, input_values::allowed_integer(range), "", fallback,
      static_cast<std::int64_t>(input_values::harmless(range)), [&](const Value& value) {
        return input_values::integer(value, range, node_->document->constants);
      });
}

bool Block::flag(std::string_view key, std::optional<bool> fallback) const {
  const std::string allowed = "true or false";
  return node_->read<bool>(key, allowed, "", fallback, false, [&](const Value& value) {
    return input_values::exactly<bool>(value, allowed);
  });
}

std::string Block::text(std::string_view key, std::optional<std::string> fallback) const {
  const std::string allowed = "a text";
  return node_->read<std::string>(key, allowed, "", fallback, "", [&](const Value& value) {
    return input_values::exactly<std::string>(value, allowed);
  });
}

std::string Block::choice(std::string_view key, const std::vector<std::string>& allowed,
                          std::optional<std::string> fallback) const {
  const std::string list = "one of " + joined(allowed, ", ");
  return node_->read<std::string>(
      key, list, "", fallback, allowed.front(), [&](const Value& value) {
        const auto name = input_values::exactly<std::string>(value, list);
        if (std::find(allowed.begin(), allowed.end(), name) == allowed.end())
          throw InputError(fmt::format("'{}' is unknown; {}", name, allowed_names(name, allowed)));
        return name;
      });
}

std::optional<std::string> Block::kind(std::string_view key,
                                       const std::vector<std::string>& allowed) const {
  const bool before = std::exchange(node_->wrong, false);
  std::string name = choice(key, allowed, std::nullopt);
  const bool found = !std::exchange(node_->wrong, before || node_->wrong);
  if (found) return name;
  node_->quiet = true;
  return std::nullopt;
}

std::vector<std::string> Block::texts(std::string_view key,
                                      std::optional<std::vector<std::string>> fallback) const {
  const std::string allowed = "a text";
  return node_->read_list<std::string>(key, 0, allowed, "", fallback, "", [&](const Value& value) {
    return input_values::exactly<std::string>(value, allowed);
  });
}

std::vector<Real> Block::reals(std::string_view key, std::size_t count, Dimension dimension,
                               Range range, std::optional<std::vector<Real>> fallback) const {
  const input_values::Number number = node_->number(dimension, range);
  return node_->read_list<Real>(key, count, number.allowed(), number.unit(), fallback,
                                input_values::harmless(range),
                                [&](const Value& value) { return number.real(value); });
}

Expression Block::expression(std::string_view key, Dimension dimension,
                             std::optional<Expression> fallback, Range range,
                             Variables variables) const {
  const input_values::Number number = node_->number(dimension, range);
  Expression read = node_->read<Expression>(
      key, number.allowed_or_formula(variables), number.unit(), fallback,
      input_values::harmless(range),
      [&](const Value& value) { return number.expression(value, variables); });
  read.set_place(place(key));
  read.set_end(node_->document->end);
  return read;
}

std::vector<Expression> Block::expressions(std::string_view key, std::size_t count,
                                           Dimension dimension,
                                           std::optional<std::vector<Expression>> fallback,
                                           Variables variables) const {
  const input_values::Number number = node_->number(dimension, range::any);
  std::vector<Expression> read = node_->read_list<Expression>(
      key, count, number.allowed_or_formula(variables), number.unit(), fallback, Expression(0),
      [&](const Value& value) { return number.expression(value, variables); });
  for (std::size_t i = 0; i < read.size(); ++i) {
    read[i].set_place(fmt::format("{}[{}]", place(key), i));
    read[i].set_end(node_->document->end);
  }
  return read;
}

void Block::supply(std::string_view key, const std::string& formula,
                   std::string_view source) const {
  const Entry* entry = node_->find(source);
  const scene_tree::Place place = entry == nullptr ? node_->place : entry->value.place;
  // A formula of numbers alone is a number, also for keys that take no formula.
  Value value{formula, place};
  if (names_in(formula).empty()) value.data = Expression(formula)({0, 0, 0});
  node_->supplied.push_back({{std::string(key), place, std::move(value)}, std::string(source)});
}

// ---- tables
// --------------------------------------------------------------------------------------

std::optional<Block> Block::table(std::string_view key, bool required) const {
  const Entry* entry = node_->take(key);
  if (entry == nullptr) {
    if (required) node_->note_missing(key, "a table");
    return std::nullopt;
  }
  const auto* found = std::get_if<Table>(&entry->value.data);
  const std::string full_path = joined(path(), key);
  if (found == nullptr) {
    node_->note(entry->value.place, full_path,
                fmt::format("is {}; allowed is a table", scene_tree::kind(entry->value)));
    return std::nullopt;
  }
  return Block(node_->child(key, false, full_path, found, entry->value.place));
}

Block Block::table_or_defaults(std::string_view key) const {
  if (const auto present = table(key)) return *present;
  const auto node = node_->child(key, false, joined(path(), key), nullptr, node_->place);
  node->quiet = node_->quiet || has(key);
  return Block(node);
}

bool Block::is_text(std::string_view key) const {
  const Entry* entry = node_->ask(key);
  const auto* text = entry != nullptr ? std::get_if<std::string>(&entry->value.data) : nullptr;
  return text != nullptr && !node_->document->constants.in(*text);
}

bool Block::is_array(std::string_view key) const {
  const Entry* entry = node_->ask(key);
  return entry != nullptr && std::holds_alternative<Array>(entry->value.data);
}

std::vector<Block> Block::tables(std::string_view key) const {
  const Entry* entry = node_->take(key);
  if (entry == nullptr) return {};
  const std::string full_path = joined(path(), key);
  const auto refuse = [&](const Value& value, const std::string& where) {
    node_->note(value.place, where,
                fmt::format("is {}; allowed is an array of tables, [[{}]]", scene_tree::kind(value),
                            scene_tree::key_text(key)));
  };
  const auto* array = std::get_if<Array>(&entry->value.data);
  if (array == nullptr) {
    refuse(entry->value, full_path);
    return {};
  }
  std::vector<Block> blocks;
  for (std::size_t i = 0; i < array->size(); ++i) {
    const Value& value = (*array)[i];
    const std::string element_path = fmt::format("{}[{}]", full_path, i);
    if (const auto* found = std::get_if<Table>(&value.data))
      blocks.push_back(Block(node_->child(key, true, element_path, found, value.place)));
    else
      refuse(value, element_path);
  }
  return blocks;
}

std::vector<std::pair<std::string, Block>> Block::named_tables() const {
  std::vector<std::pair<std::string, Block>> result;
  if (node_->table == nullptr) return result;
  for (const Entry& entry : node_->table->entries)
    if (auto found = table(entry.key)) result.emplace_back(entry.key, std::move(*found));
  return result;
}

void Block::problem(std::string_view key, const std::string& what) const {
  if (node_->guessed) return;  // the problem may be due to the replaced value
  const Entry* entry = node_->find(key);
  node_->note(entry == nullptr ? node_->place : entry->value.place,
              key.empty() ? path() : joined(path(), key), what);
}

void Block::done() const {
  if (node_->table == nullptr || node_->quiet) return;
  for (const Entry& entry : node_->table->entries) {
    if (contains(node_->was_read, entry.key)) continue;
    node_->note(entry.place, joined(path(), entry.key),
                "unknown key; " + allowed_names(entry.key, node_->known));
    node_->forget_missing(entry.key);
  }
}

bool Block::in_order() const {
  return !node_->wrong;
}

}  // namespace meniscus
