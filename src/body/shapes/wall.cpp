// SPDX-License-Identifier: BSD-3-Clause
// The map of the unit spherical shell onto a wall, and its body.
#include "body/shapes/wall.hpp"

#include "body/shapes/cell_count.hpp"
#include "body/shapes/cubed.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace meniscus {

namespace {

/// Value and first two derivatives of a function of the angle theta from the axis.
struct OfAngle {
  Real value, first, second;
};

/// Converts even functions of theta to functions of cos theta, which are smooth at the pole.
class FromAxis {
 public:
  explicit FromAxis(Jet<3> cosine, Real sine)
      : cosine_(std::move(cosine)), sine_(sine), at_pole_(sine < 1e-5) {}

  Jet<3> even(const OfAngle& h) const {
    if (at_pole_) return cosine_.chain(h.value, -h.second, 0);
    return cosine_.chain(h.value, -h.first / sine_,
                         (h.second - h.first * cosine_.value / sine_) / (sine_ * sine_));
  }
  /// h / sin theta for an odd h; `third` is its third derivative at the pole.
  Jet<3> odd_over_sine(const OfAngle& h, Real third) const {
    if (at_pole_) return even({h.first, 0, (third + h.first) / 3});
    const Real c = cosine_.value, g = h.value / sine_, first = (h.first - g * c) / sine_;
    return even({g, first, (h.second - 2 * first * c + g * sine_) / sine_});
  }

 private:
  Jet<3> cosine_;
  Real sine_;
  bool at_pole_;  // use limits; further terms of the series are below round-off
};

Jet<3> inverse(const Jet<3>& a) {
  const Real f = 1 / a.value;
  return a.chain(f, -f * f, 2 * f * f * f);
}
Jet<3> square_root(const Jet<3>& a) {
  const Real f = std::sqrt(a.value);
  return a.chain(f, 0.5 / f, -0.25 / (f * a.value));
}

}  // namespace

SmoothMap<3> wall_map(Meridian meridian, Real thickness, const Vec<3>& centre) {
  const Real rate = 2 * meridian.length / std::numbers::pi;  // ds / dtheta
  return smooth_map<3>([=](const std::array<Jet<3>, 3>& X) {
    const Jet<3> radius = square_root(X[0] * X[0] + X[1] * X[1] + X[2] * X[2]);
    const Jet<3> scale = inverse(radius), x = scale * X[0], y = scale * X[1];
    const Real side = X[2].value < 0 ? -1 : 1;
    const Jet<3> cosine = side * (scale * X[2]);
    const Real sine = std::hypot(x.value, y.value);

    const MeridianPoint p = meridian.point(rate * std::atan2(sine, cosine.value));
    const Real k = rate * p.curvature, slope = rate * rate * p.curvature_slope;
    const FromAxis axis(cosine, sine);
    const Jet<3> r =
        axis.odd_over_sine({p.r, rate * p.cos_psi, -rate * k * p.sin_psi}, -rate * k * k);
    const Jet<3> z = axis.even({p.z, -rate * p.sin_psi, -rate * k * p.cos_psi});
    const Jet<3> normal_r = axis.odd_over_sine(
        {p.sin_psi, k * p.cos_psi, slope * p.cos_psi - k * k * p.sin_psi}, -k * k * k);
    const Jet<3> normal_z =
        axis.even({p.cos_psi, -k * p.sin_psi, -slope * p.sin_psi - k * k * p.cos_psi});

    const Jet<3> depth = (thickness / (1 - unit_wall_inside)) * (1.0 - radius);
    const Jet<3> from_axis = r - depth * normal_r;
    return std::array<Jet<3>, 3>{centre[0] + x * from_axis, centre[1] + y * from_axis,
                                 centre[2] + side * (z - depth * normal_z)};
  });
}

namespace {

void require_inner_surface(const Meridian& meridian, Real thickness) {
  if (!(thickness < meridian.smallest_radius))
    throw InputError(
        fmt::format("a wall {:g} thick has no smooth inner surface: the outer one is bent to a "
                    "radius of {:g}, which must be larger than the thickness",
                    thickness, meridian.smallest_radius));
}

/// The map in the plane through the axis: places (x, 0, y) of space.
SmoothMap<2> section_of(SmoothMap<3> map, const Vec<2>& centre) {
  return [map = std::move(map), centre](const Vec<2>& X) {
    const MapPoint<3> p = map({X[0], 0, X[1]});
    constexpr std::array<int, 2> axis{0, 2};
    MapPoint<2> point;
    for (int i = 0; i < 2; ++i) {
      point.x[i] = centre[i] + p.x[at(axis, i)];
      for (int j = 0; j < 2; ++j) {
        point.F(i, j) = p.F(at(axis, i), at(axis, j));
        for (int k = 0; k < 2; ++k)
          at(point.G, i)(j, k) = at(p.G, at(axis, i))(at(axis, j), at(axis, k));
      }
    }
    return point;
  };
}

}  // namespace

Geometry<2> make_wall_section(const Meridian& meridian, Real thickness, int layers, Real spacing,
                              const Vec<2>& centre) {
  require_inner_surface(meridian, thickness);
  const Real cells = cells_along(meridian.length, spacing);  // of a quarter
  require_affordable<2>(4 * cells * layers);
  Geometry<2> geometry =
      make_geometry<2>(unit_ring(4 * static_cast<int>(cells), layers - 1, unit_wall_inside),
                       {SurfacePatch<2>::sphere(Vec<2>::Zero(), 1).named("outer"),
                        SurfacePatch<2>::cavity(Vec<2>::Zero(), unit_wall_inside).named("inner")},
                       true, section_of(wall_map(meridian, thickness, Vec<3>::Zero()), centre));
  geometry.director = [=](const Vec<2>& X) -> Vec<2> {
    const Vec<2> arm = X - centre, n = meridian.normal(Vec<2>(arm.cwiseAbs()));
    return Vec<2>(std::copysign(n[0], arm[0]), std::copysign(n[1], arm[1])).normalized();
  };
  return geometry;
}

Geometry<3> make_wall(const Meridian& meridian, Real thickness, int layers, Real spacing,
                      const Vec<3>& centre) {
  require_inner_surface(meridian, thickness);
  // A quarter of a great circle crosses as many cells as there are along an edge of a face of the
  // cube.
  const Real cells = cells_along(meridian.length, spacing);
  require_affordable<3>(6 * cells * cells * layers);
  Geometry<3> geometry =
      make_geometry<3>(cubed_shell(static_cast<int>(cells), layers - 1, unit_wall_inside),
                       {SurfacePatch<3>::sphere(Vec<3>::Zero(), 1).named("outer"),
                        SurfacePatch<3>::cavity(Vec<3>::Zero(), unit_wall_inside).named("inner")},
                       true, wall_map(meridian, thickness, centre));
  geometry.director = [=](const Vec<3>& X) -> Vec<3> {
    const Vec<3> arm = X - centre;
    const Real r = std::hypot(arm[0], arm[1]);
    const Vec<2> n = meridian.normal({r, std::abs(arm[2])});
    const Real over_r = r > 0 ? n[0] / r : 0;
    return Vec<3>(over_r * arm[0], over_r * arm[1], std::copysign(n[1], arm[2])).normalized();
  };
  return geometry;
}

}  // namespace meniscus
