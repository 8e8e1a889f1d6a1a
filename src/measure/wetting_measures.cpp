// SPDX-License-Identifier: BSD-3-Clause
// Wetted area of a drop on a wall, and its contact angle by a spherical cap and by a profile.
#include "measure/wetting_measures.hpp"

#include "measure/profile_fit.hpp"
#include "numbers/dense.hpp"
#include "physics/surface/closed_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <numeric>
#include <optional>

namespace meniscus {
namespace {

constexpr Real degree = std::numbers::pi / 180;

/// The rate of a length, by a central difference along the motion over a distance of 1e-4 of the
/// length.
Real rate_of(const std::function<Real(const Motion&)>& length, const Motion& motion) {
  Real square = 0;
  for (const NodalVector& v : motion.v) square = std::max(square, sum(v * v));
  const Real dt = square > 0 ? 1e-4 * length(motion) / std::sqrt(square) : 0;
  if (!(dt > 0)) return 0;
  const auto moved = [&](Real by) {
    NodalVectors u(motion.u.begin(), motion.u.end());
    for (std::size_t A = 0; A < u.size(); ++A) at(u, A) += by * at(motion.v, A);
    return length({motion.time + by, u, motion.v, motion.fields});
  };
  return (moved(dt) - moved(-dt)) / (2 * dt);
}

/// The surface of a drop near a wall.
template <int D>
class NearWall {
 public:
  NearWall(const Body<D>& body, const DropOnWall<D>& wall, int per_direction)
      : body_(body), wall_(wall), per_direction_(per_direction) {}

  struct Points {
    std::vector<Vec<D>> x;
    std::vector<Real> area, height;
    Real film, top;
    Real wet;  ///< area of the film
  };
  Points points(const Motion& motion) {
    const auto placed = surface().placed(motion);
    const std::vector<Real>& reference = surface().reference().area;
    Points points;
    Real least = std::numeric_limits<Real>::max(), sum = 0;
    points.top = -least;
    points.wet = 0;
    for (std::size_t q = 0; q < reference.size(); ++q) {
      const auto point = static_cast<Index>(q);
      points.x.push_back(placed.place(point));
      points.area.push_back(placed.area_vector(point).norm() * reference[q]);
      points.height.push_back(wall_.foot(points.x.back(), motion.time).distance);
      const Real height = points.height.back();
      least = std::min(least, height);
      points.top = std::max(points.top, height);
      if (height > wall_.film_gap) continue;
      points.wet += points.area.back();
      sum += points.area.back() * height;
    }
    points.film = points.wet > 0 ? sum / points.wet : least;
    return points;
  }
  const ClosedSurface<D>& surface() {
    if (!surface_) surface_.emplace(body_, SurfacePart::outer, per_direction_);
    return *surface_;
  }
  const Body<D>& body() const { return body_; }
  const DropOnWall<D>& wall() const { return wall_; }

 private:
  const Body<D>& body_;
  DropOnWall<D> wall_;
  int per_direction_;
  std::optional<ClosedSurface<D>> surface_;
};

/// The curvature at a foot of the surface at its distance: 0 above a plane, 1/r at the distance r
/// from the centre of a ball, -1/r in a cavity.
template <int D>
Real curvature_of(const typename PartnerShape<D>::Foot& foot) {
  return foot.bend.trace() / (D - 1);
}

/// The sphere (2D: circle) of a drop on a wall.
template <int D>
class Cap {
 public:
  Cap(const Body<D>& body, const DropOnWall<D>& wall) : near_(body, wall, 6) {}

  Real film(const Motion& motion) { return near_.points(motion).film; }
  Real angle(const Motion& motion) {
    const auto [z, r, bend] = sphere(motion);
    const Real cosine = (bend * (r * r + z * z) - 2 * z) / (2 * r * (1 - bend * z));
    return std::acos(std::clamp(cosine, -1.0, 1.0));
  }
  Real height(const Motion& motion) {
    const Sphere s = sphere(motion);
    return s.centre + s.radius;
  }
  Real angle_of_volume(const Motion& motion) {
    const Real slab = near_.wall().line(motion).depth * near_.points(motion).wet;
    const Real volume = near_.surface().placed(motion).size.volume + slab;
    return near_.body().space() == 3 ? angle_of_cap<3>(volume, height(motion))
                                     : angle_of_cap<2>(volume, height(motion));
  }

 private:
  /// A sphere with the height of its centre above the surface of contact. `bend` is the curvature
  /// of the surface parallel to the wall through this centre.
  struct Sphere {
    Real centre, radius, bend;
  };

