// SPDX-License-Identifier: BSD-3-Clause
// Area and enclosed volume of patches through material points.
#include "meniscus/body/surface_patches.hpp"

#include "meniscus/approx/row_sums.hpp"
#include "meniscus/body/gauss.hpp"
#include "meniscus/body/surface_points.hpp"

#include <algorithm>

namespace meniscus {
namespace {

// T is Lanes or Dual<Lanes>.
template <class T>
T dot(const std::array<T, 2>& a, const std::array<T, 2>& b) {
  return a[0] * b[0] + a[1] * b[1];
}
template <class T>
T dot(const std::array<T, 3>& a, const std::array<T, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class T>
std::array<T, 3> cross(const std::array<T, 3>& a, const std::array<T, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <class T>
using Tangent2 = std::array<std::array<T, 2>, 1>;
template <class T>
using Tangents3 = std::array<std::array<T, 3>, 2>;

/// m, outward for outward facets.
template <class T>
std::array<T, 2> area_normal(const Tangent2<T>& t) {
  return {t[0][1], -t[0][0]};
}
template <class T>
std::array<T, 3> area_normal(const Tangents3<T>& t) {
  return cross(t[0], t[1]);
}
/// c_k of b . dm = sum_k c_k . dt_k.
template <class T>
Tangent2<T> through_tangents(const Tangent2<T>&, const std::array<T, 2>& b) {
  return {{{-b[1], b[0]}}};
}
template <class T>
Tangents3<T> through_tangents(const Tangents3<T>& t, const std::array<T, 3>& b) {
  return {cross(t[1], b), cross(b, t[0])};
}

}  // namespace

template <int D>
SurfacePatches<D>::SurfacePatches(const Body<D>& body)
    : gauss_(patch_functions<D>(3)),
      patches_(static_cast<Index>(body.geometry.grid.facets.size())) {
  number_points(body.geometry);
  rows_ = build_point_rows<D>(body.particles, X_, {.value = true}, body.name);
  windows_ = {rows_.start, rows_.particle, body.size(), body.division};
  list_shares();
  x_.assign(X_.size(), Lanes::zero());
  for (Index q = 0; q < point_count(); ++q) set_vector<D>(x_, q, at(X_, q));
  area_ = size_of_all(Size::area, x_);
  volume_ = size_of_all(Size::volume, x_);
  gradient_.assign(static_cast<std::size_t>(group_count()) * nodes * D, Lanes::zero());
}

template <int D>
void SurfacePatches<D>::number_points(const Geometry<D>& geometry) {
  const PatchNodes<D> points(geometry.grid);
  node_ = points.facet;
  X_.resize(static_cast<std::size_t>(points.count()));
  std::vector<char> known(X_.size(), 0);
  for (std::size_t patch = 0; patch < node_.size(); ++patch)
    for (int a = 0; a < nodes; ++a) {
      const Index point = at(node_[patch], a);
      if (at(known, point)) continue;
      at(known, point) = 1;
      at(X_, point) = surface_point<D>(geometry, geometry.grid.facets[patch], patch_node<D>(a));
    }
}

template <int D>
void SurfacePatches<D>::list_shares() {
  std::vector<std::vector<Share>> of_point(X_.size());
  for (Index patch = 0; patch < patches_; ++patch)
    for (int a = 0; a < nodes; ++a)
      at(of_point, at(at(node_, patch), a))
          .push_back({static_cast<std::size_t>((patch / 4 * nodes + a) * D), patch % 4});
  share_begin_.push_back(0);
  for (const std::vector<Share>& shares : of_point) {
    share_.insert(share_.end(), shares.begin(), shares.end());
    share_begin_.push_back(static_cast<Index>(share_.size()));
  }
}

template <int D>
NodalVector SurfacePatches<D>::place_of(Index point, const NodalVector* u) const {
  NodalVector place = value_at(rows_, point, u);
  for (int i = 0; i < D; ++i) place.set(i, place[i] + at(X_, point)[i]);
  return place;
}

template <int D>
void SurfacePatches<D>::place(const NodalVector* u, NodalVectors& x) const {
  parallel_for(point_count(), [&](Index q) { at(x, q) = place_of(q, u); });
}

template <int D>
NodalVectors SurfacePatches<D>::values(const NodalVector* u) const {
  NodalVectors sums(X_.size());
  parallel_for(point_count(), [&](Index q) { at(sums, q) = value_at(rows_, q, u); });
  return sums;
}

template <int D>
typename SurfacePatches<D>::template Corners<Lanes> SurfacePatches<D>::corners(
    Index group, const NodalVectors& x) const {
  const Lanes origin = x.front();
  Corners<Lanes> place;
  for (int lane = 0; lane < 4; ++lane) {
    const auto& node = at(node_, std::min(group * 4 + lane, patches_ - 1));
    for (int a = 0; a < nodes; ++a)
      for (int i = 0; i < D; ++i) at(at(place, a), i).set(lane, (at(x, at(node, a)) - origin)[i]);
  }
  return place;
}

template <int D>
typename SurfacePatches<D>::template Corners<Dual<Lanes>> SurfacePatches<D>::corners(
    Index group, const NodalVectors& x, const NodalVectors& dx) const {
  const Corners<Lanes> place = corners(group, x), change = corners(group, dx);
  Corners<Dual<Lanes>> both;
  for (int a = 0; a < nodes; ++a)
    for (int i = 0; i < D; ++i) at(at(both, a), i) = {at(at(place, a), i), at(at(change, a), i)};
  return both;
}

template <int D>
template <class T>
T SurfacePatches<D>::group_size(Size size, const Corners<T>& place, T* gradient) const {
  const T zero(0.0);
  if (gradient) std::fill_n(gradient, nodes * D, zero);

  T total = zero;
  for (const PatchFunctions<D>& f : gauss_) {
    Vector<T> p;
    std::array<Vector<T>, D - 1> t;
    p.fill(zero);
    for (Vector<T>& tangent : t) tangent.fill(zero);
    for (int a = 0; a < nodes; ++a)
      for (int i = 0; i < D; ++i) {
        at(p, i) += at(f.L, a) * at(at(place, a), i);
        for (int k = 0; k < D - 1; ++k) at(at(t, k), i) += at(at(f.dL, k), a) * at(at(place, a), i);
      }
    // The size is sum s; ds = by_place . dx + by_normal . dm.
    const Vector<T> m = area_normal(t);
    Vector<T> by_place, by_normal;
    if (size == Size::area) {
      const T length = sqrt(dot(m, m));
      total += f.weight * length;
      for (int i = 0; i < D; ++i) {
        at(by_place, i) = zero;
        at(by_normal, i) = f.weight * at(m, i) / length;
      }
    } else {
      total += (f.weight / D) * dot(p, m);
      for (int i = 0; i < D; ++i) {
        at(by_place, i) = (f.weight / D) * at(m, i);
        at(by_normal, i) = (f.weight / D) * at(p, i);
      }
    }
    if (!gradient) continue;
    const auto c = through_tangents(t, by_normal);
    for (int a = 0; a < nodes; ++a)
      for (int i = 0; i < D; ++i) {
        T& g = gradient[a * D + i];
        g += at(f.L, a) * at(by_place, i);
        for (int k = 0; k < D - 1; ++k) g += at(at(f.dL, k), a) * at(at(c, k), i);
      }
  }
  return total;
}

template <int D>
Real SurfacePatches<D>::sum_of_patches(Index group, const Lanes& size) const {
  Real sum = 0;
  for (int lane = 0; lane < 4 && group * 4 + lane < patches_; ++lane) sum += size[lane];
  return sum;
}

template <int D>
Real SurfacePatches<D>::measure(Size size, const NodalVector* u) const {
  NodalVectors x(X_.size());
  place(u, x);
  return size_of_all(size, x);
}

template <int D>
Real SurfacePatches<D>::size_of_all(Size size, const NodalVectors& x) const {
  return parallel_sum(group_count(), 0.0, [&](Index g) {
    return sum_of_patches(g, group_size<Lanes>(size, corners(g, x), nullptr));
  });
}

template <int D>
Dual<Real> SurfacePatches<D>::measure(Size size, const NodalVector* u,
                                      const NodalVector* du) const {
  NodalVectors x(X_.size());
  place(u, x);
  const NodalVectors dx = values(du);
  return parallel_sum(group_count(), Dual<Real>(0.0), [&](Index g) -> Dual<Real> {
    const auto sizes = group_size<Dual<Lanes>>(size, corners(g, x, dx), nullptr);
    return {sum_of_patches(g, sizes.v), sum_of_patches(g, sizes.d)};
  });
}

template <int D>
Real SurfacePatches<D>::follow(Size size, const NodalVector* u) {
  const Division& division = windows_.division();
  if (!division.has_some()) return 0;
  parallel_for(division.own_rows(point_count()), [&](Index q) { at(x_, q) = place_of(q, u); });
  if (!division.is_whole()) division.complete_rows(point_count(), x_.data(), sizeof(NodalVector));
  return parallel_sum(group_count(), 0.0, [&](Index g) {
    return sum_of_patches(g,
                          group_size(size, corners(g, x_),
                                     gradient_.data() + static_cast<std::size_t>(g) * nodes * D));
  });
}

template <int D>
void SurfacePatches<D>::add_gradient(Real factor, std::span<NodalVector> force) {
  add_to_particles(factor, gradient_, force);
}

template <int D>
void SurfacePatches<D>::add_gradient_change(Size size, const NodalVector* u, const NodalVector* du,
                                            const Dual<Real>& factor,
                                            std::span<NodalVector> force) {
  NodalVectors x(X_.size());
  place(u, x);
  const NodalVectors dx = values(du);
  AlignedVector<Lanes> change(gradient_.size());
  parallel_for(group_count(), [&](Index g) {
    std::array<Dual<Lanes>, nodes * D> gradient;
    group_size(size, corners(g, x, dx), gradient.data());
    for (int k = 0; k < nodes * D; ++k)
      at(change, g * nodes * D + k) = factor.v * at(gradient, k).d + factor.d * at(gradient, k).v;
  });
  add_to_particles(1, change, force);
}

template <int D>
void SurfacePatches<D>::add_to_particles(Real factor, const AlignedVector<Lanes>& gradient,
                                         std::span<NodalVector> force) {
  windows_.accumulate(force, [&](int, Index begin, Index end, NodalVector* f) {
    for (Index q = begin; q < end; ++q) {
      Lanes sum = Lanes::zero();
      for (Index s = at(share_begin_, q); s < at(share_begin_, q + 1); ++s) {
        const Share& share = at(share_, s);
        for (int i = 0; i < D; ++i)
          sum.set(i, sum[i] + gradient[share.entry + static_cast<std::size_t>(i)][share.lane]);
      }
      if (meniscus::sum(sum * sum) != 0) scatter_value(rows_, q, factor * sum, f);
    }
  });
}

template <int D>
std::size_t SurfacePatches<D>::bytes() const {
  return rows_.bytes() + windows_.bytes() + node_.size() * sizeof(node_.front()) +
         X_.size() * sizeof(Vec<D>) + share_begin_.size() * sizeof(Index) +
         share_.size() * sizeof(Share) + (x_.size() + gradient_.size()) * sizeof(Lanes);
}

template class SurfacePatches<2>;
template class SurfacePatches<3>;

}  // namespace meniscus
