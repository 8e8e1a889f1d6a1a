// SPDX-License-Identifier: BSD-3-Clause
// Young's modulus and Poisson's ratio in place of the numbers of an isotropic law.
#pragma once
#include "meniscus/core/input.hpp"
#include "meniscus/core/key_table.hpp"

#include <span>
#include <string_view>
#include <vector>

namespace meniscus {

/// A number of a law for small strains, as a formula of E and nu and, if need be, of other keys of
/// the law, each in brackets: "{E}/(2*(1 + {nu}))".
struct OfModuli {
  std::string_view key, formula;
};

/// A law that lists them in L::of_moduli.
template <class L>
concept LawOfModuli = requires {
  L::of_moduli;
};

/// If the scene gives youngs_modulus or poissons_ratio, supplies the keys of the law with what
/// follows from them, where they are formulas, too. Notes problems: one without the other, or
/// beside a key that follows.
void supply_moduli(const Block& material, std::span<const OfModuli>);

/// Adds the two to the keys of the law, and says of those that follow what they follow from.
void add_moduli(std::vector<KeyText>& keys, std::span<const OfModuli>);

}  // namespace meniscus
