// SPDX-License-Identifier: BSD-3-Clause
// A scene as a tree of values with their positions in the file, in file order, made by the TOML
// parser.
#pragma once
#include "numbers/types.hpp"

#include <compare>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace meniscus::scene_tree {

/// Position of a value: in the file (setting 0), or in the n-th `--set` (line and column 0).
struct Place {
  int setting = 0, line = 1, column = 1;
  friend auto operator<=>(const Place&, const Place&) = default;
};

struct Value;
struct Entry;

using Array = std::vector<Value>;
struct Table {
  std::vector<Entry> entries;
  const Entry* find(std::string_view key) const;
  Entry* find(std::string_view key);
  std::vector<std::string> keys() const;
};
struct Date {};  ///< a date or time, which no key accepts

struct Value {
  std::variant<bool, std::int64_t, Real, std::string, Date, Array, Table> data;
  Place place;
};
struct Entry {
  std::string key;
  Place place;  ///< position of the key
  Value value;
};

/// The type of a value for messages: "an integer", "a text", ...
std::string_view kind(const Value& value);

/// Parses a document. Throws InputError "name:line:column: message of the parser".
Value parse(std::string_view toml, const std::string& name);

/// Applies "key.path=value" as the n-th setting (n from 1). A path leads through tables, `name[i]`
/// entries of arrays, and entries of arrays of tables chosen by their key `name`; all but its last
/// key must exist. Throws InputError (without a place).
void apply_setting(Value& root, const std::string& setting, int n);

/// A value, or a whole document, as TOML: in a table values come before tables.
std::string toml_text(const Value& value);
std::string toml_text(const Table& document);

/// A basic string of TOML, quoted and escaped.
std::string quoted(std::string_view text);
/// A key as written in TOML: bare if possible, else quoted.
std::string key_text(std::string_view key);
/// "path.key"; `key` alone at the root.
std::string joined(const std::string& path, std::string_view key);
bool is_bare(char c);

}  // namespace meniscus::scene_tree
