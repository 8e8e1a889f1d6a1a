// SPDX-License-Identifier: BSD-3-Clause
// Area and enclosed volume of patches through material points.
#include "body/surface/surface_patches.hpp"

#include "body/grid/gauss.hpp"
#include "body/surface/patch_sums.hpp"
#include "body/surface/surface_points.hpp"
#include "kernel/row_sums.hpp"

#include <algorithm>

namespace meniscus {
namespace {

/// Gauss points per direction of a patch. Three integrate the volume exactly, but not the area.
/// With three points, a plane patch whose stretch is zero at its middle is measured too short by a
/// percent. A tension then drives an edge to a cusp, at which explicit steps gain energy
/// (static-drop note 1). In 3D no such cusp was found.
template <int D>
constexpr int points_of_area = D == 2 ? 5 : 3;

}  // namespace

template <int D>
SurfacePatches<D>::SurfacePatches(const Body<D>& body)
    : revolved_(body.geometry.grid.revolved),
      gauss_(patch_functions<D>(points_of_area<D>)),
      patches_(static_cast<Index>(body.geometry.grid.facets.size())) {
  number_points(body.geometry);
  rows_ = build_point_rows<D>(body.particles, X_, {.value = true}, body.name);
  chunk_sums_ = body.chunk_sums(rows_.start, rows_.particle);
  list_shares();
  list_walls(body);
  x_.assign(X_.size(), Lanes::zero());
  for (Index q = 0; q < point_count(); ++q) set_vector<D>(x_, q, at(X_, q));
  area_ = size_of_all(Size::area, x_);
  volume_ = size_of_all(Size::volume, x_);
  gradient_.assign(static_cast<std::size_t>(group_count()) * nodes * D, Lanes::zero());
  moments_ = chunk_sums_.template tally<Eigen::Vector3d>();
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
  move_to_wall(point, place);
  return place;
}

template <int D>
void SurfacePatches<D>::place(const NodalVector* u, NodalVectors& x) const {
  parallel_for(point_count(), [&](Index q) { at(x, q) = place_of(q, u); });
}

template <int D>
NodalVectors SurfacePatches<D>::changes(const NodalVectors& x, const NodalVector* du) const {
  NodalVectors sums(X_.size());
  parallel_for(point_count(),
               [&](Index q) { at(sums, q) = projected(q, at(x, q), value_at(rows_, q, du)); });
  return sums;
}

template <int D>
typename SurfacePatches<D>::template Corners<Lanes> SurfacePatches<D>::corners(
    Index group, const NodalVectors& x) const {
  Lanes origin = x.front();
  if (revolved_) origin.set(0, 0);
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
    return sum_of_patches(g, group_size<Lanes>(size, g, corners(g, x), nullptr));
  });
}

template <int D>
Dual<Real> SurfacePatches<D>::measure(Size size, const NodalVector* u,
                                      const NodalVector* du) const {
  NodalVectors x(X_.size());
  place(u, x);
  const NodalVectors dx = changes(x, du);
  return parallel_sum(group_count(), Dual<Real>(0.0), [&](Index g) -> Dual<Real> {
    const auto sizes = group_size<Dual<Lanes>>(size, g, corners(g, x, dx), nullptr);
    return {sum_of_patches(g, sizes.v), sum_of_patches(g, sizes.d)};
  });
}

template <int D>
void SurfacePatches<D>::place(const NodalVector* u) {
  parallel_for(own_points(), [&](Index q) { at(x_, q) = place_of(q, u); });
}

template <int D>
Gathered SurfacePatches<D>::places() {
  // If one rank has all points, nobody else needs them.
  const Division& division = chunk_sums_.division();
  return {x_.data(), (division.is_whole() ? Division::to_each() : division).rows(point_count())};
}

