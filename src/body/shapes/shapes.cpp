// SPDX-License-Identifier: BSD-3-Clause
// Reading the geometry of a body.
#include "meniscus/body/shapes.hpp"

#include "body/imperfection.hpp"
#include "body/shapes/half_plane.hpp"
#include "body/shapes/placement.hpp"
#include "meniscus/error.hpp"

namespace meniscus {

namespace {

/// A substitute for a body that cannot be made, to search for further problems of the scene.
template <int D>
Geometry<D> stand_in() {
  Brick<D> brick;
  brick.cells.assign(D, 2);
  return brick.geometry();
}

}  // namespace

template <int D>
Geometry<D> read_geometry(const Block& block, bool revolved) {
  const auto name = block.kind("shape", shapes<D>().names());
  const Real jitter = block.real("jitter", dimension::none, {0, 0.5}, 0.0);
  const auto seed = block.integer("jitter_seed", range::non_negative, 1);
  const Real imperfection = block.real("imperfection", dimension::length, range::non_negative, 0.0);
  const auto imperfection_seed = block.integer("imperfection_seed", range::non_negative, 1);
  if (revolved && imperfection > 0)
    block.problem("imperfection", "is not of revolution; allowed is a map");
  if (!name) return stand_in<D>();
  try {
    auto made = shapes<D>().at(*name).make(block);
    if (!made) return read_placement(block, stand_in<D>());  // reading marks the keys as known
    Geometry<D> geometry = read_placement(block, *std::move(made));
    if (!block.in_order()) return stand_in<D>();
    if constexpr (D == 2)
      if (revolved) geometry = half_plane(std::move(geometry));
    if (imperfection > 0)
      geometry = with_imperfection(std::move(geometry), imperfection,
                                   static_cast<std::uint64_t>(imperfection_seed));
    if (jitter > 0) jitter_interior(geometry.grid, jitter, static_cast<std::uint64_t>(seed));
    return geometry;
  } catch (const InputError& error) {
    block.problem("shape", error.what());
    return read_placement(block, stand_in<D>());
  }
}

template Geometry<2> read_geometry(const Block&, bool);
template Geometry<3> read_geometry(const Block&, bool);

}  // namespace meniscus
