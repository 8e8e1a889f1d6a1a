// SPDX-License-Identifier: BSD-3-Clause
// Young's modulus and Poisson's ratio as keys for the parameters of an isotropic law.
#include "physics/internal/elastic_moduli.hpp"

#include "input/text.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <string>

namespace meniscus {
namespace {

constexpr const char *young = "youngs_modulus", *poisson = "poissons_ratio";

/// The keys as a text: "mu and lambda".
std::string names_of(std::span<const OfModuli> numbers) {
  std::vector<std::string> names;
  for (const OfModuli& number : numbers) names.emplace_back(number.key);
  return joined(names, " and ");
}

/// The formula with each {name} replaced by values(name) in brackets.
std::string inserted(std::string_view formula, const auto& values) {
  std::string text;
  while (!formula.empty()) {
    const std::size_t open = std::min(formula.find('{'), formula.size());
    text += formula.substr(0, open);
    formula.remove_prefix(open);
    if (formula.empty()) break;
    const std::size_t close = formula.find('}');
    text += '(' + values(formula.substr(1, close - 1)) + ')';
    formula.remove_prefix(close + 1);
  }
  return text;
}

}  // namespace

void supply_moduli(const Block& material, std::span<const OfModuli> numbers) {
  if (!material.has(young) && !material.has(poisson)) return;
  const Expression E = material.expression(young, dimension::pressure, std::nullopt,
                                           range::positive, Variables::place);
  const Expression nu = material.expression(poisson, dimension::none, std::nullopt,
                                            {-1, 0.5, true, true}, Variables::place);
  for (const OfModuli& number : numbers)
    if (material.has(number.key))
      material.problem(number.key,
                       fmt::format("is given beside {} and {}; allowed are those two, or "
                                   "{} without them",
                                   young, poisson, names_of(numbers)));
  const auto value = [&](std::string_view name) {
    if (name == "E") return E.text();
    if (name == "nu") return nu.text();
    return material
        .expression(name, dimension::pressure, std::nullopt, range::any, Variables::place)
        .text();
  };
  for (const OfModuli& number : numbers)
    material.supply(number.key, inserted(number.formula, value), young);
}

void add_moduli(std::vector<KeyText>& keys, std::span<const OfModuli> numbers) {
  for (KeyText& key : keys)
    if (std::any_of(numbers.begin(), numbers.end(),
                    [&](const OfModuli& number) { return number.key == key.key; }))
      key.fallback = fmt::format("by {}", young);
  const std::string instead = fmt::format(", in place of {}", names_of(numbers));
  keys.push_back({young, "number or formula", "Pa", "> 0", "none",
                  fmt::format("of small strains, with {}{}", poisson, instead)});
  keys.push_back({poisson, "number or formula", "", "> -1 and < 0.5", "none",
                  fmt::format("of small strains, with {}{}", young, instead)});
}

}  // namespace meniscus
