// SPDX-License-Identifier: BSD-3-Clause
// Positions of the facets, nearest points, and forces on the corners.
#include "physics/contact/points/contact_facets.hpp"

#include "kernel/row_sums.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>

namespace meniscus {
namespace {

/// Portions of the corners in the point of a segment nearest to x.
template <int D>
std::array<Real, 2> nearest_on_segment(const Vec<D>& x, const Vec<D>& a, const Vec<D>& b) {
  const Vec<D> edge = b - a;
  const Real t = std::clamp(edge.dot(x - a) / edge.squaredNorm(), 0.0, 1.0);
  return {1 - t, t};
}

/// Portions of the corners in the point of a facet nearest to x.
std::array<Real, 2> nearest_on(const Vec<2>& x, const std::array<Vec<2>, 2>& corner) {
  return nearest_on_segment<2>(x, corner[0], corner[1]);
}
/// The nearest point is inside the triangle or on one of its edges.
std::array<Real, 3> nearest_on(const Vec<3>& x, const std::array<Vec<3>, 3>& corner) {
  const Vec<3> ab = corner[1] - corner[0], ac = corner[2] - corner[0], ax = x - corner[0];
  const Vec<3> n = ab.cross(ac);
  const Real b = ax.cross(ac).dot(n) / n.squaredNorm(), c = ab.cross(ax).dot(n) / n.squaredNorm();
  if (b >= 0 && c >= 0 && b + c <= 1) return {1 - b - c, b, c};
  std::array<Real, 3> best{};
  Real least = unbounded;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    const auto share = nearest_on_segment<3>(x, corner[k], corner[next]);
    const Real square = (x - share[0] * corner[k] - share[1] * corner[next]).squaredNorm();
    if (square >= least) continue;
    least = square;
    best = {};
    best[k] = share[0];
    best[next] = share[1];
  }
  return best;
}

/// The outward normal, as long as the facet (3D: twice its area).
Vec<2> normal_of(const std::array<Vec<2>, 2>& corner) {
  const Vec<2> edge = corner[1] - corner[0];
  return {edge[1], -edge[0]};
}
Vec<3> normal_of(const std::array<Vec<3>, 3>& corner) {
  return (corner[1] - corner[0]).cross(corner[2] - corner[0]);
}

/// Portions of the corners in the point where the line through x along `up` meets the plane of a
/// facet with normal n.
std::array<Real, 2> shares_below(const Vec<2>& x, const Vec<2>& up, const Vec<2>& n,
                                 const std::array<Vec<2>, 2>& corner) {
  const Vec<2> across(-up[1], up[0]);
  const Real t = across.dot(x - corner[0]) / n.dot(up);
  return {1 - t, t};
}
std::array<Real, 3> shares_below(const Vec<3>& x, const Vec<3>& up, const Vec<3>& n,
                                 const std::array<Vec<3>, 3>& corner) {
  const auto share = [&](std::size_t k) {
    return up.dot((corner[(k + 1) % 3] - x).cross(corner[(k + 2) % 3] - x)) / n.dot(up);
  };
  return {share(0), share(1), share(2)};
}

}  // namespace

template <int D>
ContactFacets<D>::ContactFacets(const Body<D>& body)
    : body_(body), simplices_(triangulate_boundary(body.geometry.grid)) {
  std::vector<Index> number(static_cast<std::size_t>(body.size()), -1);
  for (const Index A : boundary_nodes(body.geometry.grid)) {
    at(number, A) = static_cast<Index>(X_.size());
    X_.push_back(at(body.particles.X(), A));
    particle_.push_back(A);
  }
  for (auto& simplex : simplices_)
    for (Index& A : simplex) A = at(number, A);
  rows_ = build_point_rows<D>(body.particles, X_, {.value = true}, body.name);
  chunk_sums_ = body.chunk_sums(rows_.start, rows_.particle);
}

template <int D>
typename ContactFacets<D>::Places ContactFacets<D>::at_rest() const {
  Places places{X_, AlignedVector<Lanes>(simplices_.size() * D, Lanes::zero()),
                std::vector<Real>(simplices_.size())};
  sample(places);
  return places;
}

template <int D>
void ContactFacets<D>::move(const ItemRange& corners, const Motion& motion, Places& places) const {
  const NodalVector* u = motion.u.data() + body_.first;
  parallel_for(corners, [&](Index B) {
    const Lanes moved = value_at(rows_, B, u);
    for (int i = 0; i < D; ++i) at(places.corner, B)[i] = at(X_, B)[i] + moved[i];
  });
}

template <int D>
void ContactFacets<D>::move(const Motion& motion, Places& places) const {
  move({0, rows_.size()}, motion, places);
  sample(places);
}

template <int D>
Gathered ContactFacets<D>::place(const SharedWork& work, const Motion& motion,
                                 Places& places) const {
  const Portions shares = work.rows(body_.division).rows(rows_.size());
  move(shares.own(), motion, places);
  return {places.corner.data(), shares};
}

template <int D>
void ContactFacets<D>::sample(Places& places) const {
  parallel_for(static_cast<Index>(simplices_.size()), [&](Index facet) {
    Vec<D> middle = Vec<D>::Zero();
    for (const Index corner : corners_of(facet)) middle += at(places.corner, corner) / D;
    Real& radius = at(places.radius, facet);
    radius = 0;
    for (const Index corner : corners_of(facet))
      radius = std::max(radius, (at(places.corner, corner) - middle).norm());
    for (int lane = 0; lane < Lanes::width; ++lane) {
      const Vec<D>& x = lane < D ? at(places.corner, at(corners_of(facet), lane)) : middle;
      for (int i = 0; i < D; ++i) at(places.samples, facet * D + i).set(lane, x[i]);
    }
  });
}

