// SPDX-License-Identifier: BSD-3-Clause
// Suggestions for misspelt names and for names that other programs use.
#include "input/names.hpp"

#include "input/text.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
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
  constexpr std::size_t longest = 64;  // longer texts are no misspelt names
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

constexpr std::string_view step = "the step is [time] step, chosen by itself if absent",
                           weight = "a weight is a table [[body_force]] with its acceleration";

/// A word of other programs, a sentence about its place in this program, and the name of the table
/// or key here if it differs.
struct ForeignWord {
  std::string_view word, home, own = {};
};
constexpr ForeignWord foreign_words[] = {
    {"gravity", weight, "body_force"},
    {"weight", weight, "body_force"},
    {"dt", step, "step"},
    {"timestep", step, "step"},
    {"time_step", step, "step"},
    {"sphere", "a sphere is a 'ball'", "ball"},
    {"circle", "a circle is a 'disk'", "disk"},
    {"cube", "a cube is a 'box'", "box"},
    {"square", "a square is a 'rectangle'", "rectangle"},
    {"youngs_modulus", isotropic},
    {"poissons_ratio", isotropic},
    {"young_modulus", moduli, "youngs_modulus"},
    {"poisson_ratio", moduli, "poissons_ratio"},
};

const ForeignWord* find_foreign(std::string_view word) {
  const auto* found = std::find_if(std::begin(foreign_words), std::end(foreign_words),
                                   [&](const ForeignWord& f) { return f.word == word; });
  return found == std::end(foreign_words) ? nullptr : found;
}

std::string hint(std::string_view given, const std::vector<std::string>& known) {
  const ForeignWord* foreign = find_foreign(given);
  return foreign == nullptr ? did_you_mean(given, known) : fmt::format("; {}", foreign->home);
}

}  // namespace

std::string_view own_word(std::string_view foreign) {
  const ForeignWord* found = find_foreign(foreign);
  return found == nullptr ? std::string_view() : found->own;
}

std::string allowed_names(std::string_view given, const std::vector<std::string>& known) {
  if (known.empty()) return "none is allowed";
  return fmt::format("allowed {} {}{}", known.size() == 1 ? "is" : "are", joined(known, ", "),
                     hint(given, known));
}

bool is_plain_name(std::string_view name) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; };
  return !name.empty() && std::all_of(name.begin(), name.end(), plain);
}

}  // namespace meniscus
