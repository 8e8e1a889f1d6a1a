// SPDX-License-Identifier: BSD-3-Clause
// Places the nodes of a grid along the present surface and inside it.
#include "remap/reseed.hpp"

#include "body/grid/gauss.hpp"
#include "body/surface/quadratic_surface.hpp"
#include "numbers/dense.hpp"
#include "remap/edges.hpp"
#include "remap/moving_nodes.hpp"
#include "remap/ring_at_line.hpp"
#include "solve/linear/sparse_factors.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

namespace meniscus {
namespace {

/// Solves A x = b for vectors b_i and x_i. A is symmetric and positive definite.
template <int D>
std::vector<Vec<D>> solved(const SparseCholesky& A, const std::vector<Vec<D>>& b) {
  std::vector<Vec<D>> x(b.size());
  std::vector<Real> component(b.size());
  for (int k = 0; k < D; ++k) {
    for (std::size_t i = 0; i < b.size(); ++i) component[i] = b[i][k];
    A.solve(component);
    for (std::size_t i = 0; i < b.size(); ++i) x[i][k] = component[i];
  }
  return x;
}

/// Nodes of quadratic patches between the nodes of the grid, fitted to the present surface by least
/// squares.
template <int D>
std::vector<Vec<D>> fitted_patches(const Grid<D>& grid, const PresentSurface<D>& surface,
                                   const MovingNodes<D>& nodes) {
  constexpr int samples = 4, rounds = 4;
  const PatchNodes<D> numbered(grid);
  std::vector<Vec<D>> points(static_cast<std::size_t>(numbered.count()));
  for (const auto& [key, number] : numbered.number) {
    Vec<D> sum = Vec<D>::Zero();
    for (const Index node : key) sum += at(nodes.x(), node) / static_cast<Real>(key.size());
    at(points, number) = surface.nearest(sum, nodes.foot(key.front()).patch).x;
  }
  const std::vector<PatchFunctions<D>> at_sample = patch_functions<D>(samples);
  std::vector<MatrixEntry> entries;
  std::vector<Real> weight;
  for (std::size_t f = 0; f < grid.facets.size(); ++f) {
    weight.push_back(area_of(grid.facets[f], nodes.x()).norm());
    const auto& patch = numbered.facet[f];
    for (const PatchFunctions<D>& s : at_sample)
      for (std::size_t a = 0; a < patch.size(); ++a)
        for (std::size_t b = 0; b < patch.size(); ++b)
          entries.push_back({patch[a], patch[b], weight[f] * s.weight * s.L[a] * s.L[b]});
  }
  const SparseCholesky mass(numbered.count(), entries);
  for (int round = 0; round < rounds; ++round) {
    std::vector<Vec<D>> right(points.size(), Vec<D>::Zero());
    for (std::size_t f = 0; f < grid.facets.size(); ++f) {
      const auto& patch = numbered.facet[f];
      for (const PatchFunctions<D>& s : at_sample) {
        const Vec<D> place = patch_place<D>(s, patch, points).X;
        const Vec<D> x = surface.nearest(place, nodes.foot(grid.facets[f].nodes[0]).patch).x;
        for (std::size_t a = 0; a < patch.size(); ++a)
          at(right, patch[a]) += weight[f] * s.weight * s.L[a] * x;
      }
    }
    points = solved<D>(mass, right);
    for (const auto& [key, number] : numbered.number)
      if (key.size() == 1 && nodes.is_on_edge(key.front()))
        at(points, number) = at(nodes.x(), key.front());
  }
  return points;
}

/// Places the inner nodes: their positions are harmonic functions on the ideal grid with the given
/// values on its boundary.
template <int D>
void place_inside(const Grid<D>& ideal, const std::vector<char>& on_boundary,
                  std::vector<Vec<D>>& x) {
  std::vector<Index> number(x.size(), -1);
  Index inside = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!on_boundary[i]) number[i] = inside++;
  if (inside == 0) return;
  constexpr int corners = 1 << D;
  const TensorRule<D> rule = tensor_rule<D>(2);
  std::vector<MatrixEntry> entries;
  std::vector<Vec<D>> right(static_cast<std::size_t>(inside), Vec<D>::Zero());
  for (const auto& cell : ideal.cells) {
    const auto points = ideal.corner_points(cell);
    std::array<std::array<Real, corners>, corners> K{};
    for (std::size_t q = 0; q < rule.x.size(); ++q) {
      const Mat<D> J = multilinear<D, D>(points, rule.x[q]).J;
      const Mat<D> to_place = inverse<D>(J).transpose();
      const Real weight = rule.w[q] * determinant<D>(J);
      auto g = corner_slopes<D>(rule.x[q]);
      for (Vec<D>& slope : g) slope = to_place * slope;
      for (int a = 0; a < corners; ++a)
        for (int b = 0; b < corners; ++b) at(at(K, a), b) += weight * at(g, a).dot(at(g, b));
    }
    for (int a = 0; a < corners; ++a) {
      const Index i = at(number, at(cell, a));
      if (i < 0) continue;
      for (int b = 0; b < corners; ++b) {
        const Index node = at(cell, b), j = at(number, node);
        if (j >= 0)
          entries.push_back({i, j, at(at(K, a), b)});
        else
          at(right, i) -= at(at(K, a), b) * at(x, node);
      }
    }
  }
  const std::vector<Vec<D>> solution = solved<D>(SparseCholesky(inside, entries), right);
  for (std::size_t i = 0; i < x.size(); ++i)
    if (number[i] >= 0) x[i] = at(solution, number[i]);
}

/// Like place_inside() in the half plane of a body of revolution, where positions across the axis
/// are zero on it, and positions along it have no slope across it.
template <int D>
void place_beside_axis(const Body<D>& body, const Grid<D>& ideal,
                       const std::vector<char>& on_boundary, std::vector<Vec<D>>& x) {
  std::vector<char> held = on_boundary;
  std::vector<Vec<D>> across = x;
  for (Index A = 0; A < body.size(); ++A)
    if (body.on_axis(A)) {
      at(held, A) = 1;
      at(across, A)[0] = 0;
    }
  place_inside(ideal, held, across);
  place_inside(ideal, on_boundary, x);
  for (std::size_t A = 0; A < x.size(); ++A) x[A][0] = across[A][0];
}

/// Moves the inner nodes of folded cells to the mean of the nodes at the other ends of their edges.
/// Repeats this until no cell is folded or it no longer helps. Cells at the surface are curved like
/// the surface.
template <int D>
void unfold(const Grid<D>& grid, const std::vector<char>& on_boundary, Seeds<D>& seeds) {
  constexpr int most_rounds = 30;
  Geometry<D> body{grid, std::make_shared<QuadraticSurface<D>>(grid, seeds.surface)};
  body.grid.X = seeds.nodes;
  curve_boundary(body);
  std::vector<std::set<Index>> beside(seeds.nodes.size());
  for (const auto& cell : grid.cells)
    for (int a = 0; a < Grid<D>::corners; ++a)
      for (int k = 0; k < D; ++k) at(beside, at(cell, a)).insert(at(cell, a ^ (1 << k)));
  for (int round = 0; round < most_rounds; ++round) {
    std::set<Index> moved;
    for (Index cell = 0; cell < grid.cell_count(); ++cell)
      if (find_fold(body.grid, cell))
        for (const Index node : at(grid.cells, cell))
          if (!at(on_boundary, node)) moved.insert(node);
    if (moved.empty()) break;
    for (const Index node : moved) {
      Vec<D> sum = Vec<D>::Zero();
      for (const Index other : at(beside, node)) sum += at(body.grid.X, other);
      at(body.grid.X, node) = sum / static_cast<Real>(at(beside, node).size());
    }
  }
  seeds.nodes = body.grid.X;
}

}  // namespace

