// SPDX-License-Identifier: BSD-3-Clause
// Rows of the cell rule in single precision; a few entries in double compensate the rounding.
#pragma once
#include "body/grid/stress_rules.hpp"

namespace meniscus {

/// Chooses as many entries of a row as there are quadratic monomials, moves them to the front, and
/// corrects their coefficients. The sums of the row over quadratic polynomials of the position then
/// stay the same if all other entries are rounded (performance note 2). `X`: positions of all
/// particles. `centre`: centre of the row. Returns the number of entries that have to stay in
/// double, which is all of them if no choice is well conditioned.
template <int D>
std::size_t make_up_for_rounding(std::span<const Vec<D>> X, const Vec<D>& centre,
                                 std::vector<Index>& particle,
                                 std::vector<std::array<Lanes, D>>& gradient);

}  // namespace meniscus