template <int D>
typename ContactFacets<D>::Foot ContactFacets<D>::foot(const Places& places, const Vec<D>& x,
                                                       std::span<const Index> facets) const {
  // For most facets of a list a bounding sphere shows that they are farther than the nearest
  // middle.
  constexpr Real round_off = 1e-12;
  constexpr int middle = Lanes::width - 1;  // index of the middle in the samples
  thread_local std::vector<Real> square;    // squared distances of the middles
  square.resize(facets.size());
  Real least = unbounded;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    Real sum = 0;
    for (int i = 0; i < D; ++i) {
      const Real away = x[i] - at(places.samples, facets[f] * D + i)[middle];
      sum += away * away;
    }
    square[f] = sum;
    least = std::min(least, sum);
  }
  Foot best;
  best.normal.setZero();
  Real farthest = std::sqrt(least);
  for (std::size_t f = 0; f < facets.size(); ++f) {
    const Index facet = facets[f];
    const Real beyond = farthest + at(places.radius, facet);
    if (square[f] > beyond * beyond * (1 + round_off)) continue;
    const std::array<Vec<D>, D> corner = corners(places.corner, facet);
    const std::array<Real, D> share = nearest_on(x, corner);
    Vec<D> way = x;
    for (std::size_t k = 0; k < D; ++k) way -= share[k] * corner[k];
    const Real distance = way.norm();
    if (distance < best.distance) best = {facet, distance, way / distance, share};
    farthest = std::min(farthest, distance);
  }
  return best;
}

template <int D>
std::array<Vec<D>, D> ContactFacets<D>::corners(const std::vector<Vec<D>>& x, Index facet) const {
  std::array<Vec<D>, D> corner;
  for (std::size_t k = 0; k < D; ++k) corner[k] = at(x, corners_of(facet)[k]);
  return corner;
}

template <int D>
typename ContactFacets<D>::Foot ContactFacets<D>::below(const Places& places, const Vec<D>& x,
                                                        const Vec<D>& up,
                                                        std::span<const Index> facets) const {
  // A point above an edge must be above at least one of its facets.
  constexpr Real round_off = 1e-9;
  Foot best;
  best.normal.setZero();
  for (const Index facet : facets) {
    const std::array<Vec<D>, D> corner = corners(places.corner, facet);
    const Vec<D> n = normal_of(corner);
    if (!(n.dot(up) > 0)) continue;
    const std::array<Real, D> share = shares_below(x, up, n, corner);
    if (*std::min_element(share.begin(), share.end()) < -round_off) continue;
    const Real gap = n.dot(x - corner[0]) / n.dot(up);
    if (best.facet < 0 || std::abs(gap) < std::abs(best.distance))
      best = {facet, gap, n / n.dot(up), share};
  }
  return best;
}

template <int D>
Vec<D> ContactFacets<D>::reference_place(const Foot& foot) const {
  const std::array<Vec<D>, D> corner = corners(X_, foot.facet);
  Vec<D> X = Vec<D>::Zero();
  for (std::size_t k = 0; k < D; ++k) X += foot.share[k] * corner[k];
  return X;
}

/// The vector v with v.(edge) = gradient.(reference edge) for the edges of the facet, and v.up = 0.
template <int D>
Vec<D> ContactFacets<D>::carried(const Places& places, const Foot& foot, const Vec<D>& gradient,
                                 const Vec<D>& up) const {
  const std::array<Vec<D>, D> x = corners(places.corner, foot.facet), X = corners(X_, foot.facet);
  Mat<D> rows;
  Vec<D> products;
  for (int j = 1; j < D; ++j) {
    rows.row(j - 1) = (at(x, j) - x[0]).transpose();
    products[j - 1] = gradient.dot(at(X, j) - X[0]);
  }
  rows.row(D - 1) = up.transpose();
  products[D - 1] = 0;
  return rows.inverse() * products;
}

template <int D>
std::vector<Index> ContactFacets<D>::facing(const Vec<D>& up) const {
  std::vector<Index> found;
  for (Index facet = 0; facet < static_cast<Index>(simplices_.size()); ++facet)
    if (const Vec<D> n = normal_of(corners(X_, facet)); n.dot(up) > n.norm() / 2)
      found.push_back(facet);
  return found;
}

template <int D>
Index ContactFacets<D>::turned_over(const Places& places, const Vec<D>& up,
                                    std::span<const Index> facets) const {
  for (const Index facet : facets)
    if (!(normal_of(corners(places.corner, facet)).dot(up) > 0)) return facet;
  return -1;
}

template <int D>
void ContactFacets<D>::add_force(const std::vector<Vec<D>>& pull, const Forces& force) {
  chunk_sums_.accumulate(body_.part(force), [&](int, Index begin, Index end, NodalVector* f) {
    for (Index B = begin; B < end; ++B) {
      if (at(pull, B).isZero(0)) continue;
      Lanes load = Lanes::zero();
      for (int i = 0; i < D; ++i) load.set(i, at(pull, B)[i]);
      scatter_value(rows_, B, load, f);
    }
  });
}

template <int D>
Real ContactFacets<D>::longest_edge() const {
  Real longest = 0;
  for (const auto& simplex : simplices_)
    for (std::size_t k = 0; k < D; ++k)
      longest = std::max(longest, (at(X_, simplex[k]) - at(X_, simplex[(k + 1) % D])).norm());
  return longest;
}

template <int D>
std::size_t ContactFacets<D>::bytes() const {
  return rows_.bytes() + chunk_sums_.bytes() + X_.size() * (sizeof(Vec<D>) + sizeof(Index)) +
         simplices_.size() * sizeof(simplices_[0]);
}

template class ContactFacets<2>;
template class ContactFacets<3>;

}  // namespace meniscus
