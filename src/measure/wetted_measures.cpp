// SPDX-License-Identifier: BSD-3-Clause
// Measures of drops with wetted faces.
#include "measure/wetted_measures.hpp"

#include "body/surface/surface_patches.hpp"
#include "body/surface/wetted_points.hpp"
#include "measure/young_laplace.hpp"
#include "numbers/dense.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>

namespace meniscus {
namespace {

constexpr Real without_meaning = std::numeric_limits<Real>::quiet_NaN();

template <int D>
Vec<D> area_vector(const CellPoint<D, D - 1>& at) {
  if constexpr (D == 3)
    return cross(Eigen::Vector3d(at.J.col(0)), Eigen::Vector3d(at.J.col(1)));
  else
    return Vec<2>(at.J(1, 0), -at.J(0, 0));
}

/// The surface of the drop as the forces see it, made when a measure is first computed.
template <int D>
class WettedSurface {
  static constexpr int nodes = PatchFunctions<D>::nodes;

 public:
  WettedSurface(const Body<D>& body, WettedFace<D> face, WettingDrop<D> drop)
      : body_(body), face_(std::move(face)), drop_(std::move(drop)) {}

  Real wetted_area(const Motion& motion) { return sum_of_face(patches().areas(own(motion.u))); }
  Real base_radius(const Motion& motion) {
    return base(patches_at(motion).places_at(own(motion.u)));
  }

  Real height(const Motion& motion) {
    const std::vector<Vec<D>> x = patches_at(motion).places_at(own(motion.u));
    Real highest = 0;
    for (Index p = 0; p < patches().patch_count(); ++p)
      if (!at(is_wetted_, p)) highest = std::max(highest, highest_on(p, x));
    return highest;
  }

  Real volume(const Motion& motion) {
    return patches_at(motion).measure(SurfacePatches<D>::Size::volume, own(motion.u));
  }
  /// Above a plane.
  Real centroid_height(const Motion& motion) {
    const Vec<D> up = -mean_normal(patches_at(motion).places_at(own(motion.u)));
    return patches().height(up, own(motion.u)) - up.dot(wall().point());
  }

  Real contact_angle(const Motion& motion) {
    const std::vector<Vec<D>> x = patches_at(motion).places_at(own(motion.u));
    const WettedWall<D>& on = wall();
    const Real a = base(x), V = volume(motion);
    const Vec<D> weight = drop_.weight(motion.time) / (drop_.tension * V), normal = mean_normal(x);
    if (drop_.other_weight) return without_meaning;
    Real angle;
    if (on.is_plane()) {
      const Real down = weight.dot(normal);
      if ((weight - down * normal).norm() > 1e-9 * weight.norm()) return without_meaning;
      angle = profile(a, V, down).contact_angle;
    } else {
      if (weight.norm() > 0 || on.axis().norm() > 0) return without_meaning;
      // The plane through the line cuts a cap off the wall, which is part of a drop on a ball, and
      // of the hole in a cavity.
      const Real turn = std::asin(std::min(a / on.radius(), 1.0));
      const Real inside = is_inside(x) ? 1 : -1;
      const Real unit = cap_volume(turn, on.radius());
      angle = profile(a, V - inside * unit, 0).contact_angle + inside * turn;
    }
    return angle * 180 / std::numbers::pi;
  }

  /// The points of the face feel the gradients of all energies of the patches; the wall takes what
  /// is normal to it.
  Eigen::Vector3d force(const Motion& motion) {
    SurfacePatches<D>& all = patches_at(motion);
    all.place(own(motion.u));
    GatherTogether()({{all.places()}});
    all.follow(SurfacePatches<D>::Size::area);
    Eigen::Vector3d on_body = drop_.hold(motion) + force_of_wall(drop_.tension);
    all.follow(SurfacePatches<D>::Size::volume);
    on_body += force_of_wall(-drop_.pressure(motion));
    if (const Vec<D> weight = drop_.weight(motion.time); weight.norm() > 0) {
      all.follow_height(weight);
      on_body += force_of_wall(-1);
    }
    return -on_body;
  }

