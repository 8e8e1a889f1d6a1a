// SPDX-License-Identifier: BSD-3-Clause
// Nodes behind Block and SceneInput: the document with its list of problems, and one node per table
// that was asked for, which remembers the values it handed out.
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

struct Problem {
  scene_tree::Place place;
  std::string text;  ///< "key.path: what is wrong; allowed"
};

/// A scene and everything found wrong with it.
struct Document {
  std::string name;
  std::string text;
  std::vector<std::string> settings;  ///< of --set
  scene_tree::Value root;
  UnitSystem units;
  Constants constants;
  std::vector<Problem> problems;

  /// "file:line:column" or "--set 'text'".
  std::string place_text(const scene_tree::Place& place) const;
};

/// A table, or an absent one in which everything has its default.
struct Block::Node {
  /// A value handed out, as it is written in the complete input.
  struct Echo {
    std::string key, value, comment;
  };
  /// As if in the table, but not echoed: it follows from what stands under `source`.
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
  bool quiet = false;    ///< not a table, or of unknown kind: missing keys are not worth a line
  bool wrong = false;    ///< something was noted, or a value needs a broken constant
  bool guessed = false;  ///< another value stands in for one that needs a broken constant
  std::vector<std::string> known;  ///< keys that were asked for, for messages
  std::vector<std::string> was_read;
  std::vector<Echo> echoes;
  std::deque<Supplied> supplied;
  std::vector<Child> children;

  /// The entry `key` if it is in the table or supplied.
  const scene_tree::Entry* find(std::string_view key) const;
  /// The same, and `key` counts as known.
  const scene_tree::Entry* ask(std::string_view key);
  /// The same, to be read now.
  const scene_tree::Entry* take(std::string_view key);
  /// The full path of `key`, for messages; of a supplied one that of what it follows from, too.
  std::string called(std::string_view key) const;
  void note(const scene_tree::Place& where, const std::string& full_path, const std::string& what);
  /// Marks the table if a value needs a broken constant, whose problem is noted elsewhere.
  void mark_guess(const scene_tree::Value& value);
  void note_missing(std::string_view key, const std::string& allowed);
  void echo(std::string_view key, std::string value, const std::string& unit, bool fallback);
  /// The node of a sub-table, the same one each time it is asked for.
  std::shared_ptr<Node> child(std::string_view key, bool in_array, const std::string& full_path,
                              const scene_tree::Table* table, const scene_tree::Place& where);

  /// What `convert(value)` makes of a value; if it throws InputError, notes that and gives nothing.
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

  /// The value of a key by `convert`; the fallback if it is absent; after a problem the fallback or
  /// else `harmless`. `allowed` ends the message about a missing key.
  template <class T, class Convert>
  T read(std::string_view key, const std::string& allowed, const std::string& unit,
         const std::optional<T>& fallback, const T& harmless, Convert convert);

  /// The same for an array of `count` values (0: any number), each by `convert`.
  template <class T, class Convert>
  std::vector<T> read_list(std::string_view key, std::size_t count, const std::string& allowed,
                           const std::string& unit, const std::optional<std::vector<T>>& fallback,
                           const T& harmless, Convert convert);

  /// Takes every entry of this table as a named number of the document, in whatever order they
  /// refer to each other.
  void read_constants();
  class ConstantsReader;
  /// Takes every entry of this table as a function of the document; their formulas may use
  /// constants that are read later.
  void read_functions();
  /// When there are constants: notes what is wrong with the formulas of functions.
  void check_functions();

  /// Appends this table and those below as TOML, with `header` as its full name.
  void write(std::string& toml, const std::string& header, bool in_array) const;
};

}  // namespace meniscus