template <int D>
Seeds<D> reseeded(const Body<D>& body, const NodalVector* u, const Grid<D>& ideal,
                  const std::optional<ContactLine<D>>& line, Real time) {
  constexpr int sweeps = 60;
  const Grid<D>& grid = body.geometry.grid;
  const PresentSurface<D> surface(body, u);
  MovingNodes<D> nodes(grid, surface);
  const std::vector<Index> edges =
      body.geometry.surface->smooth() ? std::vector<Index>{} : nodes_on_edges(grid, surface);
  for (const Index node : edges) nodes.hold_on_edge(node);
  for (const Index node : boundary_nodes(grid))  // the ends of the curve of a body of revolution
    if (body.on_axis(node)) nodes.hold_on_edge(node);
  if (line && edges.empty()) hold_at_line(*line, time, grid, surface, nodes);
  for (int sweep = 0; sweep < sweeps; ++sweep) nodes.relax();

  Seeds<D> seeds(nodes.x());
  seeds.surface = fitted_patches(grid, surface, nodes);
  // Scale the body to the volume of the present surface, because a stiff fluid would otherwise
  // change its pressure. The point nearest to a wall is kept fixed.
  const PatchNodes<D> numbered(grid);
  Vec<D> fixed = Vec<D>::Zero();
  for (const Vec<D>& x : seeds.surface) fixed += x / static_cast<Real>(seeds.surface.size());
  if (line)
    fixed = *std::min_element(
        seeds.surface.begin(), seeds.surface.end(),
        [&](const Vec<D>& a, const Vec<D>& b) { return line->gap(a, time) < line->gap(b, time); });
  if (grid.revolved) fixed[0] = 0;
  const Real stretch = std::pow(enclosed_volume<D>(grid, surface.patches(), surface.points()) /
                                    enclosed_volume<D>(grid, numbered.facet, seeds.surface),
                                1.0 / body.space());
  for (Vec<D>& x : seeds.surface) x = fixed + stretch * (x - fixed);
  std::vector<char> on_boundary(grid.X.size(), 0);
  for (const auto& [key, number] : numbered.number)
    if (key.size() == 1) {
      at(seeds.nodes, key.front()) = at(seeds.surface, number);
      at(on_boundary, key.front()) = 1;
    }
  if (grid.revolved) {
    place_beside_axis(body, ideal, on_boundary, seeds.nodes);
  } else {
    place_inside(ideal, on_boundary, seeds.nodes);
  }
  unfold(grid, on_boundary, seeds);
  for (Index A = 0; A < body.size(); ++A)
    if (body.on_axis(A)) at(seeds.nodes, A)[0] = 0;
  return seeds;
}

#define MENISCUS_INSTANTIATE(D)                                                  \
  template Seeds<D> reseeded(const Body<D>&, const NodalVector*, const Grid<D>&, \
                             const std::optional<ContactLine<D>>&, Real);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
