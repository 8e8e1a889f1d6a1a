// SPDX-License-Identifier: BSD-3-Clause
// Prints a JSON Schema of scenes, made from the key reference.
#include "input/text.hpp"
#include "scene/key_reference.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <set>

namespace meniscus {
namespace {

std::string json_text(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c == '\n' ? std::string("\\n") : std::string(1, c);
  }
  return result + '"';
}

/// Members of an object, each "name": value.
class JsonObject {
 public:
  void add(const std::string& name, const std::string& value) {
    members_.push_back(json_text(name) + ":" + value);
  }
  bool empty() const { return members_.empty(); }
  std::string text(std::string_view separator = ",") const {
    return "{" + joined(members_, separator) + "}";
  }

 private:
  std::vector<std::string> members_;
};

std::string json_list(const std::vector<std::string>& values) {
  std::vector<std::string> texts;
  for (const std::string& value : values) texts.push_back(json_text(value));
  return "[" + joined(texts, ",") + "]";
}

std::vector<std::string> split(std::string_view text, std::string_view separator) {
  std::vector<std::string> parts;
  for (;;) {
    const std::size_t end = text.find(separator);
    parts.emplace_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + separator.size());
  }
}

std::optional<Real> number_in(std::string_view text) {
  Real value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// Adds bounds such as "> 0 and <= 1". Only bounds at 0 can be added for keys with a unit, since
/// others depend on the units of the scene.
void add_bounds(JsonObject& schema, const KeyText& key) {
  static constexpr std::pair<std::string_view, const char*> words[] = {{">= ", "minimum"},
                                                                       {"<= ", "maximum"},
                                                                       {"> ", "exclusiveMinimum"},
                                                                       {"< ", "exclusiveMaximum"}};
  for (const std::string& bound : split(key.range, " and "))
    for (const auto& [sign, word] : words) {
      if (!bound.starts_with(sign)) continue;
      const std::string number = bound.substr(sign.size());
      const auto value = number_in(number);
      if (value && (key.unit.empty() || *value == 0)) schema.add(word, number);
      break;
    }
}

/// Adds the type. Texts are allowed for numbers: quantities with units, formulas, constants.
void add_type(JsonObject& schema, const KeyText& key) {
  const auto [word, count] = [&] {
    const std::size_t space = key.type.find(' ');
    const auto number = number_in(std::string_view(key.type).substr(0, space));
    return number ? std::pair(key.type.substr(space + 1), static_cast<int>(*number))
                  : std::pair(key.type, 0);
  }();
  if (word == "true or false") {
    schema.add("type", "\"boolean\"");
  } else if (word == "text") {
    schema.add("type", "\"string\"");
    if (key.range.find(" | ") != std::string::npos)
      schema.add("enum", json_list(split(key.range, " | ")));
  } else if (word == "texts") {
    schema.add("type", "\"array\"");
    schema.add("items", "{\"type\":\"string\"}");
  } else if (word == "integer") {
    schema.add("type", "[\"integer\",\"string\"]");
    add_bounds(schema, key);
  } else if (word.starts_with("numbers")) {
    schema.add("type", "\"array\"");
    JsonObject items;
    items.add("type", "[\"number\",\"string\"]");
    add_bounds(items, key);
    schema.add("items", items.text());
    // The number of entries is 2 or 3, depending on the dimension; the reference shows one of them.
    if (count > 0) schema.add("minItems", std::to_string(count == 3 ? 2 : count));
    if (count > 0) schema.add("maxItems", std::to_string(count == 2 ? 3 : count));
  } else {
    schema.add("type", "[\"number\",\"string\"]");
    add_bounds(schema, key);
  }
}

/// All variants of a key in the tables of one path, because an editor does not know which table
/// applies.
struct KeyVariants {
  std::vector<KeyText> rows;
  std::vector<std::string> kinds;  ///< tables in which it is, e.g. ball; empty: in all

  std::string schema() const {
    std::set<std::string> distinct;
    for (const KeyText& row : rows) {
      JsonObject type;
      add_type(type, row);
      distinct.insert(type.text());
    }
    JsonObject schema;
    if (distinct.size() == 1)
      add_type(schema, rows.front());
    else
      schema.add("anyOf", "[" + joined({distinct.begin(), distinct.end()}, ",") + "]");
    schema.add("description", json_text(description()));
    return schema.text();
  }

 private:
  std::string description() const {
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const KeyText& row = rows[i];
      std::string line = kinds[i].empty() ? row.meaning : kinds[i] + ": " + row.meaning;
      if (!row.unit.empty() && row.unit != "any") line += " [" + row.unit + "]";
      if (!row.fallback.empty()) line += " (default: " + row.fallback + ")";
      if (row.fallback == "required")
        line.replace(line.rfind(" (default"), std::string::npos, " (required)");
      if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(line);
    }
    return joined(lines, "\n");
  }
};

