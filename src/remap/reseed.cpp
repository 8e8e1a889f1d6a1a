// SPDX-License-Identifier: BSD-3-Clause
// Nodes along the present surface, and inside it.
#include "remap/reseed.hpp"

#include "body/grid/gauss.hpp"
#include "body/surface/quadratic_surface.hpp"
#include "numbers/dense.hpp"
#include "remap/edges.hpp"
#include "remap/present_surface.hpp"
#include "solve/linear/sparse_factors.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <set>

namespace meniscus {
namespace {

template <int D>
using Foot = typename PresentSurface<D>::Foot;

/// x_i of A x = b, b_i and x_i vectors; A is symmetric and positive definite.
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

/// Area vector of a facet through its corners (2D: normal of its length).
template <int D>
Vec<D> area_of(const Facet<D>& facet, const std::vector<Vec<D>>& x) {
  const auto corner = [&](int a) { return at(x, at(facet.nodes, a)); };
  if constexpr (D == 3)
    return 0.5 * cross(corner(3) - corner(0), corner(2) - corner(1));
  else
    return Vec<2>(corner(1)[1] - corner(0)[1], corner(0)[0] - corner(1)[0]);
}

/// The boundary of a grid while its nodes move along the present surface.
template <int D>
class MovingNodes {
 public:
  MovingNodes(const Grid<D>& grid, const PresentSurface<D>& surface)
      : grid_(grid),
        surface_(surface),
        x_(grid.X.size()),
        foot_(x_.size()),
        held_(x_.size(), 0),
        edge_(held_) {
    facets_at_.resize(x_.size());
    for (std::size_t f = 0; f < grid.facets.size(); ++f)
      for (const Index node : grid.facets[f].nodes)
        at(facets_at_, node).push_back(static_cast<Index>(f));
    const PatchNodes<D> numbered(grid);
    for (std::size_t f = 0; f < grid.facets.size(); ++f)
      for (int a = 0; a < PatchFunctions<D>::nodes; ++a) {
        const auto key = patch_key<D>(grid.facets[f], patch_node<D>(a));
        if (key.size() != 1) continue;
        Foot<D>& foot = at(foot_, key.front());
        foot.patch = static_cast<Index>(f);
        foot.xi = patch_node<D>(a);
        at(x_, key.front()) = foot.x = at(surface.points(), at(numbered.facet[f], a));
      }
  }

  const std::vector<Vec<D>>& x() const { return x_; }
  const std::vector<Index>& facets_at(Index node) const { return at(facets_at_, node); }

  void hold(Index node, const Foot<D>& foot) {
    place(node, foot);
    at(held_, node) = 1;
  }
  /// Holds a node of an edge, across which facets do not count as turned.
  void hold_on_edge(Index node) {
    at(held_, node) = 1;
    at(edge_, node) = 1;
  }
  bool is_on_edge(Index node) const { return at(edge_, node) != 0; }
  const Foot<D>& foot(Index node) const { return at(foot_, node); }

  /// Nodes that are not held move to the middle of their facets, which count by area and, eight
  /// times as much, by how they turn against those beside them.
  void relax() {
    constexpr Real weight_of_turns = 8;
    std::vector<Vec<D>> area, middle;
    for (const Facet<D>& facet : grid_.facets) {
      area.push_back(area_of(facet, x_));
      Vec<D> sum = Vec<D>::Zero();
      for (const Index node : facet.nodes) sum += at(x_, node);
      middle.push_back(sum / static_cast<Real>(facet.nodes.size()));
    }
    std::vector<Real> weight(area.size());
    for (std::size_t f = 0; f < weight.size(); ++f) {
      Real turn = 0;
      int beside = 0;
      for (const Index node : grid_.facets[f].nodes)
        for (const Index other : at(facets_at_, node))
          if (other != static_cast<Index>(f) && !at(edge_, node)) {
            turn += 1 - area[f].dot(at(area, other)) / (area[f].norm() * at(area, other).norm());
            ++beside;
          }
      weight[f] = area[f].norm() * (1 + weight_of_turns * turn / std::max(beside, 1));
    }
    for (std::size_t node = 0; node < x_.size(); ++node) {
      if (facets_at_[node].empty() || held_[node]) continue;
      Vec<D> sum = Vec<D>::Zero();
      Real whole = 0;
      for (const Index f : facets_at_[node]) {
        sum += at(weight, f) * at(middle, f);
        whole += at(weight, f);
      }
      place(static_cast<Index>(node), surface_.nearest(sum / whole, foot_[node].patch));
    }
  }

