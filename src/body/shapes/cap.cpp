// SPDX-License-Identifier: BSD-3-Clause
// Spherical cap (2D: circular segment): half of a ball under a smooth map that takes the sphere of
// the ball to the sphere of the cap.
#include "body/shapes/cell_count.hpp"
#include "body/shapes/cubed.hpp"
#include "body/shapes/spacing.hpp"
#include "meniscus/body/shapes.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <cmath>
#include <numbers>

namespace meniscus {
namespace {

/// Radius of the sphere (in the plane: circle) of a cap with the volume of the unit ball (disk).
Real radius_of_sphere(Real theta, bool in_space) {
  const Real c = std::cos(theta);
  return in_space ? std::cbrt(4 / ((2 + c) * (1 - c) * (1 - c)))
                  : std::sqrt(std::numbers::pi / (theta - std::sin(theta) * c));
}

/// Places of the upper half of the unit ball have the height h Z, and the distance from the axis is
/// multiplied by g(Z), where h is the height of the cap, R the radius of its sphere, and
///
///   g^2 = h (2 R - h + h Z) / (1 + Z).
///
/// The points with |X| = 1 then lie on the sphere of the cap, whose base has the radius a = g(0).
/// To lay the base on a ball of radius B, places at the distance P from the axis of the unit ball
/// sink by B - sqrt(B^2 - a^2 P^2); in a cavity, B < 0, they rise.
template <int D>
SmoothMap<D> cap_map(Real theta, Real R, Real B, std::vector<Real> centre) {
  const Real h = R * (1 - std::cos(theta)), a = R * std::sin(theta);
  if (B != 0 && !(a < 0.99 * std::abs(B)))
    throw InputError(
        fmt::format("the base of the cap has the radius {:g}, too large for a wall of radius {:g}; "
                    "allowed is a "
                    "larger contact_angle or wall_radius",
                    a, std::abs(B)));
  return smooth_map<D>([=](const std::array<Jet<D>, D>& X) {
    const Jet<D>& Z = X[D - 1];
    const Jet<D> square = Jet<D>(h) * (Jet<D>(2 * R - h) + Jet<D>(h) * Z) / (Jet<D>(1.0) + Z);
    const Real root = std::sqrt(square.value);
    const Jet<D> g = square.chain(root, 0.5 / root, -0.25 / (root * root * root));
    std::array<Jet<D>, D> x = X;
    for (int i = 0; i < D - 1; ++i) at(x, i) = g * at(X, i) + Jet<D>(at(centre, i));
    x[D - 1] = Jet<D>(h) * Z + Jet<D>(at(centre, D - 1));
    if (B == 0) return x;
    Jet<D> depth(B * B);
    for (int i = 0; i < D - 1; ++i) depth = depth - Jet<D>(a * a) * at(X, i) * at(X, i);
    const Real above = std::sqrt(depth.value);
    const Jet<D> cosine = depth.chain(above, 0.5 / above, -0.25 / (above * above * above));
    x[D - 1] = x[D - 1] + Jet<D>(B > 0 ? 1 : -1) * cosine - Jet<D>(B);
    return x;
  });
}

template <int D>
struct Cap {
  static constexpr const char* name = "cap";
  static constexpr const char* meaning = D == 3 ? "spherical cap above its flat face z = 0"
                                                : "circular segment above its flat face y = 0";
  static constexpr std::string_view example =
      D == 3 ? "radius = 1\ncontact_angle = 60\ncore = 4\nlayers = 1\n"
             : "radius = 1\ncontact_angle = 60\ncore = 4\nrings = 2\n";
  Real radius = 1, contact_angle = 90, wall_radius = 0;
  int core = D == 3 ? 10 : 18, layers = D == 3 ? 5 : 9;
  std::vector<Real> centre = std::vector<Real>(D, 0.0);
  bool in_space = D == 3;  // also as a body of revolution

  static Rows<Cap> rows() {
    Row<Cap> radius =
        real_row("radius", &Cap::radius, dimension::length, range::positive,
                 D == 3 ? "radius of the ball with the volume of the cap"
                        : "radius of the disk with the area of the segment; axisymmetric: of the "
                          "ball with the volume of the cap");
    radius.read = [read = radius.read](Cap& cap, const Block& block) {
      read(cap, block);
      cap.in_space = D == 3 || block.units().of_whole_bodies();
    };
    return with_round_spacing<Cap>(
        {radius,
         real_row("contact_angle", &Cap::contact_angle, dimension::none, {5, 155},
                  "angle in degrees between the flat and the round face, inside"),
         real_row("wall_radius", &Cap::wall_radius, dimension::length, range::any,
                  "radius of a ball (2D: disk) on which the cap is laid; negative: of a cavity "
                  "in which it lies; 0: a plane",
                  0),
         integer_row("core", &Cap::core, D == 3 ? count_in_space : count_in_plane,
                     "cells along an edge of the core of the whole ball, an even number",
                     D == 3 ? 10 : 18),
         integer_row(D == 3 ? "layers" : "rings", &Cap::layers,
                     D == 3 ? count_in_space : count_in_plane,
                     D == 3 ? "shells of cells around the core" : "rings of cells around the core",
                     D == 3 ? 5 : 9),
         reals_row("centre", &Cap::centre, D, dimension::length, range::any,
                   "centre of the flat face", std::vector<Real>(D, 0.0))},
        &Cap::core, &Cap::layers, D == 3 ? "layers" : "rings", &Cap::radius_of_cells);
  }
  Geometry<D> geometry() const {
    if (core % 2 != 0)
      throw InputError("a cap has an even number of cells along the core; use a multiple of 2");
    const Vec<D> origin = Vec<D>::Zero(), up = Vec<D>::Unit(D - 1);
    const Real theta = contact_angle * std::numbers::pi / 180;
    return make_geometry<D>(
        upper_half<D>(cubed_ball<D>(core, layers)),
        {SurfacePatch<D>::sphere(origin, 1).named("round"),
         SurfacePatch<D>::plane(origin, -up).named("flat")},
        false, cap_map<D>(theta, radius * radius_of_sphere(theta, in_space), wall_radius, centre));
  }

 private:
  /// Radius of the ball (2D: disk) with twice the volume (area) of the cap, which has half of the
  /// cells of the ball.
  static Real radius_of_cells(const Cap& cap) {
    if (D == 3) return std::cbrt(2.0) * cap.radius;
    const Real theta = cap.contact_angle * std::numbers::pi / 180;
    return std::sqrt(2.0) * cap.radius * radius_of_sphere(theta, cap.in_space) /
           radius_of_sphere(theta, false);
  }
};

const bool cap_registered = register_shape<2, Cap<2>>() && register_shape<3, Cap<3>>();

}  // namespace
}  // namespace meniscus