  Real line_speed(const Motion& motion) {
    const std::vector<Vec<D>> x = patches_at(motion).places_at(own(motion.u));
    const NodalVectors v = patches().velocities(own(motion.u), own(motion.v));
    const Vec<D> of_wall = face_.velocity_at(motion.time);
    Real sum = 0, length = 0;
    for (const LinePart<D>& part : line_) {
      if constexpr (D == 3) {
        for (const PatchFunctions<2>& f : patch_functions<2>(3)) {
          Vec<3> t = Vec<3>::Zero(), w = Vec<3>::Zero(), place = Vec<3>::Zero();
          for (int b = 0; b < 3; ++b) {
            const Index q = at(part.point, b);
            t += at(f.dL[0], b) * at(x, q);
            w += at(f.L, b) * vector_at<3>(v, q);
            place += at(f.L, b) * at(x, q);
          }
          Vec<3> out = place - at(x, part.behind);
          out -= t * (t.dot(out) / t.squaredNorm());
          const Real dl = f.weight * t.norm();
          sum += dl * (w - of_wall).dot(out.normalized());
          length += dl;
        }
      } else {
        const Index q = part.point[0];
        sum += (vector_at<2>(v, q) - of_wall).dot((at(x, q) - at(x, part.behind)).normalized());
        length += 1;
      }
    }
    return sum / length;
  }

 private:
  const NodalVector* own(std::span<const NodalVector> field) const {
    return field.data() + body_.first;
  }
  /// At the time of the last patches_at().
  const WettedWall<D>& wall() const { return patches_->wall_of_face(face_.face); }
  SurfacePatches<D>& patches_at(const Motion& motion) {
    patches().at_time(motion.time);
    return *patches_;
  }
  SurfacePatches<D>& patches() {
    if (patches_) return *patches_;
    patches_ = body_.shared.template get<SurfacePatches<D>>("patches of measures", [this] {
      auto made = std::make_shared<SurfacePatches<D>>(body_);
      made->share_area(tension_shares(body_, drop_.tension));
      return made;
    });
    for (const Facet<D>& facet : body_.geometry.grid.facets)
      is_wetted_.push_back(body_.geometry.surface->face_name(facet.patch) == face_.face);
    // Numbers of points of the face become numbers of points of all patches.
    const WettedPoints<D> points(body_.geometry, face_.face);
    line_ = points.line;
    for (LinePart<D>& part : line_) {
      for (Index& q : part.point) q = at(points.number_on_surface, q);
      part.behind = at(points.number_on_surface, part.behind);
    }
    return *patches_;
  }
  /// On the points of the face, against factor x the gradient that was followed last.
  Eigen::Vector3d force_of_wall(Real factor) {
    auto& of_chunks = patches_->wall_forces(factor, face_.face);
    GatherTogether()({{of_chunks.gathered()}});
    return of_chunks.sum({}).total.force;
  }
  Real sum_of_face(const std::vector<Real>& of_patches) const {
    Real sum = 0;
    for (std::size_t p = 0; p < of_patches.size(); ++p)
      if (is_wetted_[p]) sum += of_patches[p];
    return sum;
  }
  /// The integral of the area vector over the wetted face, which depends on the line only.
  Vec<D> face_vector(const std::vector<Vec<D>>& x) const {
    static const auto gauss = patch_functions<D>(3);
    Vec<D> sum = Vec<D>::Zero();
    for (Index p = 0; p < patches_->patch_count(); ++p)
      if (at(is_wetted_, p))
        for (const PatchFunctions<D>& f : gauss)
          sum += f.weight * ring_vector(patch_place<D>(f, patches_->points_of(p), x));
    if (revolved()) sum[0] = 0;
    return sum;
  }
  /// Points out of the drop.
  Vec<D> mean_normal(const std::vector<Vec<D>>& x) const { return face_vector(x).normalized(); }
  Real base(const std::vector<Vec<D>>& x) const {
    const Real size = face_vector(x).norm();
    return body_.space() == 3 ? std::sqrt(size / std::numbers::pi) : size / 2;
  }
  bool revolved() const { return body_.geometry.grid.revolved; }
  /// The area vector of a point; in a body of revolution that of its circle.
  Vec<D> ring_vector(const CellPoint<D, D - 1>& at) const {
    return (revolved() ? 2 * std::numbers::pi * at.X[0] : 1) * area_vector<D>(at);
  }
  DropProfile<3> profile(Real base, Real volume, Real bond) const {
    if (body_.space() == 3) return profile_on<3>(base, volume, bond);
    const DropProfile<2> plane = profile_on<2>(base, volume, bond);
    return {plane.base_radius,   plane.volume,    plane.height,
            plane.contact_angle, plane.free_area, plane.centroid};
  }
  /// True for a drop in a cavity: points of its free surface are inside of the wall.
  bool is_inside(const std::vector<Vec<D>>& x) const {
    Real sum = 0;
    for (const Vec<D>& place : x) sum += distance(place);
    return sum < 0;
  }
  Real distance(const Vec<D>& x) const {
    std::array<Real, D> y;
    for (int i = 0; i < D; ++i) at(y, i) = x[i];
    return wall().template foot<Real>(y).distance;
  }
  Real cap_volume(Real theta, Real R) const {
    const Real c = std::cos(theta);
    if (body_.space() == 3) return std::numbers::pi * R * R * R * (2 + c) * (1 - c) * (1 - c) / 3;
    return R * R * (theta - std::sin(theta) * c);
  }
  /// The greatest distance from the wall on a patch: the best of 5 places per direction, then of 5
  /// places around it, and so on.
  Real highest_on(Index patch, const std::vector<Vec<D>>& x) const {
    constexpr int levels = 12;
    Vec<D - 1> centre = Vec<D - 1>::Zero();
    Real highest = 0, half = 1;
    for (int level = 0; level < levels; ++level, half *= 0.5) {
      Vec<D - 1> best = centre;
      for (int k = 0; k < (D == 3 ? 25 : 5); ++k) {
        Vec<D - 1> xi = centre;
        xi[0] += half * (k % 5 - 2) / 2;
        if constexpr (D == 3) xi[1] += half * (k / 5 - 2) / 2;
        for (int i = 0; i < D - 1; ++i) xi[i] = std::clamp(xi[i], -1.0, 1.0);
        const Real above = std::abs(
            distance(patch_place<D>(PatchFunctions<D>(xi), patches_->points_of(patch), x).X));
        if (above <= highest) continue;
        highest = above;
        best = xi;
      }
      centre = best;
    }
    return highest;
  }

