// SPDX-License-Identifier: BSD-3-Clause
// The reference of input keys that `meniscus keys` prints. It is made from the rows that read them.
#pragma once
#include "input/input.hpp"

#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

/// One key with its type, unit in SI, allowed range, default and meaning.
struct KeyText {
  std::string key, type, unit, range, fallback, meaning;
};

/// The keys of one table of a scene.
struct KeyTable {
  std::string heading;  ///< e.g. "[[body]]"
  std::vector<KeyText> keys;
  std::string example = {};  ///< lines of a scene
};

template <class M>
std::vector<KeyText> key_texts(const Rows<M>& rows) {
  std::vector<KeyText> keys;
  for (const Row<M>& row : rows)
    keys.push_back({row.key, row.type, row.unit, row.range, row.fallback, row.meaning});
  return keys;
}

/// The lines of T::example: a scene table with at least the required keys of T. Empty if T has no
/// example, which a test reports.
template <class T>
constexpr std::string_view example_of() {
  if constexpr (requires { T::example; })
    return T::example;
  else
    return {};
}

/// Prints heading, keys as lines of an aligned table, and example.
void print(std::ostream& out, const KeyTable& table);

}  // namespace meniscus
