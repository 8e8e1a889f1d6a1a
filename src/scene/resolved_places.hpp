// SPDX-License-Identifier: BSD-3-Clause
// Whether numbers tell the particles of a body apart where it is.
#pragma once
#include "body/grid/grid.hpp"
#include "input/units.hpp"
#include "numbers/types.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <string>

namespace meniscus {

/// The shortest edge of a cell.
template <int D>
Real shortest_edge(const Grid<D>& grid) {
  Real shortest = std::numeric_limits<Real>::max();
  for (const auto& cell : grid.cells)
    for (int a = 0; a < Grid<D>::corners; ++a)
      for (int k = 0; k < D; ++k) {
        const Index one = at(cell, a), other = at(cell, a | (1 << k));
        if (one != other)  // corners of simplices coincide
          shortest = std::min(shortest, (at(grid.X, one) - at(grid.X, other)).norm());
      }
  return shortest;
}

/// Forces come from differences of places. Why a body whose coordinates reach `farthest` cannot be
/// computed, without its name; empty if it can. `edge`: the shortest edge of its cells.
inline std::string lost_in_rounding(Real farthest, Real edge, const UnitSystem& units) {
  // Largest rounding as a share of the edge; errors of forces and energies are about as large.
  constexpr Real most = 1e-6;
  const Real rounding = std::numeric_limits<Real>::epsilon() * farthest;
  if (rounding <= most * edge) return "";
  const std::string unit = units.symbol(dimension::length);
  return fmt::format(
      "its places reach {:.4g} {}, where numbers are {:.2g} {} apart; its shortest edge of a "
      "cell is {:.4g} {}, with which they may reach {:.2g} {}; move it towards the origin, or make "
      "its cells more even",
      farthest, unit, rounding, unit, edge, unit,
      most * edge / std::numeric_limits<Real>::epsilon(), unit);
}

}  // namespace meniscus
