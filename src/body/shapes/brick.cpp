// SPDX-License-Identifier: BSD-3-Clause
// Box and rectangle.
#include "meniscus/body/shapes.hpp"
#include "meniscus/core/error.hpp"

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

/// A row that is read only if its key is there, for one of two alternative keys.
template <class M, class Read>
Row<M> alternative_row(std::string key, std::string type, Dimension dimension, std::string meaning,
                       Read read) {
  Row<M> row;
  row.key = key;
  row.type = std::move(type);
  row.unit = UnitSystem().symbol(dimension);
  row.meaning = std::move(meaning);
  row.dimension = dimension;
  row.read = [key = std::move(key), read](M& m, const Block& block) {
    if (block.has(key)) read(m, block);
  };
  return row;
}

const bool registered = register_shape<3, Brick<3>>() && register_shape<2, Brick<2>>();

}  // namespace

template <int D>
Rows<Brick<D>> Brick<D>::rows() {
  const std::string numbers = std::to_string(D) + " numbers";
  return {
      reals_row("size", &Brick::size, D, dimension::length, range::positive, "edge lengths"),
      alternative_row<Brick>("cells", numbers, dimension::none,
                             "cells per direction; this or spacing",
                             [](Brick& m, const Block& block) {
                               m.cells = block.reals("cells", D, dimension::none, {1, 1e6}, {});
                             }),
      alternative_row<Brick>(
          "spacing", "number", dimension::length, "largest edge of a cell; this or cells",
          [](Brick& m, const Block& block) {
            m.spacing = block.real("spacing", dimension::length, range::positive, {});
          }),
      alternative_row<Brick>("corner", numbers, dimension::length, "lowest corner; this or centre",
                             [](Brick& m, const Block& block) {
                               m.corner =
                                   block.reals("corner", D, dimension::length, range::any, {});
                             }),
      alternative_row<Brick>(
          "centre", numbers, dimension::length, "centre, default the origin; this or corner",
          [](Brick& m, const Block& block) {
            m.centre = block.reals("centre", D, dimension::length, range::any, {});
          })};
}

template <int D>
Geometry<D> Brick<D>::geometry() const {
  if (cells.empty() == (spacing <= 0))
    throw InputError("Give either the cells per direction or the spacing.");
  std::array<Index, D> count;
  Vec<D> edges, middle;
  std::vector<SurfacePatch<D>> planes;
  for (int k = 0; k < D; ++k) {
    edges[k] = at(size, k);
    // The tolerance keeps a spacing that divides the edge from yielding one cell more.
    const Real wanted = cells.empty() ? std::ceil(at(size, k) / spacing - 1e-9) : at(cells, k);
    if (!(wanted >= 1 && wanted <= 1e6) || wanted != std::floor(wanted))
      throw InputError("The number of cells per direction must be whole, from 1 to 1e6.");
    at(count, k) = static_cast<Index>(wanted);
    middle[k] = corner.empty() ? at(centre, k) : at(corner, k) + 0.5 * edges[k];
    const Vec<D> e = Vec<D>::Unit(k);
    planes.push_back(SurfacePatch<D>::plane(-0.5 * e, -e));
    planes.push_back(SurfacePatch<D>::plane(0.5 * e, e));
  }
  return make_geometry<D>(unit_brick<D>(count), std::move(planes), false,
                          affine_map<D>(edges.asDiagonal(), middle));
}

template struct Brick<2>;
template struct Brick<3>;

}  // namespace meniscus
