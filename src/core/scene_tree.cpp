// SPDX-License-Identifier: BSD-3-Clause
// From TOML to a tree of values. The only file that sees toml++.
#include "scene_tree.hpp"

#include "meniscus/core/error.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <utility>

namespace meniscus::scene_tree {
namespace {

Place place_of(const toml::source_region& source) {
  return {0, std::max(1, static_cast<int>(source.begin.line)),
          std::max(1, static_cast<int>(source.begin.column))};
}

Value converted(const toml::node& node);

Table converted(const toml::table& table) {
  Table result;
  for (const auto& [key, node] : table)
    result.entries.push_back({std::string(key.str()), place_of(key.source()), converted(node)});
  std::stable_sort(result.entries.begin(), result.entries.end(),
                   [](const Entry& a, const Entry& b) { return a.place < b.place; });
  return result;
}

Value converted(const toml::node& node) {
  const Place place = place_of(node.source());
  switch (node.type()) {
    case toml::node_type::boolean:
      return {node.as_boolean()->get(), place};
    case toml::node_type::integer:
      return {node.as_integer()->get(), place};
    case toml::node_type::floating_point:
      return {node.as_floating_point()->get(), place};
    case toml::node_type::string:
      return {node.as_string()->get(), place};
    case toml::node_type::table:
      return {converted(*node.as_table()), place};
    case toml::node_type::array: {
      Array array;
      for (const toml::node& element : *node.as_array()) array.push_back(converted(element));
      return {std::move(array), place};
    }
    default:
      return {Date{}, place};
  }
}

/// The parser limits nested values but not dotted keys, a.a.a...; each dot is a level of recursion
/// for it, and enough of them overflow the stack. Of a row of dots in a comment only the first
/// counts.
void refuse_deep_keys(std::string_view toml, const std::string& name) {
  constexpr int max_dots = 100;
  constexpr std::string_view separators = ",=[]{}\n";
  int dots = 0, line = 1;
  for (std::size_t i = 0; i < toml.size(); ++i) {
    if (toml[i] == '\n') ++line;
    if (separators.find(toml[i]) != std::string_view::npos) dots = 0;
    if (toml[i] == '.' && i > 0 && toml[i - 1] != '.' && ++dots > max_dots)
      throw InputError(fmt::format("{}:{}:1: a key has more than {} dots", name, line, max_dots));
  }
}

}  // namespace

Value parse(std::string_view toml, const std::string& name) {
  refuse_deep_keys(toml, name);
  try {
    return {converted(static_cast<const toml::table&>(toml::parse(toml))), Place{}};
  } catch (const toml::parse_error& error) {
    const Place place = place_of(error.source());
    throw InputError(
        fmt::format("{}:{}:{}: {}", name, place.line, place.column, error.description()));
  }
}

const Entry* Table::find(std::string_view key) const {
  for (const Entry& entry : entries)
    if (entry.key == key) return &entry;
  return nullptr;
}

Entry* Table::find(std::string_view key) {
  return const_cast<Entry*>(std::as_const(*this).find(key));
}

std::vector<std::string> Table::keys() const {
  std::vector<std::string> result;
  for (const Entry& entry : entries) result.push_back(entry.key);
  return result;
}

std::string_view kind(const Value& value) {
  static constexpr std::string_view names[] = {"a boolean", "an integer",     "a decimal number",
                                               "a text",    "a date or time", "an array",
                                               "a table"};
  return at(names, value.data.index());
}

std::string quoted(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      (result += '\\') += c;
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      result += fmt::format("\\u{:04X}", static_cast<unsigned char>(c));
    else
      result += c;
  }
  return result + '"';
}

bool is_bare(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-';
}

std::string key_text(std::string_view key) {
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), is_bare);
  return bare ? std::string(key) : quoted(key);
}

std::string joined(const std::string& path, std::string_view key) {
  return path.empty() ? key_text(key) : path + "." + key_text(key);
}

}  // namespace meniscus::scene_tree
