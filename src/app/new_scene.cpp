// SPDX-License-Identifier: BSD-3-Clause
// `meniscus new`: copies a scene of the gallery and explains its tables and keys by comments.
#include "app/documents.hpp"
#include "scene/key_reference.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <set>
#include <sstream>
#include <utility>

namespace meniscus {
namespace {

using Lines = std::vector<std::string>;

/// A table of the scene file: its path and its lines, including the heading.
struct Part {
  std::string path;
  Lines lines;
};

/// The path `a.b` of a heading `[a.b]` or `[[a.b]]`. Empty for any other line.
std::string path_of_heading(const std::string& line) {
  if (!line.starts_with('[')) return "";
  const std::size_t begin = line.find_first_not_of('['), end = line.find(']');
  return end == std::string::npos ? "" : line.substr(begin, end - begin);
}

/// The key of a line `key = value`. Empty for any other line.
std::string key_of_line(const std::string& line) {
  const std::size_t equals = line.find('='), end = line.find_first_of(" =");
  const bool assigns = equals != std::string::npos && line.find_first_not_of(' ', end) == equals;
  return assigns ? line.substr(0, end) : "";
}

std::vector<Part> parts_of(std::string_view text) {
  std::vector<Part> parts(1);
  std::istringstream lines{std::string(text)};
  std::string line;
  while (std::getline(lines, line)) {
    if (const std::string path = path_of_heading(line); !path.empty()) parts.push_back({path, {}});
    parts.back().lines.push_back(line);
  }
  return parts;
}

std::string text_of_key(const Part& part, const std::string& key) {
  for (const std::string& line : part.lines) {
    if (key_of_line(line) != key) continue;
    const std::size_t begin = line.find('"') + 1;
    return line.substr(begin, line.find('"', begin) - begin);
  }
  return "";
}

/// Explanations of one table of the scene file, from the entries of the key reference for its path.
/// Entries for all kinds and for the kind of this table come first, then entries for other kinds.
class Explanations {
 public:
  Explanations(const std::vector<KeyTable>& reference, const Part& part) {
    for (const KeyTable& table : reference) {
      const KeyHeading heading = heading_of(table);
      if (heading.path != part.path) continue;
      const bool meant =
          heading.kind.empty() || text_of_key(part, heading.kind_key) == heading.kind;
      (meant ? tables_ : others_).push_back(&table);
    }
  }

  /// One sentence about the table.
  std::string of_table() const {
    for (const KeyTable* table : tables_) {
      const std::size_t colon = table->heading.rfind(": ");
      if (colon != std::string::npos) return table->heading.substr(colon + 2);
    }
    return "";
  }

  std::string of_key(const std::string& name) const {
    for (const auto& tables : {tables_, others_})  // a default may determine the kind
      for (const KeyTable* table : tables)
        for (const KeyText& key : table->keys)
          if (key.key == name) return key.meaning;
    return "";
  }

 private:
  std::vector<const KeyTable*> tables_, others_;
};

constexpr std::size_t widest = 100;

std::string comment_lines(const std::string& text) {
  std::istringstream words(text);
  std::string lines, line = "#", word;
  while (words >> word) {
    if (line.size() + 1 + word.size() > widest) {
      lines += line + "\n";
      line = "#";
    }
    line += " " + word;
  }
  return lines + line + "\n";
}

/// The line with its explanation as a comment beside it, or above it if the line would become too
/// long.
std::string explained(const std::string& line, const std::string& meaning) {
  if (meaning.empty() || line.find('#') != std::string::npos) return line + "\n";
  const std::string beside = fmt::format("{:<34}  # {}", line, meaning);
  return beside.size() <= widest ? beside + "\n" : comment_lines(meaning) + line + "\n";
}

bool is_for_tests(const std::string& line) {
  return line.starts_with("# test:") || line.starts_with("# verify ");
}

}  // namespace

std::string commented_scene(const Document& scene) {
  const std::vector<KeyTable> reference = key_tables();
  std::set<std::pair<std::string, std::string>> said;  // each explanation is printed once
  std::string text = fmt::format(
      "# Begun as the scene '{}' of Meniscus. `meniscus keys TABLE` says what else a "
      "table may\n# have, `meniscus check` what the numbers mean.\n",
      scene.name);
  for (const Part& part : parts_of(scene.text)) {
    const Explanations explanations(reference, part);
    for (const std::string& line : part.lines) {
      if (is_for_tests(line)) continue;
      const std::string key = key_of_line(line);
      std::string meaning;
      if (line.starts_with('[') && said.insert({part.path, ""}).second)
        meaning = explanations.of_table();
      else if (!key.empty() && said.insert({part.path, key}).second)
        meaning = explanations.of_key(key);
      text += explained(line, meaning);
    }
  }
  return text;
}

}  // namespace meniscus
