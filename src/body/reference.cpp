// SPDX-License-Identifier: BSD-3-Clause
// Reference configurations of bodies, and the part of them that checkpoints store.
#include "body/reference.hpp"

#include "body/grid/nodal_cells.hpp"
#include "body/surface/quadratic_surface.hpp"
#include "body/surface/recovered_surface.hpp"

#include <algorithm>
#include <utility>

namespace meniscus {
namespace {

template <int D>
void archive_places(const Archive& a, std::string_view name, std::vector<Vec<D>>& places) {
  std::vector<Real> packed;
  packed.reserve(places.size() * D);
  for (const Vec<D>& X : places) packed.insert(packed.end(), X.data(), X.data() + D);
  a(name, packed, dimension::length);
  for (std::size_t i = 0; i < places.size(); ++i)
    places[i] = Eigen::Map<const Vec<D>>(packed.data() + i * D);
}

}  // namespace

template <int D>
Geometry<D> moved(const Geometry<D>& geometry, std::vector<Vec<D>> X, bool recovered) {
  Geometry<D> result = geometry;
  result.grid.X = std::move(X);
  if (recovered) return recovered_geometry(std::move(result.grid));
  curve_boundary(result);
  check_jacobians(result.grid, "the new reference");
  return result;
}

template <int D>
Reference<D> Reference<D>::of_scene(Geometry<D> geometry, Real mass) {
  Reference reference;
  reference.origin = geometry.grid.X;
  const NodalCells<D> cells(geometry.grid);
  for (Index A = 0; A < cells.size(); ++A) reference.cell_origin.push_back(cells.centroid(A));
  reference.volume_ratio.assign(geometry.grid.X.size(), 1.0);
  reference.geometry = std::move(geometry);
  reference.mass = mass;
  return reference;
}

template <int D>
bool Reference<D>::undeformed() const {
  return std::all_of(volume_ratio.begin(), volume_ratio.end(), [](Real J) { return J == 1; });
}

template <int D>
void Reference<D>::archive(const Archive& a) {
  std::vector<Vec<D>> X = geometry.grid.X;
  a("recovered", recovered);
  archive_places(a, "X", X);
  archive_places(a, "origin", origin);
  archive_places(a, "cell_origin", cell_origin);
  a("volume_ratio", volume_ratio);
  a("mass", mass, of_sum(dimension::mass, D));
  if (a.is_reading() ? a.has("surface") : !surface.empty()) {
    if (a.is_reading())
      surface.resize(static_cast<std::size_t>(PatchNodes<D>(geometry.grid).count()));
    archive_places(a.in("surface"), "points", surface);
  }
  if (!a.is_reading()) return;
  if (surface.empty()) {
    geometry = moved(geometry, std::move(X), recovered);
  } else {
    geometry.grid.X = std::move(X);
    geometry = quadratic_geometry(std::move(geometry.grid), surface, geometry.surface->smooth());
  }
}

#define MENISCUS_INSTANTIATE(D) \
  template struct Reference<D>; \
  template Geometry<D> moved(const Geometry<D>&, std::vector<Vec<D>>, bool);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
