// SPDX-License-Identifier: BSD-3-Clause
// Prints the reference of all keys of a scene, as text and for documents.
#include "scene/key_reference.hpp"

#include "input/names.hpp"
#include "input/units.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>

namespace meniscus {
namespace {

std::string small_text(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

bool mentions(const std::string& text, const std::string& small_word) {
  return small_text(text).find(small_word) != std::string::npos;
}

/// The name without brackets, because users may type "[[contact]]" or "contact".
std::string without_brackets(const std::string& name) {
  const std::size_t begin = name.find_first_not_of("[ "), end = name.find_last_not_of("] ");
  return begin == std::string::npos || end < begin ? "" : name.substr(begin, end + 1 - begin);
}

bool is_called(const KeyTable& table, const std::string& name) {
  const KeyHeading heading = heading_of(table);
  return !name.empty() &&
         (heading.path == name || heading.kind == name || heading.path.ends_with("." + name) ||
          (heading.path.empty() && name == "top level"));
}

/// The tables with only those keys for which `holds` is true. Tables without such keys are left
/// out.
std::vector<KeyTable> reduced(const std::vector<KeyTable>& tables, const auto& holds) {
  std::vector<KeyTable> result;
  for (const KeyTable& table : tables) {
    KeyTable some{table.heading, {}};
    std::copy_if(table.keys.begin(), table.keys.end(), std::back_inserter(some.keys), holds);
    if (!some.keys.empty()) result.push_back(std::move(some));
  }
  return result;
}

std::vector<KeyTable> found(const std::string& given) {
  const std::vector<KeyTable> all = key_tables();
  const std::string wanted = without_brackets(given), small = small_text(wanted);
  if (given.empty()) return all;
  std::vector<KeyTable> tables;
  std::copy_if(all.begin(), all.end(), std::back_inserter(tables),
               [&](const KeyTable& table) { return is_called(table, wanted); });
  if (tables.empty()) tables = reduced(all, [&](const KeyText& key) { return key.key == wanted; });
  if (const std::string_view own = own_word(small); tables.empty() && !own.empty())
    return found(std::string(own));
  if (tables.empty() && !wanted.empty())
    tables = reduced(all, [&](const KeyText& k) {
      return mentions(k.key, small) || mentions(k.meaning, small) || mentions(k.range, small);
    });
  if (!tables.empty()) return tables;
  std::vector<std::string> known;
  for (const KeyTable& table : all) {
    known.push_back(heading_of(table).path);
    known.push_back(heading_of(table).kind);
    for (const KeyText& key : table.keys) known.push_back(key.key);
  }
  throw InputError(fmt::format("'{}' is no table and no key, and no meaning of a key mentions it{}",
                               given, did_you_mean(wanted, known)));
}

/// Introduction, printed before the complete reference only.
void print_introduction(std::ostream& out) {
  out << "A plain number is in the unit system of the scene; a text such as \"72.8 mN/m\" has its "
         "own\n"
         "unit. The units and defaults below are those of SI. A formula is a text in x, y, z, "
         "t.\n"
         "Units of texts: "
      << unit_list()
      << ";\n"
         "with spaces, *, /, brackets and powers: \"kg/(m s^2)\", \"g/cm3\". 1 kT is k T at 25 "
         "degrees Celsius, 4.1164e-21 J.\n\n";
}

/// Text of a cell of a Markdown table. A bar must be escaped, or it would begin the next cell.
std::string cell(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '|' ? std::string("\\|") : std::string(1, c);
  return result;
}

}  // namespace

KeyHeading heading_of(const KeyTable& table) {
  const std::string& text = table.heading;
  KeyHeading heading;
  if (text.front() != '[') return heading;
  heading.is_array = text[1] == '[';
  heading.path = without_brackets(text.substr(0, text.find(']')));
  const std::size_t equals = text.find(" = \""), colon = text.find(": ");
  if (equals == std::string::npos || equals > colon) return heading;
  const std::size_t key = text.rfind(' ', equals - 1) + 1, kind = equals + 4;
  heading.kind_key = text.substr(key, equals - key);
  heading.kind = text.substr(kind, text.find('"', kind) - kind);
  return heading;
}

void print_keys(std::ostream& out, const std::string& wanted) {
  const std::vector<KeyTable> tables = found(wanted);
  if (wanted.empty()) print_introduction(out);
  for (const KeyTable& table : tables) print(out, table);
}

void print_keys_as_markdown(std::ostream& out, const std::string& wanted) {
  const std::vector<KeyTable> tables = found(wanted);
  if (wanted.empty()) {
    out << "# Keys of a scene\n\n";
    print_introduction(out);
  }
  for (const KeyTable& table : tables) {
    out << "## `" << table.heading << "`\n\n"
        << "| key | type | unit | range | default | meaning |\n|---|---|---|---|---|---|\n";
    for (const KeyText& key : table.keys)
      out << fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", key.key, key.type, key.unit,
                         cell(key.range), cell(key.fallback), cell(key.meaning));
    if (!table.example.empty()) out << "\n```toml\n" << table.example << "```\n";
    out << "\n";
  }
}

}  // namespace meniscus
