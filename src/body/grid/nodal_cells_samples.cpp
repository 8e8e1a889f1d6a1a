// SPDX-License-Identifier: BSD-3-Clause
// Samples of nodal cells and of their facets, and the difference of their sums from exact
// integrals.
#include "body/grid/nodal_cells.hpp"
#include "body/grid/octant_tables.hpp"
#include "numbers/unroll.hpp"

#include <algorithm>
#include <bit>

namespace meniscus {

/// Points of a facet, one per lane, with their normals times weights.
template <int D>
struct FourFacetPoints {
  std::array<Lanes, D> X;
  std::array<Lanes, 4> dA;
  int count;
};

namespace {

/// Relative differences below this are rounding.
constexpr Real rounding = 1e-12;
/// Largest relative difference with shared samples. It is exceeded if parts are unequal; each part
/// then gets samples of its own.
constexpr Real most_missing = 0.01;

/// sum += w f(arm) for all monomials f.
template <int D, int degree, class Weight, std::size_t count>
void add_monomials(const Weight& w, const Vec<D>& arm, std::array<Weight, count>& sum) {
  constexpr Monomials<D, degree> table;
  std::array<Weight, count> f;
  f[0] = w;
  sum[0] += w;
  unroll<f.size() - 1>([&](auto k) {
    constexpr auto factor = static_cast<std::size_t>(table.factor[k + 1]);
    f[k + 1] = f[factor] * arm[table.variable[k + 1]];
    sum[k + 1] += f[k + 1];
  });
}

/// The largest missing moment relative to size * length^(degree of the monomial).
template <int D, int degree, class Missing>
Real largest(const Missing& missing, Real size, Real length) {
  Real scale = size, most = 0;
  std::size_t m = 0;
  for (int d = 0; d <= degree; ++d, scale *= length)
    for (; m < static_cast<std::size_t>(monomial_count(D, d)); ++m)
      most = std::max(most, std::abs(missing[m]) / scale);
  return most;
}

/// The corner of the cell at the end of direction k of an octant.
template <int D>
int corner_along(const typename Grid<D>::Cell& cell, int corner, int k) {
  return is_simplex<D>(cell)
             ? at(simplex_corners<D>(), at(directions_at<D>(simplex_corner<D>(corner)), k))
             : corner ^ (1 << k);
}

template <int D>
Index node_of(const typename Grid<D>::Cell& cell, int corner, int k) {
  return at(cell, corner_along<D>(cell, corner, k));
}

/// The number, among the samples, of a point of a part. A point that earlier parts do not have is
/// added at X.
template <int D>
std::size_t number_of(const typename Grid<D>::Cell& cell, int corner,
                      const typename SampleTable<D>::Places& places, const Vec<D>& X,
                      CellSamples<D>& samples) {
  using Table = SampleTable<D>;
  const auto is = [](int number) { return [number](int place) { return place == number; }; };
  std::array<Index, D> key;
  key.fill(-1);
  if (std::any_of(places.begin(), places.end(), is(0)) ||
      std::all_of(places.begin(), places.end(), is(Table::end))) {
    key.fill(0);  // particles and distances identify a point in all parts
    for (int k = 0; k < D; ++k)
      if (at(places, k) != 0)
        at(key, k) = 1 + at(places, k) + Table::distances * node_of<D>(cell, corner, k);
    std::sort(key.begin(), key.end());
    const auto found = std::find(samples.key.begin(), samples.key.end(), key);
    if (found != samples.key.end()) return static_cast<std::size_t>(found - samples.key.begin());
  }
  samples.key.push_back(key);
  samples.X.push_back(X);
  return samples.X.size() - 1;
}

/// Adds padding points, so that the next points begin at a multiple of four.
template <int D>
void fill_up(CellSamples<D>& samples) {
  while (samples.X.size() % Lanes::width != 0) {
    samples.X.push_back(samples.X.back());
    samples.key.emplace_back().fill(-1);
  }
}

/// Appends points that integrate polynomials exactly over a facet of the octant at `corner`: the
/// end of direction k, or, if `outer`, its beginning on the boundary of the body.
template <int D>
void append_exact_points(const CellMap<D>& map, int corner, int k, bool outer,
                         std::vector<FourFacetPoints<D>>& points) {
  const auto append = [&](const std::vector<FourTabulatedPoints<D>>& table, int direction,
                          Real sign) {
    for (const auto& p : table) {
      const FourCellPoints<D> four = map(p);
      const auto normal = four.facet_normal(direction);
      std::array<Lanes, 3> dA{};
      for (std::size_t i = 0; i < D; ++i) dA[i] = sign * p.w * normal[i];
      auto& [X, dA_of_lane, count] = points.emplace_back();
      X = four.X;
      dA_of_lane = by_lane(dA[0], dA[1], dA[2]);
      count = p.count;
    }
  };
  if (const auto* simplex = map.simplex()) {
    const int i = simplex_corner<D>(corner), j = at(directions_at<D>(i), k);
    const auto& side = outer ? simplex->on_side(i, j) : simplex->between(i, j);
    append(side.points, side.k, !outer && i < j ? 1 : -1);
  } else if (outer) {
    append(map.table().outer(corner, k), k, corner_sign(corner, k));
  } else {
    append(map.table().inner(corner, k), k, -corner_sign(corner, k));
  }
}

}  // namespace

template <int D>
unsigned NodalCells<D>::kind(Index cell, int corner, Sharing sharing) const {
  if (sharing == Sharing::parts) return SampleTable<D>::apart;
  unsigned bits = 0;
  for (int k = 0; k < D; ++k) bits |= static_cast<unsigned>(on_boundary(cell, corner, k)) << k;
  return bits;
}

template <int D>
bool NodalCells<D>::on_boundary(Index cell, int corner, int k) const {
  const int side = is_simplex<D>(at(grid_->cells, cell))
                       ? side_opposite<D>(at(directions_at<D>(simplex_corner<D>(corner)), k))
                       : 2 * k + ((corner >> k) & 1);
  return ((at(boundary_sides_, cell) >> side) & 1) != 0;
}

template <int D>
auto NodalCells<D>::facet_parts(Index node) const -> std::vector<FacetPart> {
  std::vector<FacetPart> parts;
  for (const auto& [cell, corner] : octants_.of(node))
    for (int k = 0; k < D; ++k) {
      parts.push_back({node_of<D>(at(grid_->cells, cell), corner, k), cell, corner, k});
      if (on_boundary(cell, corner, k)) parts.push_back({no_neighbor, cell, corner, k});
    }
  std::stable_sort(parts.begin(), parts.end(),
                   [](const FacetPart& a, const FacetPart& b) { return a.neighbor < b.neighbor; });
  return parts;
}

template <int D>
void NodalCells<D>::lower_neighbors(Index node, std::vector<Index>& neighbors) const {
  neighbors.clear();
  for (const auto& [cell, corner] : octants_.of(node))
    for (int k = 0; k < D; ++k) {
      const Index neighbor = node_of<D>(at(grid_->cells, cell), corner, k);
      if (neighbor < node) neighbors.push_back(neighbor);
    }
  std::sort(neighbors.begin(), neighbors.end());
  neighbors.erase(std::unique(neighbors.begin(), neighbors.end()), neighbors.end());
}

template <int D>
bool NodalCells<D>::is_long(Index node, Index cell, int corner,
                            const ParticleSet<D>& particles) const {
  constexpr Real longest = 0.25;  // half an edge, relative to the support
  for (int k = 0; k < D; ++k) {
    const Index neighbor = node_of<D>(at(grid_->cells, cell), corner, k);
    const Vec<D> edge =
        particles.kernel_place(at(grid_->X, neighbor)) - particles.kernel_place(at(grid_->X, node));
    const Real support = std::min(at(particles.support(), node), at(particles.support(), neighbor));
    if (0.5 * edge.norm() > longest * support) return true;
  }
  return false;
}

template <int D>
bool NodalCells<D>::are_even(const auto& octants, int between) const {
  const unsigned others = ((1u << D) - 1) & ~(between < 0 ? 0u : 1u << between);
  const auto kind_of = [&](const auto& octant) {
    return kind(octant.cell, octant.corner, Sharing::whole) & others;
  };
  const auto& first = octants.front();
  const Index number = at(equal_cells_, first.cell);
  if (number < 0) return false;
  const unsigned ends = kind_of(first);
  return octants.size() == std::size_t{1} << (std::popcount(others) - std::popcount(ends)) &&
         std::all_of(octants.begin(), octants.end(), [&](const auto& octant) {
           return at(equal_cells_, octant.cell) == number && kind_of(octant) == ends;
         });
}

template <int D>
void NodalCells<D>::sample_volume(Index node, const ParticleSet<D>& particles,
                                  CellSamples<D>& samples) const {
  const auto octants = octants_.of(node);
  if (std::any_of(octants.begin(), octants.end(),
                  [&](const auto& o) { return is_long(node, o.cell, o.corner, particles); }) ||
      missing_of_volume(node, Sharing::whole, samples) > most_missing)
    missing_of_volume(node, Sharing::parts, samples);
}

template <int D>
Real NodalCells<D>::missing_of_volume(Index node, Sharing sharing, CellSamples<D>& samples) const {
  samples.resize(0);
  samples.volume_w.clear();
  for (const auto& [cell, corner] : octants_.of(node)) {
    const CellMap<D> map(*grid_, cell);
    const int own = map.simplex() ? simplex_corner<D>(corner) : corner;
    for (const auto& p :
         SampleTable<D>::of(map.simplex()).volume(own, kind(cell, corner, sharing))) {
      const CellPoint<D, D> point = map(p.at);
      const std::size_t q = number_of(at(grid_->cells, cell), corner, p.places, point.X, samples);
      samples.volume_w.resize(samples.X.size(), 0);
      samples.volume_w[q] += p.at.w * determinant<D>(point.J);
    }
  }
  samples.volume_exact = are_even(octants_.of(node), -1);
  if (samples.volume_exact) return 0;
  const Real V = at(volume_, node);
  auto& missing = samples.volume_missing;
  missing.fill(0);
  Real radius = 0;
  for (std::size_t q = 0; q < samples.volume_w.size(); ++q) {
    const Vec<D> arm = samples.X[q] - at(centroid_, node);
    add_monomials<D, 2, Real>(-samples.volume_w[q], arm, missing);
    radius = std::max(radius, arm.norm());
  }
  missing[0] += V;
  for (int i = 0; i < D; ++i)
    for (int j = i; j < D; ++j)
      at(missing, 1 + D + hessian_index(D, i, j)) += V * at(covariance_, node)(i, j);
  const Real most = largest<D, 2>(missing, V, radius);
  samples.volume_exact = most <= rounding;
  return most;
}

template <int D>
void NodalCells<D>::sample_facet(Index node, std::span<const FacetPart> parts,
                                 const ParticleSet<D>& particles, CellSamples<D>& samples) const {
  auto& facet = samples.facets.emplace_back();
  facet.neighbor = parts.front().neighbor;
  facet.begin = samples.facet_points.size();
  // Test the supports from both sides, so that a body and its mirror image have the same points.
  const auto is_long_part = [&](const FacetPart& p) {
    const int beyond = corner_along<D>(at(grid_->cells, p.cell), p.corner, p.k);
    return is_long(node, p.cell, p.corner, particles) ||
           (p.neighbor != no_neighbor && is_long(p.neighbor, p.cell, beyond, particles));
  };
  const std::size_t before = samples.X.size();
  if (std::none_of(parts.begin(), parts.end(), is_long_part)) {
    if (missing_of_facet(parts, Sharing::whole, samples) <= most_missing) return;
    samples.resize(before);
  }
  missing_of_facet(parts, Sharing::parts, samples);
}

/// Sets the points of the last facet of `samples`, in ascending order and with their centre.
/// `exact` gets Gauss points for the exact moments of the facet, unless the points themselves are
/// exact.
template <int D>
void NodalCells<D>::gather_facet_points(std::span<const FacetPart> parts, Sharing sharing,
                                        std::vector<FourFacetPoints<D>>& exact,
                                        CellSamples<D>& samples) const {
  auto& facet = samples.facets.back();
  auto& points = samples.facet_points;
  points.resize(facet.begin);
  const bool outer = facet.neighbor == no_neighbor;
  facet.exact = !outer && are_even(parts, parts.front().k);
  if (sharing == Sharing::whole) fill_up(samples);
  for (const FacetPart& part : parts) {
    const CellMap<D> map(*grid_, part.cell);
    if (!facet.exact) append_exact_points(map, part.corner, part.k, outer, exact);
    const int own = map.simplex() ? simplex_corner<D>(part.corner) : part.corner;
    const auto& samples_of_parts = SampleTable<D>::of(map.simplex());
    const unsigned of_kind = kind(part.cell, part.corner, sharing);
    const auto& table = outer ? samples_of_parts.outer_facet(own, part.k, of_kind)
                              : samples_of_parts.facet(own, part.k, of_kind);
    for (const auto& p : table.points) {
      const CellPoint<D, D> point = map(p.at);
      const Vec<D> dA = table.sign * p.at.w * facet_normal<D>(point.J, part.k);
      const std::size_t q =
          number_of(at(grid_->cells, part.cell), part.corner, p.places, point.X, samples);
      const auto begin = points.begin() + static_cast<std::ptrdiff_t>(facet.begin);
      const auto same =
          std::find_if(begin, points.end(), [q](const auto& of) { return of.number == q; });
      if (same == points.end())
        points.push_back({q, dA});
      else
        same->dA += dA;
    }
  }
  facet.end = points.size();
  const std::span own_points(points.data() + facet.begin, facet.end - facet.begin);
  std::sort(own_points.begin(), own_points.end(),
            [](const auto& a, const auto& b) { return a.number < b.number; });
  facet.centre.setZero();
  for (const auto& point : own_points) facet.centre += samples.X[point.number];
  facet.centre /= static_cast<Real>(own_points.size());
}

template <int D>
Real NodalCells<D>::missing_of_facet(std::span<const FacetPart> parts, Sharing sharing,
                                     CellSamples<D>& samples) const {
  thread_local std::vector<FourFacetPoints<D>> exact;
  exact.clear();
  gather_facet_points(parts, sharing, exact, samples);
  auto& facet = samples.facets.back();
  if (facet.exact) return 0;
  const std::span own_points(samples.facet_points.data() + facet.begin, facet.end - facet.begin);
  std::array<Lanes, std::tuple_size_v<typename CellSamples<D>::template Missing<3>>> missing;
  missing.fill(Lanes::zero());
  const auto add = [&](const Vec<D>& X, Lanes dA) {  // a lane per component
    add_monomials<D, 3>(dA, X - facet.centre, missing);
  };
  Real area = 0, radius = 0;
  for (const auto& [number, dA] : own_points) {
    const Vec<D>& X = samples.X[number];
    add(X, -Lanes(dA[0], dA[1], D == 3 ? dA[D - 1] : 0.0, 0.0));
    area += dA.norm();
    radius = std::max(radius, (X - facet.centre).norm());
  }
  for (const FourFacetPoints<D>& four : exact)
    for (int lane = 0; lane < four.count; ++lane) {
      Vec<D> X;
      for (int i = 0; i < D; ++i) X[i] = at(four.X, i)[lane];
      add(X, at(four.dA, lane));
    }
  for (int K = 0; K < D; ++K)
    for (std::size_t m = 0; m < missing.size(); ++m) at(facet.missing, K)[m] = missing[m][K];
  Real most = 0;
  for (const auto& of_K : facet.missing) most = std::max(most, largest<D, 3>(of_K, area, radius));
  facet.exact = most <= rounding;
  return most;
}

template <int D>
void NodalCells<D>::sample(Index node, Index first, const ParticleSet<D>& particles, bool boundary,
                           CellSamples<D>& samples) const {
  samples.clear();
  sample_volume(node, particles, samples);
  const std::vector<FacetPart> parts = facet_parts(node);
  for (auto begin = parts.begin(); begin != parts.end();) {
    const auto end = std::find_if(
        begin, parts.end(), [&](const FacetPart& p) { return p.neighbor != begin->neighbor; });
    const bool wanted = begin->neighbor == no_neighbor
                            ? boundary
                            : begin->neighbor > node || begin->neighbor < first;
    if (wanted) sample_facet(node, std::span(begin, end), particles, samples);
    begin = end;
  }
}

template void NodalCells<2>::sample(Index, Index, const ParticleSet<2>&, bool,
                                    CellSamples<2>&) const;
template void NodalCells<3>::sample(Index, Index, const ParticleSet<3>&, bool,
                                    CellSamples<3>&) const;
template void NodalCells<2>::lower_neighbors(Index, std::vector<Index>&) const;
template void NodalCells<3>::lower_neighbors(Index, std::vector<Index>&) const;

}  // namespace meniscus
