// SPDX-License-Identifier: BSD-3-Clause
// The cell rule of a body of revolution (axisymmetry note 3).
#pragma once
#include "body/body.hpp"
#include "body/sums_over_ranks.hpp"

namespace meniscus {

/// Appends the rows of the given cells to a rule without rows, and adds their integrals of shape
/// functions. Throws SolveError where shape functions cannot be determined.
void append_folded_rows(const Body<2>& body, OwnItems cells, CellRule<2>& rule,
                        SumsOverRanks& shape_integral);

}  // namespace meniscus
