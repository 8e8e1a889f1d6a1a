// SPDX-License-Identifier: BSD-3-Clause
// Drops on walls: the outline of a drop at rest under its weight against the profile of Bashforth
// and Adams, the initial growth of the wetted area, and the ridge on soft ground.
#include "../unit/support.hpp"
#include "body/surface/surface_patches.hpp"
#include "run/simulation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meniscus::verify_wetting {
namespace {

/// Half the outline of a plane drop at rest, as points (x, z) with the depth z below its top, until
/// the surface is vertical: dx/ds = cos p, dz/ds = sin p, dp/ds = k0 + z (rho = g = gamma = 1).
std::vector<Vec<2>> outline(Real k0) {
  const auto rate = [k0](const Vec<3>& y) {
    return Vec<3>(std::cos(y[2]), std::sin(y[2]), k0 + y[1]);
  };
  constexpr Real ds = 1e-3;
  std::vector<Vec<2>> points;
  for (Vec<3> y = Vec<3>::Zero(); y[2] < std::numbers::pi / 2;) {
    points.emplace_back(y[0], y[1]);
    const Vec<3> a = rate(y), b = rate(y + ds / 2 * a), c = rate(y + ds / 2 * b),
                 d = rate(y + ds * c);
    y += ds / 6 * (a + 2 * b + 2 * c + d);
  }
  return points;
}

Real area(const std::vector<Vec<2>>& points) {
  Real sum = 0;
  for (std::size_t k = 1; k < points.size(); ++k)
    sum += (points[k][0] + points[k - 1][0]) * (points[k][1] - points[k - 1][1]);
  return sum;
}

/// The profile of a drop of area pi.
std::vector<Vec<2>> profile() {
  Real low = 0.1, high = 1;
  for (int k = 0; k < 50; ++k) {
    const Real middle = (low + high) / 2;
    (area(outline(middle)) > std::numbers::pi ? low : high) = middle;
  }
  return outline(low);
}

/// Tests inputs/wetting/sessile_drop.toml with other settings of [time].
void expect_profile(const std::vector<std::string>& settings) {
  const std::vector<Vec<2>> exact = profile();
  const Real height = exact.back()[1];
  EXPECT_NEAR(height, 1.12208, 1e-3);
  const SceneInput input =
      SceneInput::from_file(MENISCUS_SOURCE_DIR "/inputs/wetting/sessile_drop.toml", settings);
  scene_dimension(input);
  Scene<2> scene = build_scene<2>(input);
  Simulation<2> simulation(scene);
  simulation.begin();
  while (!simulation.finished()) simulation.advance();
  const Body<2>& body = scene.system.bodies.front();
  const SurfacePatches<2> patches(body);
  Real farthest = 0, lowest = 0;
  std::vector<Vec<2>> places;
  for (Index a = 0; a < patches.point_count(); ++a) {
    const Lanes u = value_at(patches.rows(), a, simulation.state().u.data());
    places.emplace_back(patches.reference_place(a) + Vec<2>(u[0], u[1]));
    lowest = std::min(lowest, places.back()[1]);
  }
  int compared = 0;
  for (const Vec<2>& x : places) {
    const Real above = x[1] - lowest;
    if (above < 0.1) continue;  // within the range of the wall
    Real distance = unbounded;
    for (const Vec<2>& y : exact)
      distance = std::min(distance, (y - Vec<2>(std::abs(x[0]), height - above)).norm());
    farthest = std::max(farthest, distance);
    ++compared;
  }
  EXPECT_GT(compared, 20);
  EXPECT_LT(farthest, 2e-3);
}

TEST(SessileDrop, HasTheProfileOfBashforthAndAdams) {
  expect_profile({"time.end=8", "body[0].core=8", "body[0].rings=4"});
}

TEST(SessileDrop, FlowsToTheProfileOfBashforthAndAdams) {
  expect_profile({"time.end=1000", "time.solver=\"newton\"", "time.force_tolerance=1e-5",
                  "time.viscosity=\"explicit\""});
}

/// Slope of A/(pi R^2) against t/t_in in 0.05 < t/t_in < 0.8 for the drop of
/// inputs/wetting/droplet_spreading.toml, and r^2 of the line.
std::pair<Real, Real> early_growth(const std::string& viscosity) {
  constexpr Real inertial_time = 41.437, radius = 5;
  const SceneInput input =
      SceneInput::from_file(MENISCUS_SOURCE_DIR "/inputs/wetting/droplet_spreading.toml",
                            {"body[0].material.viscosity=\"" + viscosity + "\""});
  scene_dimension(input);
  Scene<3> scene = build_scene<3>(input);
  Simulation<3> simulation(scene);
  simulation.begin();
  const auto measure = std::find_if(scene.measures.begin(), scene.measures.end(),
                                    [](const auto& m) { return m.name == "wall.base_radius"; });
  std::vector<Vec<2>> points;
  while (simulation.state().time < 0.8 * inertial_time) {
    simulation.advance();
    const Real t = simulation.state().time / inertial_time;
    if (t > 0.05)
      points.emplace_back(t, std::pow(measure->compute(simulation.state().motion()) / radius, 2));
  }
  Vec<2> mean = Vec<2>::Zero();
  for (const Vec<2>& p : points) mean += p / static_cast<Real>(points.size());
  Mat<2> spread = Mat<2>::Zero();
  for (const Vec<2>& p : points) spread += (p - mean) * (p - mean).transpose();
  return {spread(0, 1) / spread(0, 0), spread(0, 1) * spread(0, 1) / (spread(0, 0) * spread(1, 1))};
}

/// The axisymmetric finite-element calculation has the slopes 0.55 and 1.01.
TEST(Spreading, IsLinearAtFirstWithAndWithoutMuchViscosity) {
  for (const auto& [viscosity, slope] :
       std::vector<std::pair<std::string, Real>>{{"0.6034 mPa s", 0.55}, {"0.06034 mPa s", 1.01}}) {
    const auto [measured, r_squared] = early_growth(viscosity);
    EXPECT_NEAR(measured, slope, 0.05 * slope) << viscosity;
    EXPECT_GT(r_squared, 0.97) << viscosity;
  }
}

/// A plane layer of thickness 1 under tension on rigid ground.
struct LinearLayer {
  Real mu, nu, tension;

