// SPDX-License-Identifier: BSD-3-Clause
// Converts TOML to a tree of values. This is the only file that includes toml++.
#include "input/scene_tree.hpp"

#include "input/quantity.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>
#include <toml++/toml.h>

#include <algorithm>
#include <utility>

namespace meniscus::scene_tree {
namespace {

Place place_of(const toml::source_region& source) {
  return {0, std::max(1, static_cast<int>(source.begin.line)),
          std::max(1, static_cast<int>(source.begin.column))};
}

[[noreturn]] void refuse(const std::string& name, const Place& place, const std::string& what) {
  throw InputError(fmt::format("{}:{}:{}: {}", name, place.line, place.column, what));
}

/// Converts the nodes of the parser. Limits that no real scene reaches keep searches short.
class Converter {
 public:
  explicit Converter(const std::string& name) : name_(name) {}

  Table table(const toml::table& table, const Place& place) const {
    require_few(table.size(), 1000, "keys", place);
    Table result;
    for (const auto& [key, node] : table) {
      require_plain(key.str(), place_of(key.source()));
      result.entries.push_back({std::string(key.str()), place_of(key.source()), value(node)});
    }
    std::stable_sort(result.entries.begin(), result.entries.end(),
                     [](const Entry& a, const Entry& b) { return a.place < b.place; });
    return result;
  }

 private:
  Value value(const toml::node& node) const {
    const Place place = place_of(node.source());
    switch (node.type()) {
      case toml::node_type::boolean:
        return {node.as_boolean()->get(), place};
      case toml::node_type::integer:
        return {node.as_integer()->get(), place};
      case toml::node_type::floating_point:
        return {node.as_floating_point()->get(), place};
      case toml::node_type::string:
        require_plain(node.as_string()->get(), place);
        return {node.as_string()->get(), place};
      case toml::node_type::table:
        return {table(*node.as_table(), place), place};
      case toml::node_type::array: {
        require_few(node.as_array()->size(), 10000, "entries", place);
        Array array;
        for (const toml::node& element : *node.as_array()) array.push_back(value(element));
        return {std::move(array), place};
      }
      default:
        return {Date{}, place};
    }
  }

  void require_few(std::size_t count, std::size_t most, const char* of, const Place& place) const {
    if (count > most)
      refuse(name_, place, fmt::format("has {} {}; allowed are at most {}", count, of, most));
  }

  /// Refuses control characters: NUL would end messages that show the text, others control
  /// terminals.
  void require_plain(std::string_view text, const Place& place) const {
    for (const char c : text)
      if ((static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n' && c != '\r') ||
          c == 0x7f)
        refuse(name_, place,
               fmt::format("{} has the control character \\u{:04X}; allowed are line break and "
                           "tabulator",
                           quoted(text), static_cast<unsigned char>(c)));
  }

  const std::string& name_;
};

/// Reads a document character by character and skips comments and texts, which may hold anything.
class Skimmer {
 public:
  explicit Skimmer(std::string_view toml) : toml_(toml) {}

  bool at_end() const { return position_ >= toml_.size(); }
  /// The next character outside of comments and texts; a text counts as one quote.
  char next() {
    const char c = toml_[position_++];
    if (c == '#') skip_line();
    if (c == '"' || c == '\'') skip_text(c);
    if (c == '\n') ++line_;
    return c;
  }
  int line() const { return line_; }

 private:
  bool at(std::string_view mark) const { return toml_.substr(position_).starts_with(mark); }
  void skip_line() { position_ = std::min(toml_.find('\n', position_), toml_.size()); }

  /// Skips a text, starting behind its first quote. A text without closing quote ends with its
  /// line, as in the parser.
  void skip_text(char quote) {
    const std::string three(3, quote);
    const bool many_lines = at(three.substr(1));
    if (many_lines) position_ += 2;
    const std::string_view close = std::string_view(three).substr(0, many_lines ? 3 : 1);
    while (!at_end() && !at(close)) {
      if (toml_[position_] == '\n') {
        if (!many_lines) return;
        ++line_;
      }
      position_ += toml_[position_] == '\\' && quote == '"' ? 2 : 1;
    }
    position_ = std::min(position_ + close.size(), toml_.size());
    // Up to two more quotes before the closing ones belong to a multi-line text.
    for (int k = 0; many_lines && k < 2 && !at_end() && toml_[position_] == quote; ++k) ++position_;
  }

  std::string_view toml_;
  std::size_t position_ = 0;
  int line_ = 1;
};

/// Refuses keys with many dots. The parser limits nested values but not dotted keys, a.a.a... Each
/// dot is a level of recursion when the tables are read or destroyed; enough of them overflow the
/// stack.
void refuse_deep_keys(std::string_view toml, const std::string& name) {
  constexpr int max_dots = 10;
  constexpr std::string_view separators = ",=[]{}\n";
  int dots = 0;
  for (Skimmer skimmer(toml); !skimmer.at_end();) {
    const int line = skimmer.line();
    const char c = skimmer.next();
    if (separators.find(c) != std::string_view::npos) dots = 0;
    if (c == '.' && ++dots > max_dots)
      refuse(name, {0, line, 1}, fmt::format("a key has more than {} dots", max_dots));
  }
}

/// "; write \"10 ms\"" if the value that the parser could not read is a quantity without quotes.
std::string missing_quotes(std::string_view toml, const Place& place) {
  for (int line = 1; line < place.line && !toml.empty(); ++line)
    toml.remove_prefix(std::min(toml.find('\n'), toml.size() - 1) + 1);
  toml = toml.substr(0, toml.find_first_of("#\r\n"));
  const std::size_t equals = toml.find('=');
  if (equals == std::string_view::npos) return "";
  toml.remove_prefix(equals + 1);
  const std::size_t begin = toml.find_first_not_of(" \t"), end = toml.find_last_not_of(" \t");
  if (begin == std::string_view::npos) return "";
  const std::string_view text = toml.substr(begin, end + 1 - begin);
  try {
    const Unit unit = read_quantity(text).unit;
    if (unit.dimension == dimension::none && unit.factor == 1) return "";
  } catch (const InputError&) {
    return "";
  }
  return fmt::format("; a number with a unit is a text: write \"{}\"", text);
}

}  // namespace

Value parse(std::string_view toml, const std::string& name) {
  refuse_deep_keys(toml, name);
  try {
    const toml::table document = toml::parse(toml);
    return {Converter(name).table(document, Place{}), Place{}};
  } catch (const toml::parse_error& error) {
    const Place place = place_of(error.source());
    refuse(name, place, std::string(error.description()) + missing_quotes(toml, place));
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
