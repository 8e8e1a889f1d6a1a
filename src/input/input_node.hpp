// SPDX-License-Identifier: BSD-3-Clause
// Nodes behind Block and SceneInput: the document with its list of problems, and one node per
// requested table. A node remembers the values that were read.
#pragma once
#include "input/constants.hpp"
#include "input/input.hpp"
#include "input/scene_tree.hpp"
#include "meniscus/error.hpp"

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace meniscus {
namespace input_values {
struct Number;
}

struct Problem {
  scene_tree::Place place;
  std::string text;  ///< "key.path: what is wrong; allowed"
};

/// A scene file and all problems found in it.
struct Document {
  std::string name;
  std::string text;
  std::vector<std::string> settings;  ///< texts of --set
  std::string stage;                  ///< name of the stage, if this is one
  scene_tree::Value root;
  UnitSystem units;
  bool in_plane = false;  ///< dimension = 2: formulas know no z
  Real end = 0;           ///< time.end; 0 if it is missing or wrong
  Real refine = 1;        ///< resolution.refine; 1 if it is missing or wrong
  Constants constants;
  std::vector<Problem> problems;

  /// "file:line:column" or "--set 'text'".
  std::string place_text(const scene_tree::Place& place) const;
};

/// Turns the tree of a scene with stages into the tree of one of them.
void become_stage(scene_tree::Value& scene, const StageChoice& choice);

/// A table of the scene. If it is absent, all keys have their defaults.
struct Block::Node {
  /// A value that was read, for the complete input (the scene with all defaults).
  struct Echo {
    std::string key, value, comment;
  };
  /// An entry that follows from the key `source` and is not in the table. It is read like any other
  /// entry but not written to the complete input.
  struct Supplied {
    scene_tree::Entry entry;
    std::string source;
  };
  struct Child {
    std::string key;
    bool in_array;
    std::shared_ptr<Node> node;
  };

  std::shared_ptr<Document> document;
  const scene_tree::Table* table = nullptr;  ///< points into the document; null when absent
  std::string path;
  scene_tree::Place place;
  bool quiet = false;              ///< not a table or unknown kind: do not report missing keys
  bool wrong = false;              ///< a problem was noted, or a value needs a broken constant
  bool guessed = false;            ///< a value that needs a broken constant was replaced
  std::vector<std::string> known;  ///< keys that the program uses, for messages
  std::vector<std::string> was_read;
  std::vector<Echo> echoes;
  std::deque<Supplied> supplied;
  std::vector<Child> children;

  /// The entry `key` if it is in the table or supplied.
  const scene_tree::Entry* find(std::string_view key) const;
  /// Like find(), but also marks `key` as known.
  const scene_tree::Entry* ask(std::string_view key);
  /// Like ask(), but also marks `key` as read.
  const scene_tree::Entry* take(std::string_view key);
  /// The full path of `key` for messages. For a supplied entry, the path of its source is added.
  std::string called(std::string_view key) const;
  void note(const scene_tree::Place& where, const std::string& full_path, const std::string& what);
  /// Marks the table if a value needs a broken constant, whose problem is noted elsewhere.
  void mark_guess(const scene_tree::Value& value);
  void note_missing(std::string_view key, const std::string& allowed);
  /// Takes back the note of the missing key that stands here misspelt: one mistake, one message.
  void forget_missing(std::string_view given);
  void echo(std::string_view key, std::string value, const std::string& unit, bool fallback);
  /// The node of a sub-table. Repeated calls return the same node.
  std::shared_ptr<Node> child(std::string_view key, bool in_array, const std::string& full_path,
                              const scene_tree::Table* table, const scene_tree::Place& where);

  /// Numbers of a key of this table.
  input_values::Number number(Dimension dimension, const Range& range) const;

  /// Returns convert(value). If that throws InputError, notes the problem and returns nothing.
  template <class Convert>
  auto attempt(const scene_tree::Value& value, const std::string& full_path, Convert convert)
      -> std::optional<decltype(convert(value))> {
    try {
      return convert(value);
    } catch (const InputError& error) {
      note(value.place, full_path, error.what());
      return std::nullopt;
    }
  }

  /// Reads a key and converts its value. Returns `fallback` if the key is absent. If the value is
  /// wrong, or if the key is absent and has no fallback, notes the problem and returns `fallback`
  /// or else `harmless`. `allowed` says in messages what values the key may have. `unit` is the
  /// unit of the default in the list of keys.
  template <class T, class Convert>
  T read(std::string_view key, const std::string& allowed, const std::string& unit,
         const std::optional<T>& fallback, const T& harmless, Convert convert);

  /// Reads an array of `count` values (0: any number) and converts each; otherwise like read().
  template <class T, class Convert>
  std::vector<T> read_list(std::string_view key, std::size_t count, const std::string& allowed,
                           const std::string& unit, const std::optional<std::vector<T>>& fallback,
                           const T& harmless, Convert convert);

  /// Reads all entries of this table as constants of the document. Entries may refer to each other
  /// in any order.
  void read_constants();
  class ConstantsReader;
  /// Reads all entries of this table as functions of the document. Their formulas may use constants
  /// that are read later.
  void read_functions();
  /// Notes problems in the formulas of functions. Called after the constants have been read.
  void check_functions();

  /// Appends this table and its sub-tables as TOML. `header` is the full name of the table, and
  /// `in_array` is true for an entry of an array of tables.
  void write(std::string& toml, const std::string& header, bool in_array) const;
};

}  // namespace meniscus