  /// Least-squares sphere from |x|^2 - 2 c.x - k, weighted by area, over the surface above 0.35 of
  /// the height. Positions count from their mean.
  Sphere sphere(const Motion& motion) {
    constexpr Real free_above = 0.35;
    const auto p = near_.points(motion);
    const Real least = p.film + free_above * (p.top - p.film);
    Vec<D> mean = Vec<D>::Zero();
    Real area = 0;
    for (std::size_t q = 0; q < p.x.size(); ++q)
      if (p.height[q] > least) {
        mean += p.area[q] * p.x[q];
        area += p.area[q];
      }
    mean /= area;
    const bool revolved = near_.body().geometry.grid.revolved;
    if (revolved) mean[0] = 0;  // the centre is on the axis
    Mat<D + 1> normal = Mat<D + 1>::Zero();
    Vec<D + 1> right = Vec<D + 1>::Zero();
    for (std::size_t q = 0; q < p.x.size(); ++q)
      if (p.height[q] > least) {
        Vec<D + 1> row;
        row << 2 * (p.x[q] - mean), 1;
        if (revolved) row[0] = 0;
        normal += p.area[q] * row * row.transpose();
        right += p.area[q] * (p.x[q] - mean).squaredNorm() * row;
      }
    if (revolved) normal(0, 0) = normal.trace();
    const Vec<D + 1> solution = solve_symmetric(normal, right);
    const Vec<D> c = solution.template head<D>();
    const auto foot = near_.wall().foot(mean + c, motion.time);
    return {foot.distance - p.film + near_.wall().line(motion).depth,
            std::sqrt(solution[D] + c.squaredNorm()), curvature_of<D>(foot)};
  }