/// All tables of one path.
struct PathSchema {
  bool is_array = false, is_table = false;  ///< both are true if either may be written
  std::string kind_key;
  std::vector<std::string> kinds;
  std::vector<std::string> keys, required;  ///< names in the order of the tables
  std::vector<std::string> required_in_array;
  std::map<std::string, KeyVariants> variants;

  void add(const KeyTable& table, const KeyHeading& heading) {
    (heading.is_array ? is_array : is_table) = true;
    if (!heading.kind.empty()) {
      kind_key = heading.kind_key;
      kinds.push_back(heading.kind);
    }
    for (const KeyText& key : table.keys) {
      if (variants.count(key.key) == 0) keys.push_back(key.key);
      KeyVariants& variant = variants[key.key];
      variant.rows.push_back(key);
      variant.kinds.push_back(heading.kind);
      if (heading.kind.empty() && key.fallback == "required")
        (heading.is_array ? required_in_array : required).push_back(key.key);
    }
  }
};

using Paths = std::map<std::string, PathSchema>;

std::string schema_of(const Paths& paths, const std::string& path);

/// Adds the tables below `path`, each under the next word of its path.
void add_tables(const Paths& paths, const std::string& path, JsonObject& properties,
                std::optional<std::string>& any) {
  const std::string prefix = path.empty() ? "" : path + ".";
  std::set<std::string> words;
  for (const auto& [other, schema] : paths)
    if (other != path && other.starts_with(prefix)) {
      const std::string rest = other.substr(prefix.size());
      words.insert(rest.substr(0, rest.find('.')));
    }
  for (const std::string& word : words) {
    const std::string below = schema_of(paths, prefix + word);
    if (word == "NAME")
      any = below;
    else
      properties.add(word, below);
  }
}

std::string schema_of(const Paths& paths, const std::string& path) {
  static const PathSchema none;
  const auto found = paths.find(path);
  const PathSchema& of = found == paths.end() ? none : found->second;
  JsonObject properties;
  std::optional<std::string> any;  // schema of tables with any name
  std::vector<std::string> required = of.required;
  if (!of.kind_key.empty() && of.kind_key != "interaction") required.push_back(of.kind_key);
  for (const std::string& key : of.keys)
    if (key == "NAME")
      any = of.variants.at(key).schema();
    else if (key != of.kind_key)
      properties.add(key, of.variants.at(key).schema());
  if (!of.kind_key.empty())
    properties.add(of.kind_key, "{\"type\":\"string\",\"enum\":" + json_list(of.kinds) + "}");
  add_tables(paths, path, properties, any);
  const auto object_with = [&](std::vector<std::string> names) {
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    JsonObject object;
    if (path.empty()) {
      object.add("$schema", "\"http://json-schema.org/draft-07/schema#\"");
      object.add("title", "\"scene of Meniscus\"");
    }
    object.add("type", "\"object\"");
    object.add("properties", properties.text(path.empty() ? ",\n" : ","));
    if (!names.empty()) object.add("required", json_list(names));
    object.add("additionalProperties", any.value_or("false"));
    return object.text();
  };
  const std::string table = object_with(required);
  if (!of.is_array) return table;
  required.insert(required.end(), of.required_in_array.begin(), of.required_in_array.end());
  const std::string array = "{\"type\":\"array\",\"items\":" + object_with(required) + "}";
  return of.is_table ? "{\"anyOf\":[" + table + "," + array + "]}" : array;
}

}  // namespace

void print_key_schema(std::ostream& out) {
  static const std::set<std::string> of_all_stages{"", "units", "body", "initial", "stage"};
  Paths paths;
  for (KeyTable table : key_tables()) {
    KeyHeading heading = heading_of(table);
    paths[heading.path].add(table, heading);
    if (of_all_stages.count(heading.path.substr(0, heading.path.find('.'))) > 0) continue;
    heading.path = "stage." + heading.path;
    if (!heading.is_array)  // a required key may be in the table of the scene
      for (KeyText& key : table.keys)
        if (key.fallback == "required") key.fallback = "that of the scene";
    paths[heading.path].add(table, heading);
  }
  out << schema_of(paths, "") << "\n";
}

}  // namespace meniscus
