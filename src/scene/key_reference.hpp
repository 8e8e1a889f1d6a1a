// SPDX-License-Identifier: BSD-3-Clause
// The reference of all keys of a scene: to read, for documents, and for editors; and of measures.
#pragma once
#include "input/key_table.hpp"

#include <ostream>
#include <string>
#include <vector>

namespace meniscus {

/// The tables of a scene in the order of the reference.
std::vector<KeyTable> key_tables();

/// What a heading says: `[[body]] shape = "ball" (3D): ball` is the array of tables `body`, of the
/// kind "ball" by its key `shape`.
struct KeyHeading {
  std::string path;  ///< "contact.partner"; empty at the top level
  bool is_array = false;
  std::string kind_key, kind;  ///< empty if the table is of any kind
};
KeyHeading heading_of(const KeyTable& table);

/// Prints every key of a scene with unit, range, default and meaning, or what `wanted` names: the
/// tables of that name ("time", "contact", "ball"), else the keys, else all in whose texts it
/// occurs. Throws InputError if nothing does.
void print_keys(std::ostream& out, const std::string& wanted = "");

/// The same in Markdown.
void print_keys_as_markdown(std::ostream& out, const std::string& wanted = "");

/// Prints every measure with unit and meaning, by what has it. Builds small scenes: takes a moment.
void print_measures(std::ostream& out);

/// A JSON Schema (draft 7) of scenes, by which editors complete and check keys. It knows tables,
/// keys, types, choices, required keys and signs; what depends on units and on other keys,
/// `meniscus check` knows.
void print_key_schema(std::ostream& out);

}  // namespace meniscus
