// SPDX-License-Identifier: BSD-3-Clause
// Bodies of revolution in the half plane against exact solutions in space: free vibrations of an
// elastic ball (Lamb 1882, Love 1911), a thick sphere under pressure (Lame), and balloons past
// their greatest pressure.
#include "meniscus/error.hpp"
#include "numbers/dense.hpp"
#include "run/simulation.hpp"
#include "study/study.hpp"

#include <fmt/core.h>

#include <cmath>
#include <numbers>

namespace meniscus::axisymmetry_study {
namespace {

/// A free vibration of a ball of radius 1 with lambda = mu = rho = 1: the lowest spheroidal mode of
/// degree l, or the breathing mode for l = 0.
class BallMode {
 public:
  explicit BallMode(int l) : l_(l), frequency_(lowest_root()) {
    const Waves at(l_, frequency_);
    shear_ = l_ == 0 ? 0 : -at.tangential[0] / at.tangential[1];
  }
  Real frequency() const { return frequency_; }
  /// Displacement (across, along the axis) at a place.
  Vec<2> at(const Vec<2>& X) const {
    const Real r = X.norm();
    if (!(r > 1e-9)) return Vec<2>::Zero();
    const Real c = X[1] / r, s = X[0] / r, p = frequency_ / std::sqrt(3.0), q = frequency_;
    const Real P = l_ == 0 ? 1 : 1.5 * c * c - 0.5, slope = l_ == 0 ? 0 : -3 * c * s;  // dP/dtheta
    const Bessel f(l_, p * r), g(l_, q * r);
    const int L = l_ * (l_ + 1);
    const Real radial = (p * f.first + shear_ * L * g.value / r) * P,
               around = (f.value / r + shear_ * (g.value / r + q * g.first)) * slope;
    return {radial * s + around * c, radial * c - around * s};
  }

 private:
  /// A spherical Bessel function with its derivatives.
  struct Bessel {
    Real value, first, second;
    Bessel(int l, Real x) {
      value = std::sph_bessel(static_cast<unsigned>(l), x);
      first = l / x * value - std::sph_bessel(static_cast<unsigned>(l) + 1, x);
      second = -2 / x * first - (1 - l * (l + 1) / (x * x)) * value;
    }
  };
  /// The normal and tangential stress of the pressure wave and the shear wave at r = 1.
  struct Waves {
    std::array<Real, 2> normal, tangential;
    Waves(int l, Real frequency) {
      const Real p = frequency / std::sqrt(3.0), q = frequency, L = l * (l + 1);
      const Bessel f(l, p), g(l, q);
      const Real f1 = p * f.first, f2 = p * p * f.second, g1 = q * g.first, g2 = q * q * g.second;
      normal = {-p * p * f.value + 2 * f2, 2 * L * (g1 - g.value)};
      tangential = {2 * (f1 - f.value), g2 + (L - 2) * g.value};
    }
    Real determinant(int l) const {
      return l == 0 ? normal[0] : normal[0] * tangential[1] - normal[1] * tangential[0];
    }
  };
  Real lowest_root() const {
    constexpr Real step = 0.01;
    const auto value = [&](Real x) { return Waves(l_, x).determinant(l_); };
    Real low = 0.5;
    while (low < 10 && value(low) * value(low + step) > 0) low += step;
    Real high = low + step;
    for (int halving = 0; halving < 60; ++halving) {
      const Real middle = (low + high) / 2;
      (value(low) * value(middle) > 0 ? low : high) = middle;
    }
    return low;
  }

  int l_;
  Real frequency_, shear_ = 0;
};

/// A scene of one body, with what was measured of its set-up.
struct Case {
  Stopwatch set_up;
  Scene<2> scene;
  Simulation<2> simulation;
  Measurement m;

  Case(const std::string& method, int level, const std::string& text)
      : scene(build_scene<2>(input_of(text))), simulation(scene) {
    simulation.begin();
    m.method = method;
    m.level = level;
    m.particles = scene.system.size();
    m.h = 1.0 / level;
    m.bytes = scene.system.bytes();
    m.set_up = set_up.seconds();
  }
  Real value(const std::string& name) const {
    for (const MeasureSource& source : scene.measures)
      if (source.name == name) return source.compute(simulation.state().motion());
    throw std::logic_error(name);
  }

