// SPDX-License-Identifier: BSD-3-Clause
// Measures of drops: velocities at particles, and shape.
#include "measure/drop_measures.hpp"

#include "body/particle_values.hpp"
#include "physics/surface/closed_surface.hpp"

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>

namespace meniscus {
namespace {

/// The outer surface at quadrature points, built when it is first used.
template <int D>
class FineSurface {
 public:
  explicit FineSurface(const Body<D>& body) : body_(body) {}

  Real isoperimetric(const Motion& motion) {
    const auto size = fine().size(motion);
    return isoperimetric_ratio(size.area, size.volume, body_.space());
  }
  Real least_area_ratio(const Motion& motion) {
    Real least = std::numeric_limits<Real>::max();
    for_points(motion, [&](const Vec<D>&, Real ratio, Real) { least = std::min(least, ratio); });
    return least;
  }
  Real roughness(const Motion& motion) {
    Vec<D> centre = Vec<D>::Zero();
    Real area = 0, mean = 0, square = 0;
    for_points(motion, [&](const Vec<D>& x, Real, Real da) {
      centre += da * x;
      area += da;
    });
    centre /= area;
    if (body_.geometry.grid.revolved) centre[0] = 0;
    for_points(motion,
               [&](const Vec<D>& x, Real, Real da) { mean += da / area * (x - centre).norm(); });
    for_points(motion, [&](const Vec<D>& x, Real, Real da) {
      square += da / area * std::pow((x - centre).norm() / mean - 1, 2);
    });
    return std::sqrt(square);
  }

 private:
  const ClosedSurface<D>& fine() {
    constexpr int points = 8;
    if (!surface_) surface_.emplace(body_, SurfacePart::outer, points);
    return *surface_;
  }
  /// Calls f(x, da/dA, da).
  template <class F>
  void for_points(const Motion& motion, F&& f) {
    const auto surface = fine().placed(motion);
    const std::vector<Real>& area = fine().reference().area;
    for (std::size_t q = 0; q < area.size(); ++q) {
      const Real ratio = surface.area_vector(static_cast<Index>(q)).norm();
      f(surface.place(static_cast<Index>(q)), ratio, ratio * area[q]);
    }
  }

  const Body<D>& body_;
  std::optional<ClosedSurface<D>> surface_;
};

/// Sums over the particles with their velocities: m |v|^2, m |v - mean v|^2, and m.
struct PlaceMotion {
  Real square, about_mean, mass;
};
template <int D>
PlaceMotion motion_of_places(const Body<D>& body, const Motion& motion) {
  Real mass = 0, square = 0;
  Lanes momentum = Lanes::zero();
  const NodalVectors velocities = values_at_particles(body, motion.v.data() + body.first);
  for (Index A = 0; A < body.size(); ++A) {
    const Lanes& v = at(velocities, A);
    const Real m = at(body.mass, A);
    mass += m;
    square += m * sum(v * v);
    momentum += m * v;
  }
  if (body.geometry.grid.revolved) momentum.set(0, 0);
  return {square, std::max(0.0, square - sum(momentum * momentum) / mass), mass};
}

/// Mean of the viscosity over the volume.
template <int D>
Real mean_viscosity(const Body<D>& body, std::span<const Real> viscosity) {
  Real sum = 0, volume = 0;
  for (Index A = 0; A < body.size(); ++A) {
    sum += body.cells.volume(A) * at(viscosity, A);
    volume += body.cells.volume(A);
  }
  return sum / volume;
}

}  // namespace

Real isoperimetric_ratio(Real area, Real volume, int space_dimension) {
  const Real least = space_dimension == 3 ? std::cbrt(36 * std::numbers::pi * volume * volume)
                                          : std::sqrt(4 * std::numbers::pi * volume);
  return area / least;
}

Real capillary_residual(std::span<const NodalVector> force, Real gamma, Real area, Real volume,
                        int space_dimension) {
  const Real radius = ball_radius(volume, space_dimension);
  Real left = 0;
  for (const NodalVector& f : force) left += std::sqrt(sum(f * f));
  return left / ((space_dimension - 1) * gamma * area / radius);
}

template <int D>
std::vector<MeasureSource> drop_measures(const Body<D>& body, std::span<const Real> viscosity,
                                         Real gamma) {
  const auto surface = std::make_shared<FineSurface<D>>(body);
  std::vector<MeasureSource> measures{
      {"isoperimetric", dimension::none,
       "area over that of the ball of the same volume (2D: circumference, disk)",
       [surface](const Motion& motion) { return surface->isoperimetric(motion); }},
      {"roughness", dimension::none, "rms deviation of the surface from its mean radius, relative",
       [surface](const Motion& motion) { return surface->roughness(motion); }},
      {"least_area_ratio", dimension::none, "smallest current area / reference area",
       [surface](const Motion& motion) { return surface->least_area_ratio(motion); }},
      {"kinetic_at_places", dimension::energy, "kinetic energy of the velocities at the particles",
       [&body](const Motion& motion) { return 0.5 * motion_of_places(body, motion).square; }}};
  if (!viscosity.empty())
    measures.push_back(
        {"ca", dimension::none,
         "capillary number: viscosity x rms velocity at the particles about that of "
         "the centre of mass / surface tension",
         [&body, scale = mean_viscosity(body, viscosity) / gamma](const Motion& motion) {
           const PlaceMotion moved = motion_of_places(body, motion);
           return scale * std::sqrt(moved.about_mean / moved.mass);
         }});
  return measures;
}

template std::vector<MeasureSource> drop_measures(const Body<2>&, std::span<const Real>, Real);
template std::vector<MeasureSource> drop_measures(const Body<3>&, std::span<const Real>, Real);

}  // namespace meniscus
