// SPDX-License-Identifier: BSD-3-Clause
// The surface of a mesh: names of its faces, and the nodes of its quadratic patches.
#include "body/mesh/mesh_surface.hpp"

#include "body/grid/curved_facets.hpp"
#include "body/grid/simplex.hpp"
#include "body/mesh/mesh_pieces.hpp"
#include "body/mesh/mesh_regions.hpp"
#include "body/surface/quadratic_surface.hpp"
#include "body/surface/recovered_surface.hpp"
#include "body/surface/surface_points.hpp"
#include "kernel/neighbor_search.hpp"
#include "numbers/dense.hpp"
#include "parallel/parallel.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

namespace meniscus {
namespace {

/// A surface with names for its faces; another surface gives its geometry.
template <int D>
class NamedSurface final : public Surface<D> {
 public:
  NamedSurface(std::shared_ptr<const Surface<D>> surface, std::vector<std::string> names,
               CurvedFacets curved, std::shared_ptr<const MeshRegions> regions)
      : surface_(std::move(surface)),
        names_(std::move(names)),
        curved_(curved),
        regions_(std::move(regions)) {}

  CurvedFacets curved() const { return curved_; }
  const MeshRegions* regions() const { return regions_.get(); }

  SurfacePoints<D> points(const Grid<D>& grid, int k, SurfacePart part) const override {
    return surface_->points(grid, k, part);
  }
  Vec<D> point(const Grid<D>& grid, const Facet<D>& facet, const Vec<D - 1>& xi) const override {
    return surface_->point(grid, facet, xi);
  }
  bool smooth() const override { return surface_->smooth(); }
  bool hollow() const override { return surface_->hollow(); }
  std::string face_name(int patch) const override { return at(names_, patch); }
  std::shared_ptr<const Surface<D>> renumbered(std::span<const Index> order) const override {
    std::shared_ptr<MeshRegions> regions;
    if (regions_) {
      regions = std::make_shared<MeshRegions>(*regions_);
      regions->share.clear();
      for (const Index node : order)
        for (const Real share : regions_->at_node(node)) regions->share.push_back(share);
    }
    return std::make_shared<NamedSurface>(surface_->renumbered(order), names_, curved_,
                                          std::move(regions));
  }
  std::shared_ptr<const Surface<D>> mapped(const SmoothMap<D>& map,
                                           const Grid<D>& grid) const override {
    return std::make_shared<NamedSurface>(surface_->mapped(map, grid), names_, curved_, regions_);
  }

 private:
  std::shared_ptr<const Surface<D>> surface_;
  std::vector<std::string> names_;
  CurvedFacets curved_;
  std::shared_ptr<const MeshRegions> regions_;  // null: none
};

/// Recovers a smooth surface for each piece by itself. `f` is a facet of the grid.
template <int D>
class RecoveredPieces {
 public:
  RecoveredPieces(const Grid<D>& grid, const MeshPieces<D>& pieces) : pieces_(pieces) {
    grids_.resize(static_cast<std::size_t>(pieces.count()));
    for (std::size_t f = 0; f < grid.facets.size(); ++f)
      at(grids_, pieces.of(f)).facets.push_back(grid.facets[f]);
    for (Grid<D>& piece : grids_) {
      piece.X = grid.X;
      surfaces_.push_back(RecoveredSurface<D>::of_piece(piece));
    }
  }
  Vec<D> point(std::size_t f, const Facet<D>& facet, const Vec<D - 1>& xi) const {
    const int piece = pieces_.of(f);
    return at(surfaces_, piece)->point(at(grids_, piece), facet, xi);
  }