 private:
  static SceneInput input_of(const std::string& text) {
    const SceneInput input = SceneInput::from_text("dimension = \"axisymmetric\"\n" + text);
    scene_dimension(input);
    return input;
  }
};

/// The frequency from the time of half a period.
Measurement measure_mode(const std::string& method, int l, int level) {
  const BallMode mode(l);
  const Real half = std::numbers::pi / mode.frequency();
  Case c(method, level,
         fmt::format("[time]\nend = {}\nsafety = 0.1\n[[body]]\nname = \"ball\"\n"
                     "shape = \"disk\"\nradius = 1\ncore = {}\nrings = {}\n"
                     "material = {{ type = \"neo_hookean\", density = 1, mu = 1, lambda = 1 }}\n",
                     2 * half, level, level / 2));
  const Body<2>& body = c.scene.system.bodies.front();
  constexpr Real amplitude = 1e-6;
  std::vector<Vec<2>> shape;
  for (const Vec<2>& X : body.particles.X()) shape.push_back(mode.at(X));
  State state = c.simulation.state();
  for (Index A = 0; A < body.size(); ++A)
    set_vector<2>(state.v, A, Vec<2>(amplitude * at(shape, A)));
  c.scene.initial = state;
  Simulation<2> simulation(c.scene);
  simulation.begin();
  const auto displacement = [&] {
    Real sum = 0;
    for (Index A = 0; A < body.size(); ++A)
      sum += at(body.mass, A) * at(shape, A).dot(vector_at<2>(simulation.state().u, A));
    return sum;
  };
  const Stopwatch run;
  Real before = 0, time_before = 0, now = 0, time = 0;
  while (!(now < 0)) {
    before = now;
    time_before = time;
    simulation.advance();
    now = displacement();
    time = simulation.state().time;
    if (time > 1.5 * half) throw SolveError("the ball does not vibrate");
  }
  c.m.time = run.seconds();
  const Real zero = time_before + (time - time_before) * before / (before - now);
  c.m.errors = {{"frequency", half / zero - 1}};
  c.m.values = {{"exact frequency", mode.frequency()}, {"steps", Real(simulation.state().step)}};
  return c.m;
}

/// A sphere with the inner radius 0.7 under a small pressure inside; `level`: cells through the
/// wall.
Measurement measure_sphere(const std::string& method, Real lambda, int level) {
  constexpr Real inner = 0.7, pressure = 1e-4;
  Case c(method, level,
         fmt::format("[time]\nend = 1\nsolver = \"newton\"\n[[body]]\nname = \"shell\"\n"
                     "shape = \"ring\"\nradius = 1\nthickness = {}\naround = {}\nlayers = {}\n"
                     "material = {{ type = \"neo_hookean\", density = 1, mu = 1, lambda = {} }}\n"
                     "[[traction]]\nbody = \"shell\"\nface = \"inner\"\npressure = {}\n",
                     1 - inner, 8 * level, level, lambda, pressure));
  const Stopwatch run;
  while (!c.simulation.finished()) c.simulation.advance();
  c.m.time = run.seconds();
  const Real A = pressure * std::pow(inner, 3) / (1 - std::pow(inner, 3)), K = lambda + 2.0 / 3,
             exact = A / (3 * K) + A / 4;
  c.m.errors = {{"equator", (c.value("shell.extent_x") / 2 - 1) / exact - 1},
                {"pole", (c.value("shell.extent_y") / 2 - 1) / exact - 1}};
  return c.m;
}

/// An incompressible neo-Hookean balloon whose cavity grows to `volume` times the reference: the
/// pressure is mu [2/s + 1/(2 s^4)] at the stretch s of the outer wall minus that of the inner
/// wall.
Measurement measure_balloon(const std::string& method, Real volume, int level) {
  constexpr Real inner = 0.8;
  Case c(method, level,
         fmt::format("[time]\nend = 400\nsolver = \"relax\"\nforce_tolerance = 1e-4\n"
                     "[[body]]\nname = \"shell\"\n"
                     "shape = \"ring\"\nradius = 1\nthickness = {}\naround = {}\nlayers = {}\n"
                     "material = {{ type = \"neo_hookean\", density = 1, mu = 1, lambda = 3000 }}\n"
                     "[[cavity]]\nbody = \"shell\"\nvolume_target = {}\npenalty = 100\n"
                     "ramp = [0, 20]\n",
                     1 - inner, 12 * level, level, volume));
  const Stopwatch run;
  while (!c.simulation.finished()) c.simulation.advance();
  c.m.time = run.seconds();
  const Real content = std::pow(inner, 3) * c.value("shell.cavity_fraction");
  const Real of_inner = std::cbrt(content) / inner,
             of_outer = std::cbrt(1 + content - std::pow(inner, 3));
  const auto part = [](Real s) { return 2 / s + 1 / (2 * std::pow(s, 4)); };
  const Real exact = part(of_outer) - part(of_inner);
  c.m.errors = {{"pressure", c.value("shell.cavity_pressure") / exact - 1}};
  c.m.values = {{"pressure", exact}, {"stretch of the inner wall", of_inner}};
  return c.m;
}

void run(StudyRun& study) {
  study.finish_settings();
  const std::vector<int>& levels = study.levels();
  for (const int l : {0, 2})
    for (const int level : levels)
      study.record(measure_mode(fmt::format("ball, mode {}", l == 0 ? "0S0" : "0S2"), l, level));
  for (const auto& [name, lambda] : {std::pair("1.67", 1.0), std::pair("5000", 4999.0)})
    for (const int level : {3, 6})
      study.record(measure_sphere(fmt::format("sphere, K/mu = {}", name), lambda, level));
  for (const Real volume : study.brief() ? std::vector<Real>{2} : std::vector<Real>{2, 8})
    for (const int level : {3, 6})
      study.record(measure_balloon(fmt::format("balloon, volume x {:g}", volume), volume, level));
  for (const Measurement& m : study.measurements()) {
    const std::string where = fmt::format("{}, level {}: ", m.method, m.level);
    if (m.method.starts_with("ball,") && m.level >= 12)
      study.require(where + "frequency", m.error("frequency"), {-1e-3, 1e-3});
    if (m.method.starts_with("sphere") && m.level >= 6) {
      study.require(where + "equator", m.error("equator"), {-1e-3, 1e-3});
      study.require(where + "pole", m.error("pole"), {-5e-3, 5e-3});
    }
    if (m.method.starts_with("balloon") && m.level >= 6)
      study.require(where + "pressure", m.error("pressure"), {-5e-3, 5e-3});
  }
}

const bool registered =
    register_entry(StudyEntry{"axisymmetry",
                              "bodies of revolution: vibrations of a ball, thick spheres, balloons",
                              "cells across the radius of the ball",
                              {6, 8, 12, 16, 24},
                              {8, 12},
                              run});

}  // namespace
}  // namespace meniscus::axisymmetry_study
