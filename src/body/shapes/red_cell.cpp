// SPDX-License-Identifier: BSD-3-Clause
// Red blood cell at rest: the profile of Evans and Fung 1972, thickness sqrt(1 - r^2) (0.81 + 7.83
// r^2 - 4.39 r^4) um at the distance r from the axis in radii of 3.91 um. A smooth map takes the
// unit ball to it.
#include "body/shapes/cell_count.hpp"
#include "body/shapes/cubed.hpp"
#include "body/shapes/spacing.hpp"
#include "input/optional_rows.hpp"
#include "meniscus/body/shapes.hpp"
#include "meniscus/error.hpp"

#include <cmath>
#include <numbers>

namespace meniscus {
namespace {

/// Half of the thickness over the radius is sqrt(1 - r^2) (c0 + c1 r^2 + c2 r^4).
constexpr Real c0 = 0.81 / 7.82, c1 = 7.83 / 7.82, c2 = -4.39 / 7.82;

/// Volume of a red blood cell of radius one.
Real volume_of_red_cell() {
  return 2 * std::numbers::pi * (2 * (c0 + c1 + c2) / 3 - 2 * (c1 + 2 * c2) / 5 + 2 * c2 / 7);
}

/// Area of the surface of a red blood cell of radius one: 2 pi times the integral of the line
/// element per angle t, r = sin t, over cos t from -1 to 1, by Simpson's rule.
Real area_of_red_cell() {
  constexpr int n = 400;
  Real sum = 0;
  for (int k = 0; k <= n; ++k) {
    const Real c = 2.0 * k / n - 1, s = 1 - c * c, r = std::sqrt(s);
    const Real slope = r * (2 * c * c * (c1 + 2 * c2 * s) - (c0 + c1 * s + c2 * s * s));
    sum += (k == 0 || k == n ? 1 : k % 2 == 1 ? 4 : 2) * std::hypot(c, slope);
  }
  return 2 * std::numbers::pi * sum * 2 / (3.0 * n);
}

template <int D>
struct RedCell {
  static constexpr const char* name = "red_cell";
  static constexpr const char* meaning =
      D == 3 ? "red blood cell at rest (Evans and Fung 1972) about the axis z, with the reduced "
               "volume 0.644"
             : "section of a red blood cell at rest (Evans and Fung 1972) about the axis y, with "
               "the reduced volume 0.644";
  static constexpr std::string_view example =
      D == 3 ? "diameter = 2\ncore = 2\nlayers = 1\n" : "diameter = 2\ncore = 6\nrings = 3\n";
  std::optional<Real> diameter, area, volume;
  int core = D == 3 ? 10 : 18, layers = D == 3 ? 5 : 9;
  std::vector<Real> centre = std::vector<Real>(D, 0.0);

  static Rows<RedCell> rows() {
    return with_round_spacing<RedCell>(
        {optional_row("diameter", &RedCell::diameter, dimension::length, range::positive, "none",
                      "diameter; either this, or area, or volume"),
         optional_row("area", &RedCell::area, dimension::area, range::positive, "none",
                      "area of the surface of the cell"),
         optional_row("volume", &RedCell::volume, dimension::volume, range::positive, "none",
                      "volume of the cell"),
         integer_row("core", &RedCell::core, D == 3 ? count_in_space : count_in_plane,
                     "cells along an edge of the core of the ball that is mapped",
                     D == 3 ? 10 : 18),
         integer_row(D == 3 ? "layers" : "rings", &RedCell::layers,
                     D == 3 ? count_in_space : count_in_plane,
                     D == 3 ? "shells of cells around the core" : "rings of cells around the core",
                     D == 3 ? 5 : 9),
         reals_row("centre", &RedCell::centre, D, dimension::length, range::any, "centre",
                   std::vector<Real>(D, 0.0))},
        &RedCell::core, &RedCell::layers, D == 3 ? "layers" : "rings", &RedCell::radius_of_cells);
  }
  Geometry<D> geometry() const {
    const Real R = radius();
    return make_geometry<D>(
        cubed_ball<D>(core, layers),
        {SurfacePatch<D>::sphere(Vec<D>::Zero(), 1).named(D == 3 ? "surface" : "rim")}, true,
        smooth_map<D>([R, centre = centre](const std::array<Jet<D>, D>& X) {
          Jet<D> square(0.0);
          for (int i = 0; i < D - 1; ++i) square = square + at(X, i) * at(X, i);
          std::array<Jet<D>, D> x = X;
          for (int i = 0; i < D - 1; ++i) at(x, i) = Jet<D>(R) * at(X, i) + Jet<D>(at(centre, i));
          x[D - 1] =
              Jet<D>(R) * X[D - 1] * (Jet<D>(c0) + square * (Jet<D>(c1) + Jet<D>(c2) * square)) +
              Jet<D>(at(centre, D - 1));
          return x;
        }));
  }

 private:
  /// Radius of the ball (2D: disk) with the volume of the cell (2D: the area of its section).
  static Real radius_of_cells(const RedCell& cell) {
    return cell.radius() * (D == 3 ? std::cbrt(0.75 / std::numbers::pi * volume_of_red_cell())
                                   : std::sqrt(c0 + c1 / 4 + c2 / 8));
  }
  Real radius() const {
    if (diameter.has_value() + area.has_value() + volume.has_value() != 1)
      throw InputError("a red_cell has one size; expected is one of diameter, area, volume");
    if (diameter) return *diameter / 2;
    return area ? std::sqrt(*area / area_of_red_cell()) : std::cbrt(*volume / volume_of_red_cell());
  }
};

const bool red_cell_registered = register_shape<2, RedCell<2>>() && register_shape<3, RedCell<3>>();

}  // namespace
}  // namespace meniscus
