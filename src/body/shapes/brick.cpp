// SPDX-License-Identifier: BSD-3-Clause
// Box and rectangle.
#include "body/shapes/cell_count.hpp"
#include "meniscus/body/shapes.hpp"
#include "meniscus/error.hpp"

#include <cmath>

namespace meniscus {

namespace {

/// [-1/2, 1/2]^D with the given cells per direction; node and cell numbers grow fastest with x.
template <int D>
Grid<D> unit_brick(const std::array<Index, D>& cells) {
  Grid<D> grid;
  const auto for_lattice = [&](int extra, auto&& f) {
    std::array<Index, D> p{};
    for (int k = 0; k < D;) {
      f(p);
      for (k = 0; k < D && ++at(p, k) == at(cells, k) + extra; ++k) at(p, k) = 0;
    }
  };
  for_lattice(1, [&](const std::array<Index, D>& p) {
    Vec<D> X;
    for (int k = 0; k < D; ++k) X[k] = Real(at(p, k)) / at(cells, k) - 0.5;
    grid.X.push_back(X);
  });
  for_lattice(0, [&](const std::array<Index, D>& p) {
    typename Grid<D>::Cell cell;
    for (int a = 0; a < Grid<D>::corners; ++a) {
      Index node = 0;
      for (int k = D - 1; k >= 0; --k) node = node * (at(cells, k) + 1) + at(p, k) + ((a >> k) & 1);
      at(cell, a) = node;
    }
    grid.cells.push_back(cell);
  });
  return grid;
}

/// A row that is read only if its key is there: for one of two alternative keys.
template <class M, class Read>
Row<M> alternative_row(std::string key, std::string type, Dimension dimension, Range allowed,
                       std::string fallback, std::string meaning, Read read) {
  Row<M> row;
  row.key = key;
  row.type = std::move(type);
  row.unit = rows::si_symbol(dimension);
  row.range = allowed.text();
  row.fallback = std::move(fallback);
  row.meaning = std::move(meaning);
  row.read = [=](M& m, const Block& block) {
    if (block.has(key)) read(m, block, allowed);
  };
  return row;
}

const bool brick_registered = register_shape<3, Brick<3>>() && register_shape<2, Brick<2>>();

}  // namespace

template <int D>
Rows<Brick<D>> Brick<D>::rows() {
  constexpr Range count{1, 1e6};
  const auto list = [](const char* key, std::vector<Real> Brick::*member, Dimension unit,
                       Range allowed, const char* fallback, const char* meaning) {
    return alternative_row<Brick>(key, rows::counted(D, "numbers"), unit, allowed, fallback,
                                  meaning, [=](Brick& m, const Block& block, Range r) {
                                    m.*member = block.reals(key, D, unit, r, {});
                                  });
  };
  return {reals_row("size", &Brick::size, D, dimension::length, range::positive, "edge lengths"),
          list("cells", &Brick::cells, dimension::none, count, "by spacing",
               "cells per direction; either this or spacing"),
          alternative_row<Brick>("spacing", "number", dimension::length, range::positive,
                                 "by cells", "largest edge of a cell; either this or cells",
                                 [](Brick& m, const Block& block, Range r) {
                                   m.spacing = block.real("spacing", dimension::length, r, {});
                                 }),
          list("corner", &Brick::corner, dimension::length, range::any, "by centre",
               "lowest corner; either this or centre"),
          list("centre", &Brick::centre, dimension::length, range::any, "origin",
               "centre; either this or corner")};
}

template <int D>
Geometry<D> Brick<D>::geometry() const {
  if (cells.empty() == (spacing <= 0))
    throw InputError("give either the cells per direction or the spacing");
  if (!corner.empty() && !centre.empty())
    throw InputError("give either the corner or the centre, not both");
  std::array<Index, D> count;
  Vec<D> edges, middle;
  Real total = 1;
  std::vector<SurfacePatch<D>> planes;
  for (int k = 0; k < D; ++k) {
    edges[k] = at(size, k);
    const Real wanted = cells.empty() ? cells_along(at(size, k), spacing) : at(cells, k);
    if (!(wanted >= 1 && wanted <= 1e6) || wanted != std::floor(wanted))
      throw InputError("the number of cells per direction must be whole, from 1 to 1e6");
    at(count, k) = static_cast<Index>(wanted);
    middle[k] = centre.empty() ? 0 : at(centre, k);
    if (!corner.empty()) middle[k] = at(corner, k) + 0.5 * edges[k];
    total *= wanted;
    const Vec<D> e = Vec<D>::Unit(k);
    const std::string axis(1, "xyz"[k]);
    planes.push_back(SurfacePatch<D>::plane(-0.5 * e, -e).named(axis + "_min"));
    planes.push_back(SurfacePatch<D>::plane(0.5 * e, e).named(axis + "_max"));
  }
  require_affordable<D>(total);
  return make_geometry<D>(unit_brick<D>(count), std::move(planes), false,
                          affine_map<D>(edges.asDiagonal(), middle));
}

template struct Brick<2>;
template struct Brick<3>;

}  // namespace meniscus