 private:
  void place(Index node, const Foot<D>& foot) {
    at(foot_, node) = foot;
    at(x_, node) = foot.x;
  }

  const Grid<D>& grid_;
  const PresentSurface<D>& surface_;
  std::vector<Vec<D>> x_;  // [node]; of no meaning inside
  std::vector<Foot<D>> foot_;
  std::vector<char> held_, edge_;
  std::vector<std::vector<Index>> facets_at_;  // [node]
};

/// Boundary nodes by the number of facets that lie between them and the pole: each set is a ring
/// around it. Empty if there is a node that no facet leads to.
template <int D>
std::vector<std::vector<Index>> rings_around(Index pole, const Grid<D>& grid,
                                             const MovingNodes<D>& nodes) {
  std::vector<int> ring(grid.X.size(), -1);
  std::vector<std::vector<Index>> rings = {{pole}};
  at(ring, pole) = 0;
  while (true) {
    std::vector<Index> next;
    for (const Index node : rings.back())
      for (const Index f : nodes.facets_at(node))
        for (const Index other : at(grid.facets, f).nodes)
          if (at(ring, other) < 0) {
            at(ring, other) = static_cast<int>(rings.size());
            next.push_back(other);
          }
    if (next.empty()) return rings;
    std::sort(next.begin(), next.end());
    rings.push_back(std::move(next));
  }
}

/// The ring that encloses the part of the facets nearest to `fraction`; none if that is the pole or
/// the last.
template <int D>
std::optional<std::vector<Index>> ring_of(Real fraction,
                                          const std::vector<std::vector<Index>>& rings,
                                          const Grid<D>& grid) {
  std::vector<int> number(grid.X.size(), 0);
  for (std::size_t k = 0; k < rings.size(); ++k)
    for (const Index node : rings[k]) at(number, node) = static_cast<int>(k);
  std::vector<Real> enclosed(rings.size() + 1, 0);
  for (const Facet<D>& facet : grid.facets) {
    int outer = 0;
    for (const Index node : facet.nodes) outer = std::max(outer, at(number, node));
    for (auto k = static_cast<std::size_t>(outer); k < enclosed.size(); ++k)
      enclosed[k] += 1.0 / static_cast<Real>(grid.facets.size());
  }
  std::size_t best = 0;
  for (std::size_t k = 1; k < rings.size(); ++k)
    if (std::abs(enclosed[k] - fraction) < std::abs(enclosed[best] - fraction)) best = k;
  if (best < 1 || best + 1 >= rings.size()) return std::nullopt;
  return rings[best];
}

/// Puts a ring of nodes on the contact line, evenly about the middle of what is wetted. In 2D it is
/// the two ends of that.
template <int D>
void hold_at_line(const ContactLine<D>& line, Real time, const Grid<D>& grid,
                  const PresentSurface<D>& surface, MovingNodes<D>& nodes) {
  constexpr Real least_fraction = 0.1;
  constexpr int most_steps = 100;
  const auto gap = [&](const Vec<D>& x) { return line.gap(x, time); };
  const Real wetted = surface.fraction([&](const Vec<D>& x) { return gap(x) < line.level; });
  if (wetted < least_fraction || wetted > 1 - least_fraction) return;

  Vec<D> middle = Vec<D>::Zero();
  Real area = 0;
  for (const Facet<D>& facet : grid.facets) {
    Vec<D> centre = Vec<D>::Zero();
    for (const Index node : facet.nodes)
      centre += at(nodes.x(), node) / static_cast<Real>(facet.nodes.size());
    if (gap(centre) >= line.level) continue;
    const Real a = area_of(facet, nodes.x()).norm();
    middle += a * centre;
    area += a;
  }
  if (area == 0) return;
  middle /= area;
  Index pole = grid.facets.front().nodes[0];
  for (const Facet<D>& facet : grid.facets)
    for (const Index node : facet.nodes)
      if ((at(nodes.x(), node) - middle).norm() < (at(nodes.x(), pole) - middle).norm())
        pole = node;
  const auto ring = ring_of<D>(wetted, rings_around(pole, grid, nodes), grid);
  if (!ring) return;

  const Real step = 1e-4 * line.level;
  const auto up = [&](const Vec<D>& x) {
    Vec<D> g;
    for (int i = 0; i < D; ++i)
      g[i] = (gap(x + step * Vec<D>::Unit(i)) - gap(x - step * Vec<D>::Unit(i))) / (2 * step);
    return Vec<D>(g.normalized());
  };
  const Vec<D> axis = up(middle);
  // Directions from the middle in which the nodes of the ring are to lie.
  std::vector<Vec<D>> direction;
  if constexpr (D == 3) {
    Vec<3> first = Vec<3>::Unit(std::abs(axis[0]) < 0.7 ? 0 : 1);
    first = (first - first.dot(axis) * axis).normalized();
    const Vec<3> second = cross(axis, first);
    std::vector<std::pair<Real, std::size_t>> order;
    for (std::size_t j = 0; j < ring->size(); ++j) {
      const Vec<3> from = at(nodes.x(), (*ring)[j]) - middle;
      order.emplace_back(std::atan2(second.dot(from), first.dot(from)), j);
    }
    std::sort(order.begin(), order.end());
    const Real pitch = 2 * std::numbers::pi / static_cast<Real>(order.size());
    Real phase = 0;
    for (std::size_t j = 0; j < order.size(); ++j)
      phase += (order[j].first - pitch * static_cast<Real>(j)) / static_cast<Real>(order.size());
    direction.resize(order.size());
    for (std::size_t j = 0; j < order.size(); ++j) {
      const Real angle = phase + pitch * static_cast<Real>(j);
      direction[order[j].second] = std::cos(angle) * first + std::sin(angle) * second;
    }
  } else {
    for (const Index node : *ring) {
      const Vec<2> along(-axis[1], axis[0]);
      direction.push_back((at(nodes.x(), node) - middle).dot(along) > 0 ? along : -along);
    }
  }
  for (std::size_t j = 0; j < ring->size(); ++j) {
    Foot<D> foot = nodes.foot((*ring)[j]);
    for (int k = 0; k < most_steps; ++k) {
      const Vec<D> from = foot.x - middle;
      const Real height = from.dot(axis), radius = (from - height * axis).norm();
      Vec<D> p = middle + height * axis + radius * direction[j];
      p += (line.level - gap(p)) * up(p);
      const Vec<D> before = foot.x;
      foot = surface.nearest(p, foot.patch);
      if ((foot.x - before).norm() < 1e-9 * radius) break;
    }
    nodes.hold((*ring)[j], foot);
  }
}

/// Points of patches between the nodes, such that the patches fit the present ones best.
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

/// Nodes inside at the values of functions that are harmonic in the ideal grid and those of the
/// boundary on it.
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

/// Interior nodes of cells that fold are moved to the middle of the nodes they share an edge with,
/// until none folds or it does not help. Cells at the surface are curved as it is.
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
  if (line && edges.empty()) hold_at_line(*line, time, grid, surface, nodes);
  for (int sweep = 0; sweep < sweeps; ++sweep) nodes.relax();

