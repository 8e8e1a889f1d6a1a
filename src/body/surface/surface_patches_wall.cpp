// SPDX-License-Identifier: BSD-3-Clause
// Points of wetted faces, which lie on walls (sharp line note 1).
#include "body/surface/patch_sums.hpp"
#include "meniscus/error.hpp"
#include "numbers/dense.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace meniscus {
namespace {

template <int D>
std::array<Real, D> components(const NodalVector& v) {
  std::array<Real, D> c;
  for (int i = 0; i < D; ++i) at(c, i) = v[i];
  return c;
}

template <int D>
std::array<Dual<Real>, D> components(const NodalVector& v, const NodalVector& dv) {
  std::array<Dual<Real>, D> c;
  for (int i = 0; i < D; ++i) at(c, i) = {v[i], dv[i]};
  return c;
}

/// The place before it was moved to the wall.
template <int D>
NodalVector before(const WettedWall<D>& wall, const NodalVector& place) {
  const auto foot = wall.foot_above(components<D>(place), place[3]);
  NodalVector y = Lanes::zero();
  for (int i = 0; i < D; ++i) y.set(i, place[i] + foot.distance * at(foot.normal, i));
  return y;
}

}  // namespace

template <int D>
void SurfacePatches<D>::list_walls(const Body<D>& body) {
  if (body.wetted.empty()) return;
  wall_of_.assign(X_.size(), -1);
  for (const WettedFace<D>& face : body.wetted) {
    for (Index patch = 0; patch < patches_; ++patch) {
      if (body.geometry.surface->face_name(at(body.geometry.grid.facets, patch).patch) != face.face)
        continue;
      for (const Index point : at(node_, patch)) {
        const auto number = static_cast<std::int8_t>(walls_.size());
        if (at(wall_of_, point) >= 0 && at(wall_of_, point) != number)
          throw InputError(fmt::format(
              "body '{}': the wetted faces '{}' and '{}' have points in common; allowed are faces "
              "that do not touch each other",
              body.name, at(walls_, at(wall_of_, point)).face.face, face.face));
        at(wall_of_, point) = number;
      }
    }
    walls_.push_back({face, face.wall, Vec<D>::Zero()});
  }
  wall_forces_ = chunk_sums_.template tally<WallForce>();
}

template <int D>
void SurfacePatches<D>::at_time(Real time) const {
  for (Wetted& wetted : walls_) {
    if (wetted.face.displacement.empty()) continue;
    wetted.wall = wetted.face.wall_at(time);
    wetted.velocity = wetted.face.velocity_at(time);
  }
}

template <int D>
const WettedWall<D>& SurfacePatches<D>::wall_of_face(const std::string& face) const {
  return std::find_if(walls_.begin(), walls_.end(),
                      [&](const Wetted& wetted) { return wetted.face.face == face; })
      ->wall;
}

template <int D>
void SurfacePatches<D>::move_to_wall(Index point, NodalVector& place) const {
  const WettedWall<D>* wall = wall_of(point);
  if (!wall) return;
  const auto foot = wall->template foot<Real>(components<D>(place));
  for (int i = 0; i < D; ++i) place.set(i, at(foot.x, i));
  place.set(3, foot.distance);
}

template <int D>
NodalVector SurfacePatches<D>::projected(Index point, const NodalVector& place,
                                         const NodalVector& g) const {
  const WettedWall<D>* wall = wall_of(point);
  if (!wall) return g;
  const auto along =
      wall->project(wall->foot_above(components<D>(place), place[3]), components<D>(g));
  NodalVector p = Lanes::zero();
  for (int i = 0; i < D; ++i) p.set(i, at(along, i));
  return p;
}

template <int D>
typename SurfacePatches<D>::ChangingGradient SurfacePatches<D>::changing_gradient() const {
  ChangingGradient gradient;
  gradient.change.assign(gradient_.size(), Lanes::zero());
  if (on_walls()) gradient.value = gradient.change;
  return gradient;
}

template <int D>
void SurfacePatches<D>::add_changes_to_particles(const ChangingGradient& gradient,
                                                 const NodalVectors& x, const NodalVector* du,
                                                 const ForceVector& force) {
  add_to_particles(force, [&](Index q) {
    const NodalVector dg = gradient_of_point(q, gradient.change);
    const WettedWall<D>* wall = wall_of(q);
    if (!wall) return dg;
    const NodalVector g = gradient_of_point(q, gradient.value), y = before(*wall, at(x, q));
    const auto along =
        wall->project(wall->template foot<Dual<Real>>(components<D>(y, value_at(rows_, q, du))),
                      components<D>(g, dg));
    NodalVector change = Lanes::zero();
    for (int i = 0; i < D; ++i) change.set(i, at(along, i).d);
    return change;
  });
}

/// The places of points feel the forces f = - factor g, which have the resultant zero or that of a
/// load. Coefficients get DP^T f instead, at the places y before they were moved to the wall.
template <int D>
ChunkTally<typename SurfacePatches<D>::WallForce>& SurfacePatches<D>::wall_forces(
    Real factor, const std::string& face) {
  chunk_sums_.for_own_chunks([&](int chunk, Index begin, Index end) {
    WallForce sum;
    for (Index q = begin; q < end; ++q) {
      const WettedWall<D>* wall = wall_of(q);
      if (!wall || (!face.empty() && at(walls_, at(wall_of_, q)).face.face != face)) continue;
      const NodalVector f = -factor * gradient_of_point(q, gradient_),
                        moved = projected(q, at(x_, q), f), y = before(*wall, at(x_, q));
      NodalVector x = at(x_, q);
      x.set(3, 0.0);
      const Vec<D>& velocity = at(walls_, at(wall_of_, q)).velocity;
      sum.total += Resultant(spatial(moved - f),
                             cross(spatial(y), spatial(moved)) - cross(spatial(x), spatial(f)));
      for (int i = 0; i < D; ++i) sum.power += (moved[i] - f[i]) * velocity[i];
    }
    wall_forces_[chunk] = sum;
  });
  return wall_forces_;
}

template <int D>
std::vector<Real> tension_shares(const Body<D>& body, Real gamma) {
  std::vector<Real> share;
  for (const Facet<D>& facet : body.geometry.grid.facets) {
    const std::string face = body.geometry.surface->face_name(facet.patch);
    share.push_back(1);
    for (const WettedFace<D>& wetted : body.wetted)
      if (wetted.face == face) share.back() = wetted.relative + wetted.absolute / gamma;
  }
  return share;
}

#define MENISCUS_INSTANTIATE(D)                                                                    \
  template void SurfacePatches<D>::list_walls(const Body<D>&);                                     \
  template void SurfacePatches<D>::at_time(Real) const;                                            \
  template const WettedWall<D>& SurfacePatches<D>::wall_of_face(const std::string&) const;         \
  template void SurfacePatches<D>::move_to_wall(Index, NodalVector&) const;                        \
  template NodalVector SurfacePatches<D>::projected(Index, const NodalVector&, const NodalVector&) \
      const;                                                                                       \
  template typename SurfacePatches<D>::ChangingGradient SurfacePatches<D>::changing_gradient()     \
      const;                                                                                       \
  template void SurfacePatches<D>::add_changes_to_particles(                                       \
      const ChangingGradient&, const NodalVectors&, const NodalVector*, const ForceVector&);       \
  template ChunkTally<typename SurfacePatches<D>::WallForce>& SurfacePatches<D>::wall_forces(      \
      Real, const std::string&);                                                                   \
  template std::vector<Real> tension_shares(const Body<D>&, Real);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
