// SPDX-License-Identifier: BSD-3-Clause
// Grids without their bulges, for what is known of straight cells.
#pragma once
#include "meniscus/body/grid.hpp"

namespace meniscus::test {

template <int D>
Grid<D> straight(Grid<D> grid) {
  grid.bulges.clear();
  grid.bulge_of.clear();
  return grid;
}

}  // namespace meniscus::test
