// SPDX-License-Identifier: BSD-3-Clause
// Rows of the cell rule in single precision whose rounding a few entries in double make up for.
#pragma once
#include "meniscus/approx/stress_rules.hpp"

namespace meniscus {

/// Chooses as many entries as there are quadratic monomials, puts them first, and adds to them what
/// rounding takes from the sums of all others over quadratic polynomials of the place, so that the
/// sums over the row stay what they were (performance note 2). `X`: of all particles. `centre`: of
/// the row. Returns the number of entries that have to stay in double: all if no choice is well
/// conditioned.
template <int D>
std::size_t make_up_for_rounding(std::span<const Vec<D>> X, const Vec<D>& centre,
                                 std::vector<Index>& particle,
                                 std::vector<std::array<Lanes, D>>& gradient);

}  // namespace meniscus
