// SPDX-License-Identifier: BSD-3-Clause
// The reference of all keys of a scene, as text, Markdown and JSON Schema; and the list of
// measures.
#pragma once
#include "input/key_table.hpp"
#include "scene/plan.hpp"

#include <ostream>
#include <string>
#include <vector>

namespace meniscus {

/// The tables of a scene in the order of the reference.
std::vector<KeyTable> key_tables();

/// The parts of a heading: `[[body]] shape = "ball" (3D): ball` is the array of tables `body` whose
/// key `shape` has the value "ball".
struct KeyHeading {
  std::string path;  ///< "contact.partner"; empty at the top level
  bool is_array = false;
  std::string kind_key, kind;  ///< empty if the table has no such key
};
KeyHeading heading_of(const KeyTable& table);

/// Prints every key of a scene with unit, range, default and meaning. With `wanted`, prints only
/// the tables of this name ("time", "contact", "ball"); if there are none, the keys of this name;
/// if there are none, all keys whose texts contain it. Throws InputError if nothing is found.
void print_keys(std::ostream& out, const std::string& wanted = "");

/// Like print_keys(), in Markdown.
void print_keys_as_markdown(std::ostream& out, const std::string& wanted = "");

/// Prints every measure with unit and meaning, grouped by the item that provides it. Builds small
/// scenes, which takes a moment.
void print_measures(std::ostream& out);

/// Notes a problem for each measure in the output and the expectations of a scene that cannot
/// exist: no body or load in `names` has its first part, or no scene has a measure with its second
/// part. Used when other problems prevent the scene from being built.
void note_unknown_measures(const Block& root, const RunSettings& run,
                           const std::vector<std::string>& names);

/// Prints a JSON Schema (draft 7) of scenes, with which editors complete and check keys. It
/// contains tables, keys, types, choices, required keys and signs. Rules that depend on units or on
/// other keys are only checked by `meniscus check`.
void print_key_schema(std::ostream& out);

}  // namespace meniscus
