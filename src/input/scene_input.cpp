// SPDX-License-Identifier: BSD-3-Clause
// Opens a whole scene, reports its problems, and writes the complete input.
#include "input/input.hpp"
#include "input/input_node.hpp"
#include "input/input_values.hpp"
#include "input/text.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <unordered_set>

namespace meniscus {

namespace {

std::string file_text(const std::string& path) {
  const auto refuse = [&](const std::string& reason) {
    throw FileError(fmt::format("cannot read the scene '{}': {}", path, reason));
  };
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) refuse("it is a directory; name a .toml file");
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse(std::generic_category().message(errno));
  constexpr std::size_t most = 10'000'000;
  std::string content;
  std::array<char, 65536> piece;
  while (file && content.size() <= most) {
    file.read(piece.data(), piece.size());
    content.append(piece.data(), static_cast<std::size_t>(file.gcount()));
  }
  if (file.bad()) refuse("reading failed");
  if (content.size() > most)
    throw InputError(fmt::format("{}:1:1: the file is larger than a scene can be, 10 MB", path));
  return content;
}

bool is_blank(std::string_view text) {
  return text.find_first_not_of(" \t\r\n") == std::string_view::npos;
}

/// Applies all settings; throws one report of all that cannot be applied.
void apply_settings(Document& document) {
  std::string report;
  for (std::size_t i = 0; i < document.settings.size(); ++i) {
    const std::string& setting = document.settings[i];
    try {
      scene_tree::apply_setting(document.root, setting, static_cast<int>(i) + 1);
    } catch (const InputError& error) {
      report += fmt::format("{}--set '{}': {}", report.empty() ? "" : "\n", setting, error.what());
    }
  }
  if (!report.empty()) throw InputError(report);
}

/// Shortens a line: a long list of allowed names is printed once, in the first line that needs it.
/// Later lines refer to that line.
void refer_to_list_above(std::string& line, std::unordered_set<std::string>& said) {
  constexpr std::string_view begin = "allowed are ";
  constexpr std::size_t few = 80;
  const std::size_t first = line.find(begin);
  if (first == std::string::npos) return;
  const std::size_t last = std::min(line.find("; ", first), line.size());
  if (last - first <= few || said.insert(line.substr(first, last - first)).second) return;
  line.replace(first + begin.size(), last - first - begin.size(), "the names listed above");
}

/// A number of a scene; the fallback if it is missing or wrong.
Real number_of(const Document& document, std::string_view table, std::string_view key,
               Dimension dimension, const Range& allowed, Real fallback) {
  const auto& root = std::get<scene_tree::Table>(document.root.data);
  const scene_tree::Entry* const entry = root.find(table);
  const auto* const keys =
      entry == nullptr ? nullptr : std::get_if<scene_tree::Table>(&entry->value.data);
  const scene_tree::Entry* const found = keys == nullptr ? nullptr : keys->find(key);
  if (found == nullptr) return fallback;
  try {
    return input_values::Number{document.units, dimension, allowed, document.constants,
                                document.in_plane}
        .real(found->value);
  } catch (const InputError&) {  // who reads it notes that
    return fallback;
  }
}

}  // namespace

std::string Document::place_text(const scene_tree::Place& place) const {
  if (place.setting != 0) return fmt::format("--set '{}'", at(settings, place.setting - 1));
  return fmt::format("{}:{}:{}", name, place.line, place.column);
}

SceneInput SceneInput::from_file(const std::string& path, const std::vector<std::string>& overrides,
                                 const std::optional<StageChoice>& stage) {
  const std::string text = file_text(path);
  if (is_blank(text)) throw InputError(fmt::format("{}:1:1: the scene is empty", path));
  return from_text(text, path, overrides, stage);
}

SceneInput SceneInput::from_text(std::string_view toml, std::string name,
                                 const std::vector<std::string>& overrides,
                                 const std::optional<StageChoice>& stage) {
  auto document = std::make_shared<Document>();
  document->name = std::move(name);
  document->text = std::string(toml);
  document->settings = overrides;
  document->root = scene_tree::parse(toml, document->name);
  apply_settings(*document);
  if (stage) become_stage(document->root, *stage);
  if (stage) document->stage = stage->name;

  auto node = std::make_shared<Block::Node>();
  node->document = document;
  node->table = &std::get<scene_tree::Table>(document->root.data);
  SceneInput input;
  input.root_ = Block(node);

  const Block units = input.root_.table_or_defaults("units");
  const std::string system = units.text("system", "SI");
  try {
    document->units = UnitSystem(system);
  } catch (const InputError& error) {
    units.problem("system", error.what());
  }
  units.done();
  const auto constants = input.root_.table("constants"), functions = input.root_.table("functions");
  if (functions) functions->node_->read_functions();
  if (constants) constants->node_->read_constants();
  if (functions) functions->node_->check_functions();
  if (const scene_tree::Entry* dimension = node->table->find("dimension")) try {
      if (input.root_.is_text("dimension")) document->units.take_whole_bodies();
      document->in_plane =
          input.root_.is_text("dimension") ||
          input_values::integer(dimension->value, {2, 3}, document->constants) == 2;
    } catch (const InputError&) {  // who reads it notes that
    }
  document->end = number_of(*document, "time", "end", dimension::time, range::positive, 0);
  document->refine = number_of(*document, "resolution", "refine", dimension::none, refinements, 1);
  return input;
}

const std::string& SceneInput::text() const {
  return root_.node_->document->text;
}

const Document& SceneInput::document() const {
  return *root_.node_->document;
}

void SceneInput::check() const {
  const Document& document = *root_.node_->document;
  if (document.problems.empty()) return;
  std::vector<Problem> sorted = document.problems;
  // Problems in the file come first, then problems of settings in their order.
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Problem& a, const Problem& b) { return a.place < b.place; });
  constexpr std::size_t most = 100;  // more lines would not be read
  std::vector<std::string> lines;
  std::unordered_set<std::string> known;
  for (const Problem& problem : sorted) {
    const std::string line =
        fmt::format("{}: {}{}", document.place_text(problem.place), problem.text,
                    document.stage.empty() ? "" : fmt::format(" (in stage '{}')", document.stage));
    if (known.insert(line).second && known.size() <= most) lines.push_back(line);
  }
  std::unordered_set<std::string> said;
  for (std::string& line : lines) refer_to_list_above(line, said);
  if (known.size() > most)
    lines.push_back(fmt::format("{}: and {} more problems", document.name, known.size() - most));
  throw InputError(joined(lines, "\n"));
}

void Block::Node::write(std::string& toml, const std::string& header, bool in_array) const {
  if (!header.empty()) toml += in_array ? "\n[[" + header + "]]\n" : "\n[" + header + "]\n";
  for (const Echo& line : echoes) {
    toml += fmt::format("{} = {}", scene_tree::key_text(line.key), line.value);
    if (!line.comment.empty()) toml += "  # " + line.comment;
    toml += '\n';
  }
  for (const Child& below : children)
    below.node->write(toml, scene_tree::joined(header, below.key), below.in_array);
}

std::string SceneInput::complete() const {
  std::string toml;
  root_.node_->write(toml, "", false);
  return toml;
}

}  // namespace meniscus
