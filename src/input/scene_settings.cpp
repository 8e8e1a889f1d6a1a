// SPDX-License-Identifier: BSD-3-Clause
// `--set key.path=value`: finds the place in the tree and sets the value.
#include "input/names.hpp"
#include "input/scene_tree.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <charconv>
#include <optional>
#include <utility>

namespace meniscus::scene_tree {
namespace {

/// One step of a path: into a table by key or into an array by number.
struct Step {
  std::string key;
  std::optional<std::size_t> number;
};

/// Reads "body[0].material.'odd key'" up to the '='.
class PathReader {
 public:
  explicit PathReader(std::string_view text) : text_(text) {}

  std::vector<Step> path() {
    std::vector<Step> steps;
    do {
      steps.push_back({key(), {}});
      while (take('[')) steps.push_back({"", number()});
    } while (take('.'));
    if (!take('=')) fail();
    return steps;
  }
  std::string_view value() const {
    const std::size_t begin = text_.find_first_not_of(" \t", position_);
    return begin == std::string_view::npos ? std::string_view() : text_.substr(begin);
  }

 private:
  [[noreturn]] static void fail() {
    throw InputError("not of the form key.path=value, e.g. body[0].material.viscosity=1e-3");
  }
  char peek() const { return position_ < text_.size() ? text_[position_] : '\0'; }
  void skip_spaces() {
    while (peek() == ' ') ++position_;
  }
  bool take(char c) {
    skip_spaces();
    if (peek() != c) return false;
    ++position_;
    return true;
  }
  std::string key() {
    skip_spaces();
    std::size_t begin = position_;
    if (peek() == '"' || peek() == '\'') {
      const std::size_t end = text_.find(peek(), ++begin);
      if (end == std::string_view::npos) fail();
      position_ = end + 1;
      return std::string(text_.substr(begin, end - begin));
    }
    while (is_bare(peek())) ++position_;
    if (position_ == begin) fail();
    return std::string(text_.substr(begin, position_ - begin));
  }
  std::size_t number() {
    skip_spaces();
    const char* begin = text_.data() + position_;
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value);
    if (error != std::errc{}) fail();
    position_ += static_cast<std::size_t>(end - begin);
    if (!take(']')) fail();
    return value;
  }

  std::string_view text_;
  std::size_t position_ = 0;
};

[[noreturn]] void fail_unknown(const std::string& where, const std::string& key,
                               const std::vector<std::string>& known) {
  throw InputError(fmt::format("{}'{}' is not in the scene; {}",
                               where.empty() ? "" : "in " + where + ": ", key,
                               allowed_names(key, known)));
}

/// The element of an array, or the table of an array whose key `name` is `step.key`.
Value& element(Array& array, const Step& step, const std::string& where) {
  if (step.number) {
    if (*step.number < array.size()) return array[*step.number];
    throw InputError(fmt::format("{}[{}] does not exist; it has {} entries, counted from 0", where,
                                 *step.number, array.size()));
  }
  std::vector<std::string> names;
  for (Value& candidate : array) {
    const Table* table = std::get_if<Table>(&candidate.data);
    const Entry* name = table == nullptr ? nullptr : table->find("name");
    const std::string* text =
        name == nullptr ? nullptr : std::get_if<std::string>(&name->value.data);
    if (text == nullptr) continue;
    if (*text == step.key) return candidate;
    names.push_back(*text);
  }
  for (std::size_t i = 0; i < array.size(); ++i) names.push_back(fmt::format("[{}]", i));
  fail_unknown(where, step.key, names);
}

/// One step down. A missing key is created (at `place`) if it is the `last` one.
Value& child(Value& parent, const Step& step, const std::string& where, bool last,
             const Place& place) {
  if (Array* array = std::get_if<Array>(&parent.data)) return element(*array, step, where);
  Table* table = std::get_if<Table>(&parent.data);
  if (table == nullptr || step.number)
    throw InputError(fmt::format(
        "{} is {}; {} cannot be set in it", where.empty() ? "the scene" : where, kind(parent),
        step.number ? fmt::format("[{}]", *step.number) : fmt::format("'{}'", step.key)));
  if (Entry* entry = table->find(step.key)) return entry->value;
  if (where.empty() && !last && step.key == "resolution") {  // a scene need not have this table
    table->entries.push_back({step.key, place, {Table{}, place}});
    return table->entries.back().value;
  }
  if (!last) fail_unknown(where, step.key, table->keys());
  table->entries.push_back({step.key, place, {}});
  return table->entries.back().value;
}

void move_to(Value& value, const Place& place) {
  value.place = place;
  if (Array* array = std::get_if<Array>(&value.data))
    for (Value& inner : *array) move_to(inner, place);
  if (Table* table = std::get_if<Table>(&value.data))
    for (Entry& entry : table->entries) {
      entry.place = place;
      move_to(entry.value, place);
    }
}

Value parsed_value(std::string_view text) {
  constexpr std::string_view name = "value";
  const auto parsed = [&](std::string_view toml) {
    Value document = parse(fmt::format("{} = {}", name, toml), "--set");
    Table& table = std::get<Table>(document.data);
    if (table.entries.size() != 1) throw InputError("more than one value");
    return std::move(table.entries.front().value);
  };
  if (text.empty()) throw InputError("a value is missing behind '='");
  try {
    return parsed(text);
  } catch (const InputError&) {
    constexpr std::string_view openers = "\"'[{";
    if (openers.find(text.front()) != std::string_view::npos)
      throw InputError(fmt::format("the value {} is not valid TOML", text));
  }
  try {
    return parsed(quoted(text));  // a bare word is a text
  } catch (const InputError&) {
    throw InputError("the value is not valid UTF-8");
  }
}

}  // namespace

void apply_setting(Value& root, const std::string& setting, int n) {
  const Place place{n, 0, 0};
  PathReader reader(setting);
  const std::vector<Step> path = reader.path();
  Value value = parsed_value(reader.value());
  Value* target = &root;
  std::string where;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Step& step = path[i];
    target = &child(*target, step, where, i + 1 == path.size(), place);
    where = step.number ? fmt::format("{}[{}]", where, *step.number) : joined(where, step.key);
  }
  *target = std::move(value);
  move_to(*target, place);
}

}  // namespace meniscus::scene_tree
