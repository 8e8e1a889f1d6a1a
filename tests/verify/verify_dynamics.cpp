// SPDX-License-Identifier: BSD-3-Clause
// Orders of convergence of whole runs, which scenes cannot test; the full form uses larger sizes.
#include "meniscus/error.hpp"
#include "run/simulation.hpp"
#include "verify_form.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meniscus::verify_dynamics {
namespace {

/// Free cube with E = 1, nu = 0.3, rho = 1 in its Lame mode over one period (performance note 3):
/// u = A sin(w t) (cos pi x sin pi y, -sin pi x cos pi y, 0), w = pi sqrt(2 mu / rho).
struct LameCube {
  static constexpr Real mu = 1 / 2.6, lambda = 0.3 / (1.3 * 0.4), amplitude = 1e-5;
  const Real w = std::numbers::pi * std::sqrt(2 * mu);
  int cells = 8;
  Real step = 0;
  std::string body = {};  ///< further keys of the body

  std::string scene() const {
    const auto mode = [&](Real size, const std::string& time) {
      return fmt::format(
          R"toml(["{0:.17g}*{1}*cos(pi*x)*sin(pi*y)", "-{0:.17g}*{1}*sin(pi*x)*cos(pi*y)", "0"])toml",
          size, time);
    };
    const std::string velocity = mode(amplitude * w, fmt::format("cos({:.17g}*t)", w));
    const std::string displacement = mode(amplitude, fmt::format("sin({:.17g}*t)", w));
    return fmt::format(R"toml(
dimension = 3
[time]
end = {0:.17g}
step = {1:.17g}
[[body]]
name = "cube"
shape = "box"
size = [1, 1, 1]
corner = [0, 0, 0]
cells = [{2}, {2}, {2}]
support_spacings = 2.6
initial_velocity = {3}
{4}
[body.material]
type = "neo_hookean"
density = 1
mu = {5:.17g}
lambda = {6:.17g}
[[exact]]
body = "cube"
displacement = {7}
velocity = {8}
rate = {9:.17g}
)toml",
                       2 * std::numbers::pi / w, step, cells, mode(amplitude * w, "1"), body, mu,
                       lambda, displacement, velocity, w);
  }
};

struct Outcome {
  Real state_error = 0;   ///< at the end
  Real energy_error = 0;  ///< largest relative error of the energy balance
};

Outcome run(const LameCube& cube) {
  const SceneInput input = SceneInput::from_text(cube.scene());
  if (scene_dimension(input) != 3) throw InputError("the cube is three-dimensional");
  Scene<3> scene = build_scene<3>(input);
  const auto error =
      std::find_if(scene.measures.begin(), scene.measures.end(),
                   [](const MeasureSource& m) { return m.name == "cube.state_error"; });
  Simulation<3> simulation(scene);
  simulation.begin();
  Outcome outcome;
  while (simulation.state().time < scene.time.end) {
    simulation.advance();
    const Ledger ledger = simulation.audit_now();
    outcome.energy_error =
        std::max(outcome.energy_error, std::abs(simulation.audit().balance_error(ledger)));
  }
  outcome.state_error = error->compute(simulation.state().motion());
  return outcome;
}

// The step is short: its phase error over a period, 2 pi (w dt)^2 / 24, stays below the spatial
// error.
TEST(LameCube, StateErrorIsOfThirdOrderInTheSpacing) {
  std::vector<int> sizes{4, 6, 8};
  if (test::full_verification()) sizes.insert(sizes.end(), {12, 16});
  std::vector<Real> errors;
  for (const int n : sizes) {
    errors.push_back(run({.cells = n, .step = 0.08 / n}).state_error);
    fmt::print("N = {:2}: state error {:.5f}\n", n, errors.back());
  }
  const Real order = std::log(errors.front() / errors.back()) /
                     std::log(static_cast<Real>(sizes.back()) / sizes.front());
  fmt::print("order {:.2f}\n", order);
  EXPECT_GT(order, 2.8);
}

// Velocity Verlet: for any cloud, kinetic + strain energy of an oscillation of frequency w varies
// by the fraction (w dt)^2 / 4.
TEST(LameCube, EnergySwingsWithTheSquareOfTheStep) {
  for (const Real step : {0.08, 0.04, 0.02}) {
    const LameCube cube{.cells = 4, .step = step};
    const Real expected = std::pow(cube.w * step, 2) / 4;
    EXPECT_NEAR(run(cube).energy_error, expected, 0.1 * expected) << "step " << step;
  }
}

// Integration at the particles alone leaves modes without energy, and is much less accurate than
// q_scni.
TEST(LameCube, NodalIntegrationIsMuchLessAccurate) {
  const Real smoothed = run({.cells = 8, .step = 0.01}).state_error;
  const Real nodal = run({.cells = 8, .step = 0.01, .body = "integration = \"nodal\""}).state_error;
  EXPECT_GT(nodal, 3 * smoothed);
}

}  // namespace
}  // namespace meniscus::verify_dynamics
