// SPDX-License-Identifier: BSD-3-Clause
// Small oscillations of a viscous drop.
#include "study/support/drop_mode_case.hpp"

#include "kernel/row_sums.hpp"
#include "numbers/dense.hpp"
#include "run/simulation.hpp"
#include "study/drop_dispersion.hpp"
#include "study/support/pairs.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace meniscus::study {
namespace {

/// The gradient of r^l P_l as formulas of z and q^2, the squared distance from the axis: across the
/// axis divided by q, and along it.
std::pair<std::string, std::string> potential_flow(int l, const std::string& z,
                                                   const std::string& q2) {
  if (l == 2) return {"-1", "2*" + z};
  if (l == 3) return {"-3*" + z, fmt::format("3*{}^2 - 1.5*{}", z, q2)};
  return {fmt::format("1.5*{1} - 6*{0}^2", z, q2), fmt::format("4*{0}^3 - 6*{0}*{1}", z, q2)};
}

// R = rho = gamma = 1: time is in units of sqrt(rho R^3 / gamma). K (1 - J) = 2 is the Laplace
// pressure. The reference is larger by J^(-1/3), so that the drop starts in equilibrium at R = 1.
template <int D>
std::string scene_text(const DropMode& mode, int core, Real end) {
  const Real J = 1 - 2 / mode.bulk_modulus, stretch = std::cbrt(J);
  constexpr Real displacement = 0.004;  // approximate amplitude at the pole
  // The speed grows with r^(l-1). In coordinates of the reference this gives a factor
  // stretch^(l-1).
  const Real speed = displacement * std::sqrt(Real(mode.l * (mode.l - 1) * (mode.l + 2))) *
                     std::pow(stretch, mode.l - 1) / mode.l;
  const auto vector = [](Real factor, const std::string& across_axis, const std::string& on_axis) {
    const auto component = [&](const std::string& of) {
      return fmt::format("\"{:.17g}*({})\"", factor, of);
    };
    std::string text = "[" + component("x*(" + across_axis + ")") + ", ";
    if (D == 3) text += component("y*(" + across_axis + ")") + ", ";
    return text + component(on_axis) + "]";
  };
  const std::string z = D == 3 ? "z" : "y";
  const auto [across, along] = potential_flow(mode.l, z, D == 3 ? "(x^2 + y^2)" : "x^2");
  return fmt::format(R"toml(
dimension = {10}
time = {{ end = {0:.17g} }}
[[body]]
name = "drop"
shape = "{11}"
radius = {1:.17g}
core = {2}
{12} = {3}
{9}
initial_displacement = {4}
initial_velocity = {5}
[body.material]
type = "newtonian"
density = {6:.17g}
bulk_modulus = {7:.17g}
equation_of_state = "linear"
viscosity = {8:.17g}
[[surface_tension]]
body = "drop"
gamma = 1
)toml",
                     end, 1 / stretch, core, std::max(1, core / 2), vector(stretch - 1, "1", z),
                     vector(speed, across, along), J, mode.bulk_modulus, mode.Oh, mode.body_keys,
                     D == 3 ? "3" : "\"axisymmetric\"", D == 3 ? "ball" : "disk",
                     D == 3 ? "layers" : "rings");
}

/// Amplitude of P_l about the last axis of the surface particles, by least squares with P_0 to P_4.
template <int D>
class Amplitude {
 public:
  Amplitude(const Body<D>& body, int l)
      : body_(body), particles_(boundary_nodes(body.geometry.grid)), l_(l) {}

  Real operator()(const Motion& motion) const {
    using Vector = Eigen::Matrix<Real, 5, 1>;
    Eigen::Matrix<Real, 5, 5> normal = Eigen::Matrix<Real, 5, 5>::Zero();
    Vector right = Vector::Zero();
    for (const Index A : particles_) {
      const Lanes u = value_at(body_.at_particles, A, motion.u.data());
      Vec<D> x = at(body_.particles.X(), A);
      for (int i = 0; i < D; ++i) x[i] += u[i];
      const Real r = x.norm(), c = x[D - 1] / r, c2 = c * c;
      Vector P;
      P << 1, c, 1.5 * c2 - 0.5, c * (2.5 * c2 - 1.5), (35 * c2 * c2 - 30 * c2 + 3) / 8;
      normal += P * P.transpose();
      right += r * P;
    }
    return solve_symmetric(normal, right)[l_];
  }