  NearWall<D> near_;
};

/// The mean velocity of a body.
template <int D>
Vec<D> velocity_of_drop(const Body<D>& body, const Motion& motion) {
  const auto v = body.part(motion.v);
  Vec<D> momentum = Vec<D>::Zero();
  Real mass = 0;
  for (Index A = 0; A < body.size(); ++A) {
    momentum += at(body.mass, A) * vector_at<D>(v, A);
    mass += at(body.mass, A);
  }
  if (body.geometry.grid.revolved) momentum[0] = 0;
  return momentum / mass;
}

/// The profile of a drop of revolution near a wall, from points of its section that are turned to
/// several directions.
LineAngles angles_around(const DropOnWall<2>& wall, const NearWall<2>::Points& p,
                         const std::vector<Vec<2>>& x, const std::vector<Real>& area, Vec<2> mean,
                         const Motion& motion) {
  constexpr int directions = 8;
  std::vector<Vec<3>> turned;
  std::vector<Real> areas;
  for (int k = 0; k < directions; ++k)
    for (std::size_t q = 0; q < x.size(); ++q) {
      const Real phi = 2 * std::numbers::pi * k / directions;
      turned.emplace_back(std::cos(phi) * x[q][0], x[q][1], std::sin(phi) * x[q][0]);
      areas.push_back(area[q] / directions);
    }
  mean[0] = 0;
  const auto foot = wall.foot(mean, motion.time);
  const Real above = foot.distance - p.film + wall.line(motion).depth, bend = foot.bend.trace();
  const Vec<3> n(0, foot.normal[1], 0);
  return fit_profile<3>(turned, areas,
                        {Vec<3>(0, mean[1], 0) - above * n, n, bend / (1 - bend * above)},
                        -wall.bond(motion.time).dot(foot.normal), Vec<3>::Unit(0));
}

/// The profile of a drop near a wall.
template <int D>
LineAngles angles_at(NearWall<D>& near, const Motion& motion) {
  constexpr Real pi = std::numbers::pi;
  const DropOnWall<D>& wall = near.wall();
  const auto p = near.points(motion);
  // The patches carry the bend near a wall on to where it has ended.
  constexpr Real bent = 0.3;
  const Real clear = std::max(wall.clear_gap, p.film + bent * (p.top - p.film));
  std::vector<Vec<D>> x;
  std::vector<Real> area;
  Vec<D> mean = Vec<D>::Zero();
  for (std::size_t q = 0; q < p.x.size(); ++q)
    if (std::all_of(wall.walls->begin(), wall.walls->end(),
                    [&](const auto& distance) { return distance(p.x[q], motion.time) > clear; })) {
      x.push_back(p.x[q]);
      area.push_back(p.area[q]);
      mean += p.area[q] * p.x[q];
    }
  constexpr std::size_t fewest = D == 3 ? 30 : 12;
  if (!(p.wet > 0) || x.size() < fewest) return {pi, pi, pi, 0};
  mean /= std::accumulate(area.begin(), area.end(), 0.0);
  if constexpr (D == 2)
    if (near.body().geometry.grid.revolved) return angles_around(wall, p, x, area, mean, motion);
  const auto foot = wall.foot(mean, motion.time);
  const Real above = foot.distance - p.film + wall.line(motion).depth, bend = curvature_of<D>(foot);
  const Vec<D> n = foot.normal, bond = wall.bond(motion.time);
  Vec<D> along = velocity_of_drop(near.body(), motion) - wall.velocity(motion.time);
  along -= along.dot(n) * n;
  if (along.norm() > 0)
    along.normalize();
  else
    along = tangents_to<D>(n).col(0);
  return fit_profile<D>(x, area, {mean - above * n, n, bend / (1 - bend * above)}, -bond.dot(n),
                        along);
}

}  // namespace

std::vector<MeasureSource> front_measures(std::function<Real(const Motion&)> wetted_area,
                                          LineAt line, int space_dimension) {
  const auto radius = [area = std::move(wetted_area), line = std::move(line),
                       space_dimension](const Motion& motion) {
    const Real disk =
        space_dimension == 3 ? std::sqrt(area(motion) / std::numbers::pi) : area(motion) / 2;
    return std::clamp(disk + line(motion).beyond, 0.0, 2 * disk);
  };
  return {{"base_radius", dimension::length, "of the contact line (2D: half its distance)", radius},
          {"line_speed", dimension::velocity, "rate of the base radius",
           [radius](const Motion& motion) { return rate_of(radius, motion); }}};
}

template <int D>
Real angle_of_cap(Real volume, Real height) {
  if constexpr (D == 3) {
    const Real square =
        (6 * volume / (std::numbers::pi * height) - height * height) / 3;  // base radius^2
    return square > 0 ? 2 * std::atan(height / std::sqrt(square)) : std::numbers::pi;
  } else {
    // (theta - sin theta cos theta) / (1 - cos theta)^2 falls from infinity to pi / 4.
    const Real ratio = volume / (height * height);
    Real low = 0, high = std::numbers::pi;
    for (int halving = 0; halving < 60; ++halving) {
      const Real middle = (low + high) / 2, c = 1 - std::cos(middle);
      const bool flatter = middle - std::sin(middle) * std::cos(middle) > ratio * c * c;
      (flatter ? low : high) = middle;
    }
    return high;
  }
}

template <int D>
std::vector<MeasureSource> cap_measures(const Body<D>& body, const DropOnWall<D>& wall) {
  const auto cap = std::make_shared<Cap<D>>(body, wall);
  std::vector<MeasureSource> all{
      {"film", dimension::length,
       "mean gap where the surface is in contact; least gap where it is not",
       [cap](const Motion& motion) { return cap->film(motion); }},
      {"contact_angle", dimension::degrees,
       "in degrees, of the sphere that fits the free surface best (2D: circle)",
       [cap](const Motion& motion) { return cap->angle(motion) / degree; }},
      {"height", dimension::length, "of the apex of that sphere over the wall",
       [cap](const Motion& motion) { return cap->height(motion); }}};
  if (wall.flat)
    all.push_back({"contact_angle_vh", dimension::degrees,
                   "in degrees, of the cap of this height and volume, with the gap below it",
                   [cap](const Motion& motion) { return cap->angle_of_volume(motion) / degree; }});
  return all;
}

template <int D>
std::vector<MeasureSource> profile_measures(const Body<D>& body, const DropOnWall<D>& wall) {
  const auto near = std::make_shared<NearWall<D>>(body, wall, D == 3 ? 3 : 6);
  const auto angle = [near](Real LineAngles::*of) {
    return [near, of](const Motion& motion) { return angles_at(*near, motion).*of / degree; };
  };
  return {{"contact_angle", dimension::degrees,
           "in degrees, of the profile that fits the free surface near the wall best",
           angle(&LineAngles::mean)},
          {"front_angle", dimension::degrees,
           "contact angle in the direction in which the drop moves along the wall",
           angle(&LineAngles::front)},
          {"rear_angle", dimension::degrees, "contact angle in the opposite direction",
           angle(&LineAngles::rear)},
          {"angle_error", dimension::degrees,
           "of the profile near the wall: its distance from the surface over its height",
           angle(&LineAngles::error)}};
}

#define MENISCUS_INSTANTIATE(D)                                                           \
  template Real angle_of_cap<D>(Real, Real);                                              \
  template std::vector<MeasureSource> cap_measures(const Body<D>&, const DropOnWall<D>&); \
  template std::vector<MeasureSource> profile_measures(const Body<D>&, const DropOnWall<D>&);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
