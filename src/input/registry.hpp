// SPDX-License-Identifier: BSD-3-Clause
// The registry: entries of one kind by name. Each entry registers itself from its own file before
// main() begins, so adding one means adding one file.
#pragma once
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

namespace registry {
[[noreturn]] void throw_taken(std::string_view kind, std::string_view name);
[[noreturn]] void throw_unknown(std::string_view kind, std::string_view name,
                                const std::vector<std::string>& known);
}  // namespace registry

/// All entries of a kind, sorted by name. An Entry is a struct with `name` and the text `static
/// constexpr const char* kind` that names the kind in messages, e.g. "material law".
template <class Entry>
class Registry {
 public:
  /// The registry of this kind. It is a local static because the order of registration is unknown.
  static Registry& all() {
    static Registry registry;
    return registry;
  }

  /// Returns true. Throws std::logic_error if the name is taken.
  bool add(Entry entry) {
    std::string name(entry.name);
    if (find(name) != nullptr) registry::throw_taken(Entry::kind, name);
    entries_.emplace(std::move(name), std::move(entry));
    return true;
  }

  /// The entry called `name`, or null.
  const Entry* find(std::string_view name) const {
    const auto found = entries_.find(name);
    return found == entries_.end() ? nullptr : &found->second;
  }
  /// The entry called `name`. Throws InputError (without a place) that lists the known names and
  /// suggests the nearest.
  const Entry& at(std::string_view name) const {
    if (const Entry* entry = find(name)) return *entry;
    registry::throw_unknown(Entry::kind, name, names());
  }

  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& [name, entry] : entries_) all.push_back(name);
    return all;
  }
  std::size_t size() const { return entries_.size(); }
  /// Pairs (name, entry).
  auto begin() const { return entries_.begin(); }
  auto end() const { return entries_.end(); }

 private:
  std::map<std::string, Entry, std::less<>> entries_;
};

/// Registers an entry. A leaf file ends with `const bool registered = register_entry(...);`.
template <class Entry>
bool register_entry(Entry entry) {
  return Registry<Entry>::all().add(std::move(entry));
}

}  // namespace meniscus