 private:
  const Body<D>& body_;
  std::vector<Index> particles_;
  int l_;
};

/// The time span from which the rate is fitted. It begins when the slowest vortical mode has fallen
/// by e^-7. The rate of that mode is about nu/R^2 times the square of the first zero of the Bessel
/// function J_(l + 1/2). The span lasts three decay times or two periods.
struct TimeInterval {
  Real begin, end;
  static TimeInterval of(const DropMode& mode, Complex s) {
    constexpr std::array<Real, 3> zeros{5.7635, 6.9879, 8.1826};  // l = 2, 3, 4
    const Real zero = at(zeros, mode.l - 2), begin = 7 / (zero * zero * mode.Oh);
    Real length = 3 / -s.real();
    if (s.imag() > 0) length = std::min(length, 4 * std::numbers::pi / s.imag());
    return {begin, begin + length};
  }
};

/// Rate s from equidistant samples of c + a exp(s t) + b exp(s' t), with s' = conj(s) or s' real.
/// Least squares find the linear prediction of a sample from the two samples before it. If both
/// rates are real, returns the slow one.
Complex fitted_rate(const std::vector<Real>& a, Real interval) {
  Mat<3> normal = Mat<3>::Zero();
  Vec<3> right = Vec<3>::Zero();
  for (std::size_t k = 0; k + 2 < a.size(); ++k) {
    const Vec<3> before(a[k + 1], a[k], 1);
    normal += before * before.transpose();
    right += a[k + 2] * before;
  }
  const Vec<3> p = inverse<3>(normal) * right;
  const Complex z = 0.5 * (p[0] + std::sqrt(Complex(p[0] * p[0] + 4 * p[1])));
  const Complex s = std::log(z) / interval;
  return {s.real(), std::abs(s.imag())};
}

template <int D>
Measurement measure(const std::string& method, const DropMode& mode, int core) {
  const Complex exact = drop_mode_rate(mode.l, mode.Oh);
  const TimeInterval interval_of_time = TimeInterval::of(mode, exact);
  constexpr int samples = 24;
  const Real interval = (interval_of_time.end - interval_of_time.begin) / samples;

  const Stopwatch set_up;
  const SceneInput input =
      SceneInput::from_text(scene_text<D>(mode, core, interval_of_time.end + interval));
  scene_dimension(input);
  Scene<D> scene = build_scene<D>(input);
  const Body<D>& body = scene.system.bodies.front();
  Simulation<D> simulation(scene);
  simulation.begin();

  Measurement result;
  result.method = method;
  result.level = core;
  result.particles = body.size();
  result.h = std::pow(Real(body.size()), -1.0 / D);
  result.bytes = scene.system.bytes();
  result.set_up = set_up.seconds();

  const Stopwatch run;
  const Amplitude<D> amplitude(body, mode.l);
  std::vector<Real> fitted;
  Real before = amplitude(simulation.state().motion()), time_before = 0,
       next = interval_of_time.begin;
  while (static_cast<int>(fitted.size()) <= samples) {
    simulation.advance();
    const Real time = simulation.state().time, now = amplitude(simulation.state().motion());
    for (; next <= time && static_cast<int>(fitted.size()) <= samples; next += interval)
      fitted.push_back(before + (now - before) * (next - time_before) / (time - time_before));
    before = now;
    time_before = time;
  }
  result.time = run.seconds();
  const Complex s = fitted_rate(fitted, interval);
  result.errors = {{"rate", std::abs(s - exact) / std::abs(exact)}};
  result.values = {{"pairs per particle", pairs_per_particle(scene.system.terms, result.particles)},
                   {"decay", -s.real()},
                   {"exact decay", -exact.real()}};
  if (exact.imag() > 0)
    result.values.insert(result.values.end(),
                         {{"frequency", s.imag()}, {"exact frequency", exact.imag()}});
  return result;
}

}  // namespace

Measurement measure_drop_mode(const std::string& method, const DropMode& mode, int core) {
  return mode.revolved ? measure<2>(method, mode, core) : measure<3>(method, mode, core);
}

}  // namespace meniscus::study
