// SPDX-License-Identifier: BSD-3-Clause
// Pieces of the surface of a mesh, and the points that quadratic patches go through.
#include "mesh_surface.hpp"

#include "meniscus/approx/neighbor_search.hpp"
#include "meniscus/body/quadratic_surface.hpp"
#include "meniscus/body/recovered_surface.hpp"
#include "meniscus/body/simplex.hpp"
#include "meniscus/body/surface_points.hpp"
#include "meniscus/core/dense.hpp"
#include "meniscus/core/error.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

namespace meniscus {
namespace {

using Key = std::vector<Index>;

/// A surface whose faces have names; all else is that of another one.
template <int D>
class NamedSurface final : public Surface<D> {
 public:
  NamedSurface(std::shared_ptr<const Surface<D>> surface, std::vector<std::string> names)
      : surface_(std::move(surface)), names_(std::move(names)) {}

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
    return std::make_shared<NamedSurface>(surface_->renumbered(order), names_);
  }
  std::shared_ptr<const Surface<D>> mapped(const SmoothMap<D>& map,
                                           const Grid<D>& grid) const override {
    return std::make_shared<NamedSurface>(surface_->mapped(map, grid), names_);
  }

 private:
  std::shared_ptr<const Surface<D>> surface_;
  std::vector<std::string> names_;
};

Key key_of(Key nodes) {
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

/// What neighbours share: edges of a facet, in the plane its ends.
template <int D>
std::vector<Key> borders(const Facet<D>& facet) {
  if constexpr (D == 2) {
    return {{facet.nodes[0]}, {facet.nodes[1]}};
  } else {
    std::vector<Key> edges;
    for (const auto& [a, b] : {std::pair(0, 1), {1, 3}, {3, 2}, {2, 0}})
      if (Key edge = key_of({at(facet.nodes, a), at(facet.nodes, b)}); edge.size() == 2)
        edges.push_back(std::move(edge));
    return edges;
  }
}

/// Times the area, within a factor.
template <int D>
Vec<D> facet_normal_of(const Facet<D>& facet, const std::vector<Vec<D>>& X) {
  const Vec<D> along = at(X, facet.nodes[1]) - at(X, facet.nodes[0]);
  if constexpr (D == 2) {
    return Vec<2>(along[1], -along[0]);
  } else {
    return cross(at(X, facet.nodes[3]) - at(X, facet.nodes[0]),
                 at(X, facet.nodes[2]) - at(X, facet.nodes[1]));
  }
}

template <int D>
class Pieces {
 public:
  explicit Pieces(const Grid<D>& grid) : grid_(grid) {
    for (std::size_t f = 0; f < grid.facets.size(); ++f) {
      normal_.push_back(facet_normal_of(grid.facets[f], grid.X).normalized());
      for (const Key& border : borders(grid.facets[f])) at_border_[border].push_back(f);
    }
    for (const auto& [border, facets] : at_border_)
      if (D == 3 && is_sharp(border)) {
        sharp_at_[border.front()].push_back(border.back());
        sharp_at_[border.back()].push_back(border.front());
      }
    piece_ = flooded([&](const Key& border) { return !is_sharp(border); });
    part_ = flooded([](const Key&) { return true; });
    find_inner();
  }

  bool is_sharp(const Key& border) const {
    const auto& facets = at_border_.at(border);
    return facets.size() != 2 || at(normal_, facets[0]).dot(at(normal_, facets[1])) < least_cosine;
  }
  bool any_sharp() const {
    return std::any_of(at_border_.begin(), at_border_.end(),
                       [&](const auto& border) { return is_sharp(border.first); });
  }
  int count() const { return 1 + *std::max_element(piece_.begin(), piece_.end()); }
  int of(std::size_t facet) const { return at(piece_, facet); }
  /// Whether a facet is of a closed part of the surface around a cavity.
  bool inner(std::size_t facet) const { return at(inner_, at(part_, facet)); }

  /// The middle of a sharp edge between a and b: of the parabolas through them and the next node
  /// of the curve at either end, if that is there.
  Vec<D> middle_of_curve(Index a, Index b) const {
    const Vec<D>&A = at(grid_.X, a), &B = at(grid_.X, b);
    const Real h = (B - A).norm();
    Vec<D> bend = Vec<D>::Zero();  // 1/8 of the second derivative over an edge
    int found = 0;
    for (const auto& [end, other] : {std::pair(a, b), std::pair(b, a)})
      if (const auto next = next_on_curve(end, other)) {
        const Vec<D> on = (at(grid_.X, *next) - at(grid_.X, end)),
                     back = at(grid_.X, other) - at(grid_.X, end);
        const Real l = on.norm();
        bend += 2 * h * h / (h + l) * (on / l + back / h) / 8;
        ++found;
      }
    return 0.5 * (A + B) - (found ? Vec<D>(bend / found) : bend);
  }

 private:
  std::vector<int> flooded(const auto& passes) const {
    std::vector<int> number(grid_.facets.size(), -1);
    int count = 0;
    for (std::size_t first = 0; first < number.size(); ++first) {
      if (number[first] >= 0) continue;
      std::vector<std::size_t> open{first};
      number[first] = count;
      while (!open.empty()) {
        const std::size_t f = open.back();
        open.pop_back();
        for (const Key& border : borders(grid_.facets[f])) {
          if (!passes(border)) continue;
          for (const std::size_t other : at_border_.at(border))
            if (number[other] < 0) {
              number[other] = count;
              open.push_back(other);
            }
        }
      }
      ++count;
    }
    return number;
  }

  void find_inner() {
    std::vector<Real> volume(
        static_cast<std::size_t>(1 + *std::max_element(part_.begin(), part_.end())), 0.0);
    for (std::size_t f = 0; f < grid_.facets.size(); ++f) {
      Vec<D> middle = Vec<D>::Zero();
      for (const Index node : grid_.facets[f].nodes) middle += at(grid_.X, node);
      at(volume, part_[f]) +=
          facet_normal_of(grid_.facets[f], grid_.X).dot(middle / (1 << (D - 1)) - grid_.X.front());
    }
    for (const Real v : volume) inner_.push_back(v < 0);
  }

  /// The node with which a sharp curve goes on beyond `end`, not around a corner.
  std::optional<Index> next_on_curve(Index end, Index from) const {
    const std::vector<Index>& beside = sharp_at_.at(end);
    if (beside.size() != 2) return {};
    const Index next = beside[0] == from ? beside[1] : beside[0];
    const Vec<D> ahead = at(grid_.X, end) - at(grid_.X, from),
                 further = at(grid_.X, next) - at(grid_.X, end);
    if (further.normalized().dot(ahead.normalized()) < least_cosine) return {};
    return next;
  }

  static constexpr Real least_cosine = 0.643;  // of 50 degrees
  const Grid<D>& grid_;
  std::vector<Vec<D>> normal_;
  std::map<Key, std::vector<std::size_t>> at_border_;
  std::map<Index, std::vector<Index>> sharp_at_;  ///< 3D: nodes beside a node on sharp edges
  std::vector<int> piece_, part_;
  std::vector<char> inner_;
};

/// Each piece recovered by itself; `f` is a facet of the grid.
template <int D>
class RecoveredPieces {
 public:
  RecoveredPieces(const Grid<D>& grid, const Pieces<D>& pieces) : pieces_(pieces) {
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
  const Pieces<D>& pieces_;
  std::vector<Grid<D>> grids_;
  std::vector<std::shared_ptr<const RecoveredSurface<D>>> surfaces_;
};

/// The middle of a facet whose edges have middles: that of the serendipity patch, of a triangle of
/// that through its six points, at the middle of the collapsed square.
Vec<3> middle_of_facet(const Facet<3>& facet, const std::vector<Vec<3>>& X,
                       const std::map<Key, Vec<3>>& middle) {
  const auto& n = facet.nodes;
  const auto between = [&](int a, int b) { return middle.at(key_of({at(n, a), at(n, b)})); };
  if (n[2] == n[3])
    return -0.125 * (at(X, n[0]) + at(X, n[1])) + 0.25 * between(0, 1) +
           0.5 * (between(0, 2) + between(1, 2));
  return -0.25 * (at(X, n[0]) + at(X, n[1]) + at(X, n[2]) + at(X, n[3])) +
         0.5 * (between(0, 1) + between(1, 3) + between(3, 2) + between(2, 0));
}

/// The points of quadratic patches, by their keys: those of the file if it has all middles of
/// edges.
template <int D>
std::map<Key, Vec<D>> patch_points(const Grid<D>& grid, const Pieces<D>& pieces,
                                   const MeshSurface<D>& given, bool second_order) {
  std::optional<RecoveredPieces<D>> recovered;
  if (!second_order) recovered.emplace(grid, pieces);
  std::map<Key, Vec<D>> points;
  for (std::size_t f = 0; f < grid.facets.size(); ++f) {
    const Facet<D>& facet = grid.facets[f];
    Vec<D> bulge = Vec<D>::Zero();  // of the middle, with edges that are curves
    for (int a = 0; a < PatchFunctions<D>::nodes; ++a) {
      const Vec<D - 1> xi = patch_node<D>(a);
      const Key key = patch_key(facet, xi);
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
      const Key key = patch_key(facet, Vec<2>(0, 0));
      const auto middle = given.middle.find(key);
      points[key] = !second_order ? Vec<3>(recovered->point(f, facet, Vec<2>(0, 0)) + bulge)
                    : middle != given.middle.end() ? middle->second
                                                   : middle_of_facet(facet, grid.X, points);
    }
  }
  return points;
}

/// Whether the file has the middles of all edges of the surface.
template <int D>
bool has_middles(const Grid<D>& grid, const MeshSurface<D>& given) {
  return std::all_of(grid.facets.begin(), grid.facets.end(), [&](const Facet<D>& facet) {
    std::vector<Key> edges = borders(facet);
    if (D == 2) edges = {key_of({facet.nodes[0], facet.nodes[1]})};
    return std::all_of(edges.begin(), edges.end(),
                       [&](const Key& key) { return given.middle.count(key) > 0; });
  });
}

/// Numbers the patches of the facets and returns their names.
template <int D>
std::vector<std::string> name_faces(Grid<D>& grid, const Pieces<D>& pieces,
                                    const MeshSurface<D>& given) {
  std::map<std::pair<int, std::string>, int> patch;
  std::vector<std::string> names;
  for (std::size_t f = 0; f < grid.facets.size(); ++f) {
    Facet<D>& facet = grid.facets[f];
    const auto named = given.face.find(key_of({facet.nodes.begin(), facet.nodes.end()}));
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

/// Of a place, the normal of the outer surface where that is nearest.
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

}  // namespace

template <int D>
Geometry<D> mesh_geometry(Grid<D> grid, const MeshSurface<D>& given) {
  find_boundary(grid);
  const Pieces<D> pieces(grid);
  std::vector<std::string> names = name_faces(grid, pieces, given);
  const bool second_order = has_middles(grid, given), sharp = pieces.any_sharp();
  std::shared_ptr<const Surface<D>> surface;
  if (!second_order && !sharp) surface = RecoveredSurface<D>::if_smooth(grid);
  if (!surface) {
    const auto by_key = patch_points(grid, pieces, given, second_order);
    const PatchNodes<D> nodes(grid);
    std::vector<Vec<D>> points(static_cast<std::size_t>(nodes.count()));
    for (const auto& [key, number] : nodes.number) at(points, number) = by_key.at(key);
    std::vector<char> inner(names.size(), 0);
    for (std::size_t f = 0; f < grid.facets.size(); ++f)
      at(inner, grid.facets[f].patch) = pieces.inner(f);
    surface = std::make_shared<QuadraticSurface<D>>(grid, points, second_order && !sharp,
                                                    std::move(inner));
  }
  Geometry<D> geometry{std::move(grid),
                       std::make_shared<NamedSurface<D>>(std::move(surface), std::move(names))};
  curve_boundary(geometry);
  check_jacobians(geometry.grid, "the surface");
  if (geometry.surface->hollow()) geometry.director = outer_normal(geometry);
  return geometry;
}

#define MENISCUS_INSTANTIATE(D) template Geometry<D> mesh_geometry(Grid<D>, const MeshSurface<D>&);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
