// SPDX-License-Identifier: BSD-3-Clause
// Stages: scenes that differ in some tables and start one where the other ends.
#include "input/input_node.hpp"
#include "input/names.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

namespace meniscus {
namespace {

using scene_tree::Array;
using scene_tree::Entry;
using scene_tree::Table;
using scene_tree::Value;

/// Tables that all stages share. Any other table may be in a stage, too.
constexpr const char* shared_keys[] = {"title", "dimension", "units", "body", "initial", "stage"};

/// Adds the entries of `over` to `under`. Tables are joined key by key and arrays of tables one
/// after the other; any other value replaces the value that is there.
void lay_over(Table& under, const Table& over) {
  for (const Entry& entry : over.entries) {
    Entry* const below = under.find(entry.key);
    if (below == nullptr) {
      under.entries.push_back(entry);
      continue;
    }
    auto* const table = std::get_if<Table>(&below->value.data);
    auto* const array = std::get_if<Array>(&below->value.data);
    const auto* more = std::get_if<Table>(&entry.value.data);
    const auto* others = std::get_if<Array>(&entry.value.data);
    const auto is_table = [](const Value& v) { return std::holds_alternative<Table>(v.data); };
    if (table != nullptr && more != nullptr)
      lay_over(*table, *more);
    else if (array != nullptr && others != nullptr &&
             std::all_of(others->begin(), others->end(), is_table))
      array->insert(array->end(), others->begin(), others->end());
    else
      *below = entry;
  }
}

void remove(Table& table, std::string_view key) {
  std::erase_if(table.entries, [&](const Entry& entry) { return entry.key == key; });
}

/// Removes the initial motion of all bodies, which only the first stage has.
void forget_initial_motion(Table& root) {
  Entry* const bodies = root.find("body");
  auto* const array = bodies == nullptr ? nullptr : std::get_if<Array>(&bodies->value.data);
  if (array == nullptr) return;
  for (Value& body : *array)
    if (auto* const table = std::get_if<Table>(&body.data))
      for (const char* key : {"initial_displacement", "initial_velocity"}) remove(*table, key);
}

std::string name_of(const Table& stage) {
  const Entry* name = stage.find("name");
  const auto* text = name == nullptr ? nullptr : std::get_if<std::string>(&name->value.data);
  return text == nullptr ? std::string() : *text;
}

}  // namespace

void become_stage(Value& scene, const StageChoice& choice) {
  Table& root = std::get<Table>(scene.data);
  const Array stages = std::get<Array>(root.find("stage")->value.data);
  const auto found = std::find_if(stages.begin(), stages.end(), [&](const Value& stage) {
    return name_of(std::get<Table>(stage.data)) == choice.name;
  });
  Table own = std::get<Table>(found->data);
  remove(own, "name");
  remove(root, "stage");
  lay_over(root, own);
  if (choice.from.empty()) return;
  forget_initial_motion(root);
  remove(root, "initial");
  const Entry from{"from", found->place, {choice.from, found->place}};
  root.entries.push_back({"initial", found->place, {Table{{from}}, found->place}});
}

std::vector<std::string> SceneInput::stages() const {
  std::vector<std::string> names;
  for (const Block& stage : root_.tables("stage")) {
    const std::string name = stage.text("name", std::nullopt);
    if (stage.has("name") && !is_plain_name(name))
      stage.problem(
          "name", fmt::format("'{}' cannot be a name; allowed are letters, digits, _ and -", name));
    if (std::find(names.begin(), names.end(), name) != names.end())
      stage.problem("name", fmt::format("the name '{}' is used twice", name));
    for (const char* key : shared_keys)
      if (stage.has(key))
        stage.problem(key, "is the same in all stages; it is allowed in the scene only");
    names.push_back(name);
  }
  check();
  return names;
}

}  // namespace meniscus