  /// Height of the surface at x = a under line forces 1 upward at x = -a and x = a, and the
  /// pressure 1/a between them (wetting note 10).
  Real ridge(Real a) const {
    constexpr Real dk = 0.005, most = 400;
    Real sum = 0;
    for (Real k = dk / 2; k < most; k += dk) {
      const Real decay = std::exp(-2 * k), square = decay * decay;  // sinh, cosh times decay
      const Real numerator = (3 - 4 * nu) * (1 - square) / 2 - 2 * k * decay;
      const Real denominator =
          (3 - 4 * nu) * (1 + square) / 2 + (2 * k * k + 5 - 12 * nu + 8 * nu * nu) * decay;
      const Real compliance = (1 - nu) / (mu * k) * numerator / denominator;
      const Real load = 2 * std::cos(k * a) - 2 * std::sin(k * a) / (k * a);
      sum += compliance * load * std::cos(k * a) / (1 + tension * k * k * compliance) * dk;
    }
    return sum / std::numbers::pi;
  }
};

/// The length gamma/mu is 1 and 2.5 times the thickness of the layer. The layer has a much larger
/// tension than the drop, so that slopes are small.
TEST(SoftLayer, HasTheRidgeOfLineForcesOnALinearLayer) {
  for (const auto& layer : {LinearLayer{1, 0.45, 4}, LinearLayer{0.4, 0.45, 2}}) {
    const SceneInput input = SceneInput::from_file(
        MENISCUS_SOURCE_DIR "/inputs/soft_wetting/droplet_on_soft_layer.toml",
        {"body.drop.core=14", "body.drop.rings=7", "body.layer.spacing=0.0625",
         "contact.line.range=0.06", "contact.line.offset=0.036", "time.end=8",
         "body.layer.material.mu=" + std::to_string(layer.mu),
         "body.layer.material.lambda=" + std::to_string(9 * layer.mu),
         "surface_tension[1].gamma=" + std::to_string(layer.tension)});
    scene_dimension(input);
    Scene<2> scene = build_scene<2>(input);
    Simulation<2> simulation(scene);
    simulation.begin();
    while (!simulation.finished()) simulation.advance();
    const auto measured = [&](const std::string& name) {
      const auto found = std::find_if(scene.measures.begin(), scene.measures.end(),
                                      [&](const auto& m) { return m.name == "line." + name; });
      return found->compute(simulation.state().motion());
    };
    const Real linear = layer.ridge(measured("ridge_radius"));
    RecordProperty("linear", std::to_string(linear));
    RecordProperty("measured", std::to_string(measured("ridge_height")));
    EXPECT_NEAR(measured("ridge_height"), linear, 0.1 * linear) << "mu = " << layer.mu;
    const Real neumann = 180 - 360 / std::numbers::pi * std::asin(0.5 / layer.tension);
    EXPECT_NEAR(measured("solid_angle"), neumann, 5) << "mu = " << layer.mu;
  }
}

}  // namespace
}  // namespace meniscus::verify_wetting
