// SPDX-License-Identifier: BSD-3-Clause
// Prints the guide and the scenes of inputs/.
#include "app/documents.hpp"

#include "input/names.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <sstream>

namespace meniscus {
namespace {

/// A line of Markdown as plain text: without link targets and without the marks of bold words. Code
/// between backticks is not changed.
std::string without_signs(std::string_view line) {
  std::string plain;
  bool code = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '`') code = !code;
    const std::string_view rest = line.substr(i);
    if (!code && rest.starts_with("**")) {
      ++i;
    } else if (!code && rest.starts_with("](")) {
      i += rest.find(')');
      plain.erase(plain.rfind('['), 1);
    } else {
      plain += line[i];
    }
  }
  return plain;
}

std::string first_heading(std::string_view text) {
  const std::size_t begin = text.find("# ") + 2;
  return std::string(text.substr(begin, text.find('\n', begin) - begin));
}

std::string title_of(const Document& scene) {
  constexpr std::string_view key = "\ntitle = \"";
  const std::size_t at = scene.text.find(key);
  if (at == std::string_view::npos) return "";
  const std::size_t begin = at + key.size();
  return std::string(scene.text.substr(begin, scene.text.find('"', begin) - begin));
}

/// A list of the documents, one line "  name  text" for each.
std::string listed(std::span<const Document> documents, std::string (*text)(const Document&)) {
  std::size_t width = 0;
  for (const Document& d : documents) width = std::max(width, d.name.size());
  std::string lines;
  for (const Document& d : documents)
    lines += fmt::format("  {:<{}}  {}\n", d.name, width, text(d));
  return lines;
}

}  // namespace

std::vector<std::string> names_of(std::span<const Document> documents) {
  std::vector<std::string> names;
  for (const Document& document : documents) names.emplace_back(document.name);
  return names;
}

const Document& document_called(std::string_view name, std::span<const Document> documents,
                                std::string_view kind) {
  const auto found = std::find_if(documents.begin(), documents.end(),
                                  [&](const Document& d) { return d.name == name; });
  if (found != documents.end()) return *found;
  throw InputError(
      fmt::format("'{}' is no {}; {}", name, kind, allowed_names(name, names_of(documents))));
}

std::string printed_topic(const Document& topic) {
  std::istringstream lines{std::string(topic.text)};
  std::string text, line;
  bool code = false;
  while (std::getline(lines, line)) {
    if (line.starts_with("```")) {
      code = !code;
    } else if (code) {
      text += "    " + line + "\n";
    } else if (line.starts_with("#")) {
      const std::string heading = line.substr(line.find(' ') + 1);
      text += heading + "\n" + std::string(heading.size(), line[1] == '#' ? '-' : '=') + "\n";
    } else if (!line.starts_with("![")) {
      text += without_signs(line) + "\n";
    }
  }
  return text;
}

std::string list_of_topics() {
  return listed(guide_topics(), [](const Document& d) { return first_heading(d.text); });
}

std::string list_of_scenes() {
  return listed(gallery_scenes(), title_of);
}

std::string file_of_mesh(const Document& mesh) {
  return fmt::format("meshes/{}.msh", mesh.name);
}

std::vector<Document> meshes_of(const Document& scene) {
  std::vector<Document> meshes;
  for (const Document& mesh : gallery_meshes())
    if (scene.text.find('"' + file_of_mesh(mesh) + '"') != scene.text.npos) meshes.push_back(mesh);
  return meshes;
}

}  // namespace meniscus