  const Body<D>& body_;
  WettedFace<D> face_;
  WettingDrop<D> drop_;
  std::shared_ptr<SurfacePatches<D>> patches_;
  std::vector<std::uint8_t> is_wetted_;  // [patch]
  std::vector<LinePart<D>> line_;
};

}  // namespace

template <int D>
std::vector<MeasureSource> wetted_measures(const Body<D>& body, const WettedFace<D>& face,
                                           WettingDrop<D> drop) {
  const auto surface = std::make_shared<WettedSurface<D>>(body, face, std::move(drop));
  std::vector<MeasureSource> measures{
      {body.space() == 3 ? "wetted_area" : "wetted_length", of_sum(dimension::area, D),
       "size of the wetted face",
       [surface](const Motion& motion) { return surface->wetted_area(motion); }},
      {"base_radius", dimension::length,
       "radius of the disk inside the contact line (2D: half the length)",
       [surface](const Motion& motion) { return surface->base_radius(motion); }},
      {"volume", of_sum(dimension::volume, D),
       "inside the surface that pressure and tension see (2D: area)",
       [surface](const Motion& motion) { return surface->volume(motion); }},
      {"height", dimension::length, "greatest distance of the surface from the wall",
       [surface](const Motion& motion) { return surface->height(motion); }},
      {"line_speed", dimension::velocity,
       "mean speed of the contact line, positive if the drop spreads",
       [surface](const Motion& motion) { return surface->line_speed(motion); }}};
  for (int i = body.geometry.grid.revolved ? 1 : 0; i < D; ++i)
    measures.push_back({std::string("force_") + "xyz"[i], of_sum(dimension::force, D),
                        "force of the drop on the wall",
                        [surface, i](const Motion& motion) { return surface->force(motion)[i]; }});
  if (face.wall.is_plane())
    measures.push_back(
        {"centroid_height", dimension::length,
         "distance of the centroid of this volume from the wall",
         [surface](const Motion& motion) { return surface->centroid_height(motion); }});
  if (face.wall.axis().norm() == 0)
    measures.push_back(
        {"contact_angle", dimension::none,
         "degrees, of the profile of Young and Laplace with this base radius, "
         "volume and weight",
         [surface](const Motion& motion) { return surface->contact_angle(motion); }});
  return measures;
}

template std::vector<MeasureSource> wetted_measures(const Body<2>&, const WettedFace<2>&,
                                                    WettingDrop<2>);
template std::vector<MeasureSource> wetted_measures(const Body<3>&, const WettedFace<3>&,
                                                    WettingDrop<3>);

}  // namespace meniscus
