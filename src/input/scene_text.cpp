// SPDX-License-Identifier: BSD-3-Clause
// Writes a tree of values as TOML.
#include "input/scene_tree.hpp"

#include <fmt/core.h>

namespace meniscus::scene_tree {
namespace {

bool is_array_of_tables(const Value& value) {
  const auto* array = std::get_if<Array>(&value.data);
  return array && !array->empty() && std::holds_alternative<Table>(array->front().data);
}

/// A table whose entries are tables of plain values, such as [expect], has one line for each.
bool has_lines(const Table& table) {
  if (table.entries.empty()) return false;
  for (const Entry& entry : table.entries) {
    const auto* line = std::get_if<Table>(&entry.value.data);
    if (!line) return false;
    for (const Entry& inner : line->entries)
      if (std::holds_alternative<Table>(inner.value.data)) return false;
  }
  return true;
}

void write(const Table& table, const std::string& path, std::string& text) {
  const bool lines = has_lines(table) && !path.empty();
  for (const Entry& entry : table.entries)
    if (lines ||
        (!std::holds_alternative<Table>(entry.value.data) && !is_array_of_tables(entry.value)))
      text += fmt::format("{} = {}\n", key_text(entry.key), toml_text(entry.value));
  if (lines) return;
  for (const Entry& entry : table.entries) {
    const std::string inner = joined(path, entry.key), space = path.empty() ? "\n" : "";
    if (const auto* one = std::get_if<Table>(&entry.value.data)) {
      text += fmt::format("{}[{}]\n", space, inner);
      write(*one, inner, text);
    } else if (is_array_of_tables(entry.value)) {
      for (const Value& element : std::get<Array>(entry.value.data)) {
        text += fmt::format("{}[[{}]]\n", space, inner);
        write(std::get<Table>(element.data), inner, text);
      }
    }
  }
}

struct Writer {
  std::string operator()(bool b) const { return b ? "true" : "false"; }
  std::string operator()(std::int64_t i) const { return std::to_string(i); }
  std::string operator()(Real x) const { return fmt::format("{}", x); }
  std::string operator()(const std::string& s) const { return scene_tree::quoted(s); }
  std::string operator()(const Date&) const { return scene_tree::quoted("a date"); }
  std::string operator()(const Array& array) const {
    std::string text;
    for (const Value& element : array) text += (text.empty() ? "" : ", ") + toml_text(element);
    return "[" + text + "]";
  }
  std::string operator()(const Table& table) const {
    std::string text;
    for (const Entry& entry : table.entries)
      text += fmt::format("{}{} = {}", text.empty() ? " " : ", ", key_text(entry.key),
                          toml_text(entry.value));
    return "{" + text + " }";
  }
};

}  // namespace

std::string toml_text(const Value& value) {
  return std::visit(Writer{}, value.data);
}

std::string toml_text(const Table& document) {
  std::string text;
  write(document, "", text);
  return text;
}

}  // namespace meniscus::scene_tree
