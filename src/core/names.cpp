// SPDX-License-Identifier: BSD-3-Clause
// Suggestions for names that are misspelt or those of other programs.
#include "meniscus/core/names.hpp"

#include "meniscus/core/text.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace meniscus {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  // Rows i-2, i-1 and i of the table of distances between the first i letters of a and j of b.
  std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before.swap(above);
    above.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::string did_you_mean(std::string_view given, const std::vector<std::string>& known) {
  constexpr std::size_t longest = 64;  // beyond, nobody misspelt anything, and the table is large
  if (given.size() > longest) return "";
  const std::string* nearest = nullptr;
  std::size_t least = 0;
  for (const std::string& name : known) {
    const std::size_t distance = edit_distance(given, name);
    if (distance > std::max<std::size_t>(1, name.size() / 3) || distance >= name.size()) continue;
    if (nearest == nullptr || distance < least) {
      nearest = &name;
      least = distance;
    }
  }
  return nearest == nullptr ? "" : fmt::format("; did you mean '{}'?", *nearest);
}

namespace {

constexpr std::string_view moduli = "isotropic solids have youngs_modulus and poissons_ratio";
constexpr std::string_view isotropic =
    "neo_hookean, st_venant_kirchhoff and mooney_rivlin have them";

/// What other programs call something, and where it is here.
constexpr std::pair<std::string_view, std::string_view> foreign_words[] = {
    {"gravity", "a weight is a table [[body_force]] with its acceleration"},
    {"dt", "the step is [time] step, chosen by itself if absent"},
    {"timestep", "the step is [time] step, chosen by itself if absent"},
    {"time_step", "the step is [time] step, chosen by itself if absent"},
    {"sphere", "a sphere is a 'ball'"},
    {"circle", "a circle is a 'disk'"},
    {"cube", "a cube is a 'box'"},
    {"square", "a square is a 'rectangle'"},
    {"youngs_modulus", isotropic},
    {"poissons_ratio", isotropic},
    {"young_modulus", moduli},
    {"poisson_ratio", moduli},
};

std::string hint(std::string_view given, const std::vector<std::string>& known) {
  for (const auto& [word, home] : foreign_words)
    if (word == given) return fmt::format("; {}", home);
  return did_you_mean(given, known);
}

}  // namespace

std::string allowed_names(std::string_view given, const std::vector<std::string>& known) {
  if (known.empty()) return "none is allowed";
  return fmt::format("allowed {} {}{}", known.size() == 1 ? "is" : "are", joined(known, ", "),
                     hint(given, known));
}

}  // namespace meniscus
