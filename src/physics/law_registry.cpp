// SPDX-License-Identifier: BSD-3-Clause
// The table of material laws by name.
#include "meniscus/physics/law_registry.hpp"

#include "meniscus/core/error.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace meniscus {
namespace {

/// A local static, because laws register from other files before main() in unknown order.
std::map<std::string_view, LawEntry>& table() {
  static std::map<std::string_view, LawEntry> entries;
  return entries;
}

}  // namespace

const std::map<std::string_view, LawEntry>& laws() {
  return table();
}

bool add_law(LawEntry entry) {
  const std::string_view name = entry.name;
  if (!table().emplace(name, std::move(entry)).second)
    throw std::logic_error(fmt::format("Two material laws are called '{}'.", name));
  return true;
}

const LawEntry& law_named(std::string_view name) {
  const auto found = table().find(name);
  if (found != table().end()) return found->second;
  std::string known;
  for (const auto& [known_name, entry] : table())
    known.append(known.empty() ? "" : ", ").append(known_name);
  throw InputError(fmt::format("There is no material law '{}'; known are {}.", name, known));
}

}  // namespace meniscus