  Seeds<D> seeds(nodes.x());
  seeds.surface = fitted_patches(grid, surface, nodes);
  // The volume is that of the present surface: a stiff fluid would be under another pressure. What
  // is nearest to a wall stays there.
  const PatchNodes<D> numbered(grid);
  Vec<D> fixed = Vec<D>::Zero();
  for (const Vec<D>& x : seeds.surface) fixed += x / static_cast<Real>(seeds.surface.size());
  if (line)
    fixed = *std::min_element(
        seeds.surface.begin(), seeds.surface.end(),
        [&](const Vec<D>& a, const Vec<D>& b) { return line->gap(a, time) < line->gap(b, time); });
  const Real stretch = std::pow(enclosed_volume<D>(surface.patches(), surface.points()) /
                                    enclosed_volume<D>(numbered.facet, seeds.surface),
                                1.0 / D);
  for (Vec<D>& x : seeds.surface) x = fixed + stretch * (x - fixed);
  std::vector<char> on_boundary(grid.X.size(), 0);
  for (const auto& [key, number] : numbered.number)
    if (key.size() == 1) {
      at(seeds.nodes, key.front()) = at(seeds.surface, number);
      at(on_boundary, key.front()) = 1;
    }
  place_inside(ideal, on_boundary, seeds.nodes);
  unfold(grid, on_boundary, seeds);
  return seeds;
}

#define MENISCUS_INSTANTIATE(D)                                                  \
  template Seeds<D> reseeded(const Body<D>&, const NodalVector*, const Grid<D>&, \
                             const std::optional<ContactLine<D>>&, Real);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