template <int D>
Real SurfacePatches<D>::follow(Size size) {
  if (!chunk_sums_.division().has_some()) return 0;
  return parallel_sum(group_count(), 0.0, [&](Index g) {
    return sum_of_patches(g,
                          group_size(size, g, corners(g, x_),
                                     gradient_.data() + static_cast<std::size_t>(g) * nodes * D));
  });
}

template <int D>
void SurfacePatches<D>::add_gradient(Real factor, const ForceVector& force) {
  add_to_particles(force, [&](Index q) {
    return factor * projected(q, at(x_, q), gradient_of_point(q, gradient_));
  });
}

template <int D>
void SurfacePatches<D>::add_gradient_change(Size size, const NodalVector* u, const NodalVector* du,
                                            const Dual<Real>& factor, const ForceVector& force) {
  NodalVectors x(X_.size());
  place(u, x);
  const NodalVectors dx = changes(x, du);
  ChangingGradient sum = changing_gradient();
  parallel_for(group_count(), [&](Index g) {
    std::array<Dual<Lanes>, nodes * D> gradient;
    group_size(size, g, corners(g, x, dx), gradient.data());
    for (int k = 0; k < nodes * D; ++k)
      sum.set(g * nodes * D + k, Dual<Lanes>(factor) * at(gradient, k));
  });
  add_changes_to_particles(sum, x, du, force);
}

template <int D>
NodalVector SurfacePatches<D>::gradient_of_point(Index point,
                                                 const AlignedVector<Lanes>& gradient) const {
  Lanes sum = Lanes::zero();
  for (Index s = at(share_begin_, point); s < at(share_begin_, point + 1); ++s) {
    const Share& share = at(share_, s);
    for (int i = 0; i < D; ++i)
      sum.set(i, sum[i] + gradient[share.entry + static_cast<std::size_t>(i)][share.lane]);
  }
  return sum;
}

template <int D>
void SurfacePatches<D>::add_to_particles(Real factor, const AlignedVector<Lanes>& gradient,
                                         const ForceVector& force) {
  add_to_particles(force, [&](Index q) { return factor * gradient_of_point(q, gradient); });
}

template <int D>
void SurfacePatches<D>::share_area(const std::vector<Real>& of_patch) {
  area_share_.assign(static_cast<std::size_t>(group_count()), Lanes::zero());
  for (Index patch = 0; patch < patches_; ++patch)
    at(area_share_, patch / 4).set(patch % 4, at(of_patch, patch));
}

template <int D>
std::vector<Real> SurfacePatches<D>::areas(const NodalVector* u) const {
  NodalVectors x(X_.size());
  place(u, x);
  std::vector<Real> areas(static_cast<std::size_t>(patches_));
  parallel_for(group_count(), [&](Index g) {
    const Lanes of_group = group_area<Lanes>(corners(g, x), nullptr);
    for (int lane = 0; lane < 4 && g * 4 + lane < patches_; ++lane)
      at(areas, g * 4 + lane) = of_group[lane];
  });
  return areas;
}

template <int D>
std::vector<Vec<D>> SurfacePatches<D>::places_at(const NodalVector* u) const {
  NodalVectors x(X_.size());
  place(u, x);
  std::vector<Vec<D>> places;
  for (Index q = 0; q < point_count(); ++q) places.push_back(vector_at<D>(x, q));
  return places;
}

template <int D>
NodalVectors SurfacePatches<D>::velocities(const NodalVector* u, const NodalVector* v) const {
  NodalVectors x(X_.size());
  place(u, x);
  return changes(x, v);
}

template <int D>
std::size_t SurfacePatches<D>::bytes() const {
  return rows_.bytes() + chunk_sums_.bytes() + node_.size() * sizeof(node_.front()) +
         X_.size() * sizeof(Vec<D>) + share_begin_.size() * sizeof(Index) +
         share_.size() * sizeof(Share) +
         (x_.size() + gradient_.size() + volume_gradient_.size()) * sizeof(Lanes);
}

template class SurfacePatches<2>;
template class SurfacePatches<3>;

}  // namespace meniscus
