// SPDX-License-Identifier: BSD-3-Clause
// Young's modulus and Poisson's ratio as keys for the parameters of an isotropic law.
#pragma once
#include "input/input.hpp"
#include "input/key_table.hpp"

#include <span>
#include <string_view>
#include <vector>

namespace meniscus {

/// A parameter of a law as a formula of E and nu and, if needed, of other keys of the law, each in
/// brackets: "{E}/(2*(1 + {nu}))". The formula holds for small strains.
struct OfModuli {
  std::string_view key, formula;
};

/// A law that lists such formulas in L::of_moduli.
template <class L>
concept LawOfModuli = requires {
  L::of_moduli;
};

/// If the scene gives youngs_modulus or poissons_ratio, supplies the keys of the law that follow
/// from them, as formulas if they are formulas. Notes a problem if one is given without the other,
/// or beside a key that follows from them.
void supply_moduli(const Block& material, std::span<const OfModuli>);

/// Adds both moduli to the keys of the law, and the note that other keys follow from them.
void add_moduli(std::vector<KeyText>& keys, std::span<const OfModuli>);

}  // namespace meniscus
