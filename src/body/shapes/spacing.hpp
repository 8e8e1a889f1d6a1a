// SPDX-License-Identifier: BSD-3-Clause
// Numbers of cells of a shape from the size of its cells: the key `spacing`.
#pragma once
#include "input/input.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace meniscus {

/// The number of cells along a length: length / spacing, rounded to a multiple of `multiple`, at
/// least `least` and at most 1e6.
inline int cells_of_spacing(Real length, Real spacing, int multiple = 1, int least = 1) {
  constexpr Real most = 1e6;
  const Real wanted = std::min(length / spacing, most) / multiple;
  return std::max(least, multiple * static_cast<int>(std::lround(wanted)));
}

/// Numbers of cells of a cubed ball or disk (cubed_ball): along an edge of the core and in shells.
struct RoundCells {
  int core, shells;
};

/// The cells of a ball or disk. If radius / spacing is an even number, their mean size, the root of
/// the mean volume or area, is `spacing` to 2.5 %. The core has an even number of radius / spacing
/// cells, so that the ball can be halved, and half as many shells.
inline RoundCells round_cells(Real radius, Real spacing) {
  const int core = cells_of_spacing(radius, spacing, 2, 2);
  return {core, core / 2};
}

/// Adds the key `spacing`, a length that may be given instead of the keys `counts`. If it is given,
/// the keys `counts` are not read, and set(shape, spacing) sets their members after all other keys
/// have been read.
template <class S, class Set>
Rows<S> with_spacing(Rows<S> rows, const std::vector<std::string>& counts,
                     const std::string& meaning, Set set) {
  for (Row<S>& row : rows)
    if (std::find(counts.begin(), counts.end(), row.key) != counts.end())
      row.read = [read = row.read, key = row.key](S& shape, const Block& block) {
        if (!block.has("spacing") || block.has(key)) read(shape, block);
      };
  const std::string others = joined(counts, ", ");
  Row<S> row = real_row<S>("spacing", nullptr, dimension::length, range::positive,
                           meaning + "; either this or " + others);
  row.fallback = "by " + others;
  row.read = [set, counts, others](S& shape, const Block& block) {
    if (!block.has("spacing")) return;
    const Real spacing = block.real("spacing", dimension::length, range::positive, 1.0);
    for (const std::string& key : counts)
      if (block.has(key)) {
        block.problem("spacing",
                      "is given beside " + key + "; allowed is either spacing or " + others);
        return;
      }
    if (block.in_order()) set(shape, spacing);
  };
  rows.push_back(std::move(row));
  return rows;
}

/// with_spacing() for shapes of a cubed ball or disk: `radius` returns the radius of the ball or
/// disk whose volume or area the cells of the whole ball or disk would fill.
template <class S, class Radius>
Rows<S> with_round_spacing(Rows<S> rows, int S::*core, int S::*shells,
                           const std::string& shells_key, Radius radius) {
  return with_spacing(std::move(rows), {"core", shells_key},
                      "mean size of a cell: core is the radius (of a ball or disk of that size) / "
                      "spacing, an even number, and " +
                          shells_key + " are half as many",
                      [=](S& shape, Real spacing) {
                        const RoundCells cells = round_cells(radius(shape), spacing);
                        shape.*core = cells.core;
                        shape.*shells = cells.shells;
                      });
}

}  // namespace meniscus