 private:
  const MeshPieces<D>& pieces_;
  std::vector<Grid<D>> grids_;
  std::vector<std::shared_ptr<const RecoveredSurface<D>>> surfaces_;
};

/// Middle of a facet, interpolated from its corners and the middles of its edges: by the
/// serendipity patch of a quadrilateral, or by the six-node patch of a triangle at the centre of
/// its collapsed square.
Vec<3> middle_of_facet(const Facet<3>& facet, const std::vector<Vec<3>>& X,
                       const std::map<MeshKey, Vec<3>>& middle) {
  const auto& n = facet.nodes;
  const auto between = [&](int a, int b) { return middle.at(mesh_key({at(n, a), at(n, b)})); };
  if (n[2] == n[3])
    return -0.125 * (at(X, n[0]) + at(X, n[1])) + 0.25 * between(0, 1) +
           0.5 * (between(0, 2) + between(1, 2));
  return -0.25 * (at(X, n[0]) + at(X, n[1]) + at(X, n[2]) + at(X, n[3])) +
         0.5 * (between(0, 1) + between(1, 3) + between(3, 2) + between(2, 0));
}

/// Nodes of quadratic patches by their keys.
template <int D>
using PatchPoints = std::map<MeshKey, Vec<D>>;

/// Patch nodes of straight edges and of the facets between them.
template <int D>
PatchPoints<D> flat_points(const Grid<D>& grid) {
  PatchPoints<D> points;
  for (const Facet<D>& facet : grid.facets)
    for (int a = 0; a < PatchFunctions<D>::nodes; ++a) {
      const MeshKey key = patch_key(facet, patch_node<D>(a));
      if (key.size() <= 2) points[key] = 0.5 * (at(grid.X, key.front()) + at(grid.X, key.back()));
    }
  if constexpr (D == 3)
    for (const Facet<3>& facet : grid.facets)
      points[patch_key(facet, Vec<2>(0, 0))] = middle_of_facet(facet, grid.X, points);
  return points;
}

/// Patch nodes by their keys. They come from the file if it has the middles of all edges; otherwise
/// they are recovered.
template <int D>
PatchPoints<D> patch_points(const Grid<D>& grid, const MeshPieces<D>& pieces,
                            const MeshSurface<D>& given, bool second_order) {
  std::optional<RecoveredPieces<D>> recovered;
  if (!second_order) recovered.emplace(grid, pieces);
  PatchPoints<D> points;
  for (std::size_t f = 0; f < grid.facets.size(); ++f) {
    const Facet<D>& facet = grid.facets[f];
    Vec<D> bulge = Vec<D>::Zero();  // shift of the middle by curved edges
    for (int a = 0; a < PatchFunctions<D>::nodes; ++a) {
      const Vec<D - 1> xi = patch_node<D>(a);
      const MeshKey key = patch_key(facet, xi);
      if (key.size() == 1) {
        points[key] = at(grid.X, key[0]);
      } else if (key.size() == 2) {
        if (second_order)
          points[key] = given.middle.at(key);
        else if (D == 3 && pieces.is_sharp(key))
          points[key] = pieces.middle_of_curve(key[0], key[1]);
        else if (points.find(key) == points.end())
          points[key] = recovered->point(f, facet, xi);
        if (!second_order) bulge += 0.5 * (points[key] - recovered->point(f, facet, xi));
      }
    }
    if constexpr (D == 3) {
      const MeshKey key = patch_key(facet, Vec<2>(0, 0));
      const auto middle = given.middle.find(key);
      points[key] = !second_order ? Vec<3>(recovered->point(f, facet, Vec<2>(0, 0)) + bulge)
                    : middle != given.middle.end() ? middle->second
                                                   : middle_of_facet(facet, grid.X, points);
    }
  }
  return points;
}

/// True if the file has the middles of all surface edges.
template <int D>
bool has_middles(const Grid<D>& grid, const MeshSurface<D>& given) {
  return std::all_of(grid.facets.begin(), grid.facets.end(), [&](const Facet<D>& facet) {
    std::vector<MeshKey> edges = facet_borders(facet);
    if (D == 2) edges = {mesh_key({facet.nodes[0], facet.nodes[1]})};
    return std::all_of(edges.begin(), edges.end(),
                       [&](const MeshKey& key) { return given.middle.count(key) > 0; });
  });
}

/// Gives the facets the number of their patch and returns the names of the patches.
template <int D>
std::vector<std::string> name_faces(Grid<D>& grid, const MeshPieces<D>& pieces,
                                    const MeshSurface<D>& given) {
  std::map<std::pair<int, std::string>, int> patch;
  std::vector<std::string> names;
  for (std::size_t f = 0; f < grid.facets.size(); ++f) {
    Facet<D>& facet = grid.facets[f];
    const auto named = given.face.find(mesh_key({facet.nodes.begin(), facet.nodes.end()}));
    const std::string name = named != given.face.end() ? named->second : "";
    const auto [found, is_new] =
        patch.try_emplace({pieces.of(f), name}, static_cast<int>(names.size()));
    if (is_new) names.push_back(name);
    facet.patch = found->second;
  }
  const bool any = std::any_of(names.begin(), names.end(),
                               [](const std::string& name) { return !name.empty(); });
  for (std::size_t k = 0; !any && k < names.size(); ++k)
    names[k] = names.size() == 1 ? "surface" : fmt::format("face_{}", k + 1);
  return names;
}

/// Returns a function of a position X: the normal of the outer surface at its point nearest to X.
template <int D>
std::function<Vec<D>(const Vec<D>&)> outer_normal(const Geometry<D>& geometry) {
  const auto outer =
      std::make_shared<const SurfacePoints<D>>(surface_points(geometry, 3, SurfacePart::outer));
  const auto search = std::make_shared<const NeighborSearch<D>>(outer->X);
  return [outer, search](const Vec<D>& X) -> Vec<D> {
    std::vector<Index> near;
    search->within(X, search->distance_of_nearest(X, 1) * (1 + 1e-9), near);
    return at(outer->N, near.front());
  };
}

/// Surface cells that are folded (their Jacobian is not positive everywhere).
template <int D>
std::vector<Index> folded_cells(const Grid<D>& grid) {
  std::vector<char> is_folded(grid.cells.size(), 0);
  parallel_for(grid.cell_count(), [&](Index e) {
    if (grid.bulge(e)) at(is_folded, e) = find_fold(grid, e).has_value();
  });
  std::vector<Index> folded;
  for (Index e = 0; e < grid.cell_count(); ++e)
    if (at(is_folded, e)) folded.push_back(e);
  return folded;
}

/// Straightens the surface edges of folded cells and adds the facets of these edges to
/// `straightened`. Returns false if all of them were straight already.
template <int D>
bool straighten(const Grid<D>& grid, const std::vector<Index>& folded, PatchPoints<D>& points,
                std::set<std::size_t>& straightened) {
  std::set<MeshKey> between;  // pairs of nodes of a folded cell
  for (const Index e : folded)
    for (const Index a : at(grid.cells, e))
      for (const Index b : at(grid.cells, e))
        if (a < b) between.insert({a, b});
  bool changed = false;
  for (std::size_t f = 0; f < grid.facets.size(); ++f) {
    const Facet<D>& facet = grid.facets[f];
    bool any = false;
    for (int a = 0; a < PatchFunctions<D>::nodes; ++a) {
      const MeshKey key = patch_key(facet, patch_node<D>(a));
      if (key.size() != 2 || between.count(key) == 0) continue;
      const Vec<D> middle = 0.5 * (at(grid.X, key[0]) + at(grid.X, key[1]));
      changed = changed || points[key] != middle;
      points[key] = middle;
      any = true;
    }
    if (!any) continue;
    straightened.insert(f);
  }
  if constexpr (D == 3)
    for (const std::size_t f : straightened) {
      Vec<3>& point = points[patch_key(grid.facets[f], Vec<2>(0, 0))];
      const Vec<3> middle = middle_of_facet(grid.facets[f], grid.X, points);
      changed = changed || point != middle;
      point = middle;
    }
  return changed;
}

/// The body whose surface consists of quadratic patches through these nodes.
template <int D>
Geometry<D> geometry_of_patches(const Grid<D>& grid, const PatchPoints<D>& by_key, bool smooth,
                                const std::vector<char>& inner) {
  const PatchNodes<D> nodes(grid);
  std::vector<Vec<D>> points(static_cast<std::size_t>(nodes.count()));
  for (const auto& [key, number] : nodes.number) at(points, number) = by_key.at(key);
  Geometry<D> geometry{grid, std::make_shared<QuadraticSurface<D>>(grid, points, smooth, inner)};
  curve_boundary(geometry);
  return geometry;
}

}  // namespace

template <int D>
Geometry<D> mesh_geometry(Grid<D> grid, const MeshSurface<D>& given, MeshFacets facets) {
  find_boundary(grid);
  const MeshPieces<D> pieces(grid);
  std::vector<std::string> names = name_faces(grid, pieces, given);
  const bool flat = facets == MeshFacets::flat, second_order = !flat && has_middles(grid, given),
             sharp = pieces.any_sharp();
  std::set<std::size_t> straightened;
  Geometry<D> geometry;
  if (!flat && !second_order && !sharp) {
    geometry = {grid, RecoveredSurface<D>::if_smooth(grid)};
    if (geometry.surface) curve_boundary(geometry);
  }
  if (!geometry.surface || !folded_cells(geometry.grid).empty()) {
    PatchPoints<D> points =
        flat ? flat_points(grid) : patch_points(grid, pieces, given, second_order);
    std::vector<char> inner(names.size(), 0);
    for (std::size_t f = 0; f < grid.facets.size(); ++f)
      at(inner, grid.facets[f].patch) = pieces.inner(f);
    const bool smooth = second_order && !sharp;
    geometry = geometry_of_patches(grid, points, smooth, inner);
    // Every pass straightens at least one edge, so the loop ends.
    for (auto folded = folded_cells(geometry.grid);
         !folded.empty() && straighten(grid, folded, points, straightened);
         folded = folded_cells(geometry.grid))
      geometry = geometry_of_patches(grid, points, false, inner);
  }
  check_jacobians(geometry.grid, "the surface");
  std::shared_ptr<const MeshRegions> regions;
  if (!given.regions.empty())
    regions = std::make_shared<MeshRegions>(
        regions_of_cells(geometry.grid, given.regions, given.region_of));
  CurvedFacets curved{static_cast<Index>(straightened.size())};
  if (!second_order) curved.added_volume = volume(geometry.grid) / volume(grid) - 1;
  geometry.surface = std::make_shared<NamedSurface<D>>(geometry.surface, std::move(names), curved,
                                                       std::move(regions));
  if (geometry.surface->hollow()) geometry.director = outer_normal(geometry);
  return geometry;
}

template <int D>
CurvedFacets curved_facets(const Geometry<D>& geometry) {
  const auto* surface = dynamic_cast<const NamedSurface<D>*>(geometry.surface.get());
  return surface ? surface->curved() : CurvedFacets{};
}

template <int D>
const MeshRegions* mesh_regions(const Geometry<D>& geometry) {
  const auto* surface = dynamic_cast<const NamedSurface<D>*>(geometry.surface.get());
  return surface ? surface->regions() : nullptr;
}

#define MENISCUS_INSTANTIATE(D)                                                   \
  template Geometry<D> mesh_geometry(Grid<D>, const MeshSurface<D>&, MeshFacets); \
  template CurvedFacets curved_facets(const Geometry<D>&);                        \
  template const MeshRegions* mesh_regions(const Geometry<D>&);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
