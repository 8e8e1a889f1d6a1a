// SPDX-License-Identifier: BSD-3-Clause
// Advice printed by `meniscus check`: dimensionless numbers of the scene, and changes that would
// save time steps.
#include "app/advice.hpp"

#include "app/print.hpp"
#include "input/text.hpp"
#include "meniscus/error.hpp"
#include "numbers/box.hpp"
#include "run/simulation.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace meniscus {
namespace {

/// A ball (2D: a disk) with the volume of a drop, for estimates.
struct RoundDrop {
  Real radius, gamma, density, viscosity, bulk_modulus;
  Real speed;                ///< largest speed of a particle at the start
  int principal_curvatures;  ///< 2 in 3D, 1 in 2D

  Real ohnesorge() const { return viscosity / std::sqrt(density * gamma * radius); }
  Real bond(Real acceleration) const { return density * acceleration * radius * radius / gamma; }
  Real time_of_sound() const { return radius / std::sqrt(bulk_modulus / density); }
  Real time_of_capillarity() const { return std::sqrt(density * radius * radius * radius / gamma); }
  Real time_of_viscosity() const { return density * radius * radius / viscosity; }
  /// The larger of the capillary pressure and the dynamic pressure.
  Real pressure() const {
    return std::max(principal_curvatures * gamma / radius, density * speed * speed);
  }
};

template <int D>
RoundDrop round_drop(const Scene<D>& scene, std::size_t number) {
  const Body<D>& body = scene.system.bodies[number];
  const SceneBody& own = scene.bodies[number];
  const Real volume = body.volume();
  Real fastest = 0;
  for (Index A = 0; A < body.size(); ++A) {
    const Lanes& v = at(scene.initial.v, body.first + A);
    fastest = std::max(fastest, sum(v * v));
  }
  const auto mean = [](const std::vector<Real>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<Real>(values.size());
  };
  const Real mass = std::accumulate(body.mass.begin(), body.mass.end(), 0.0);
  return {ball_radius(volume, body.space()),
          own.tension->gamma,
          mass / volume,
          mean(own.viscosity),
          own.bulk_modulus,
          std::sqrt(fastest),
          body.space() - 1};
}

/// Magnitude of the sum of all body forces on a body. Empty if the sum is zero or if a body force
/// varies.
template <int D>
std::optional<Real> constant_acceleration(const SceneInput& input, const std::string& body) {
  Vec<D> sum = Vec<D>::Zero();
  for (const Block& force : input.root().tables("body_force")) {
    if (force.text("body", "") != body) continue;
    const auto acceleration =
        force.expressions("acceleration", D, dimension::acceleration, std::nullopt);
    for (int i = 0; i < D; ++i) {
      if (!at(acceleration, i).constant()) return std::nullopt;
      sum[i] += at(acceleration, i)({0, 0, 0});
    }
  }
  return sum.norm() > 0 ? std::optional(sum.norm()) : std::nullopt;
}

/// The value, rounded up to two significant digits.
Real rounded_up(Real value) {
  const Real digit = std::pow(10, std::floor(std::log10(value)) - 1);
  return std::ceil(value / digit - 1e-9) * digit;
}

/// The stable step at the start. Empty if the scene cannot be built or its run cannot start.
template <int D>
std::optional<Real> stable_step(const SceneInput& input) {
  try {
    scene_dimension(input);  // must be read first
    Scene<D> scene = build_scene<D>(input);
    Simulation<D> simulation(scene);
    simulation.begin();
    return simulation.controller().stable().dt;
  } catch (const InputError&) {
  } catch (const SolveError&) {
  }
  return std::nullopt;
}

/// Distance that a body travels until the end time with its mean velocity and the net force of the
/// start, divided by the size of the body.
template <int D>
Real way_ahead(const Scene<D>& scene, const Body<D>& body, const State& state) {
  Vec<D> momentum = Vec<D>::Zero(), force = momentum;
  Real mass = 0;
  for (Index A = 0; A < body.size(); ++A) {
    mass += at(body.mass, A);
    for (int i = 0; i < D; ++i) {
      momentum[i] += at(body.mass, A) * at(state.v, body.first + A)[i];
      force[i] += at(state.force, body.first + A)[i];
    }
  }
  const Real T = scene.time.end;
  return (momentum.norm() * T + force.norm() * T * T / 2) / mass /
         std::pow(body.volume(), 1.0 / body.space());
}

}  // namespace

void say_units(const UnitSystem& units) {
  if (units.name() == "SI") return;
  const UnitSystem si;
  std::vector<std::string> equations;
  for (const Dimension d : {dimension::pressure, dimension::viscosity, dimension::tension,
                            dimension::force, dimension::energy})
    equations.push_back(
        fmt::format("1 {} = {:g} {}", units.symbol(d), units.in_si(d), si.symbol(d)));
  say("units: {}\n", joined(equations, ", "));
}

template <int D>
void say_drop_numbers(const Scene<D>& scene, const SceneInput& input) {
  for (const std::size_t drop : scene.drops()) {
    const RoundDrop r = round_drop(scene, drop);
    const std::string &name = scene.system.bodies[drop].name,
                      time = scene.units.symbol(dimension::time);
    const std::string viscous =
        r.viscosity > 0 ? fmt::format(", viscosity rho R^2/mu {:.3g}", r.time_of_viscosity()) : "";
    std::string bond;
    if (const auto g = constant_acceleration<D>(input, name))
      bond = fmt::format(", Bond number rho g R^2/gamma {:.4g}", r.bond(*g));
    say("drop '{}': radius of its volume {:.4g} {}, Ohnesorge number mu/sqrt(rho gamma R) "
        "{:.4g}{}; "
        "times of sound R/c {:.3g}, capillarity sqrt(rho R^3/gamma) {:.3g}{} {}\n",
        name, r.radius, scene.units.symbol(dimension::length), r.ohnesorge(), bond,
        r.time_of_sound(), r.time_of_capillarity(), viscous, time);
  }
}

template <int D>
void say_softer_drops(const Scene<D>& scene, const RunRequest& request, Real stable) {
  constexpr Real hard = 100, worth_a_trial = 4, worth_saying = 1.5;
  std::vector<std::string> settings = request.set, moduli;
  for (const std::size_t drop : scene.drops()) {
    const RoundDrop r = round_drop(scene, drop);
    const std::string& name = scene.system.bodies[drop].name;
    const Real enough = rounded_up(hard * r.pressure());
    if (r.bulk_modulus < worth_a_trial * enough) continue;
    settings.push_back(fmt::format("body.{}.material.bulk_modulus={}", name, enough));
    moduli.push_back(
        fmt::format("{:g} {} of '{}'", enough, scene.units.symbol(dimension::pressure), name));
  }
  if (moduli.empty()) return;
  const auto longer = stable_step<D>(SceneInput::from_file(request.scene, settings, request.stage));
  if (!longer || *longer < worth_saying * stable) return;
  say("bulk_modulus {} is a hundred times what surface tension and speed press with: where nothing "
      "else presses harder it would do, in {:.1f} times fewer steps\n",
      joined(moduli, ", "), *longer / stable);
}

template <int D>
void warn_of_idle_contacts(const Scene<D>& scene, const State& state) {
  constexpr Real no_share = 1e-6, no_way = 1e-3;
  if (scene.system.steady_after() > 0) return;
  for (const ContactBetween& contact : scene.contacts) {
    const auto energy =
        std::find_if(scene.measures.begin(), scene.measures.end(),
                     [&](const MeasureSource& m) { return m.name == contact.name + ".energy"; });
    if (energy == scene.measures.end()) continue;
    Real area = 0;
    bool moves = false;
    for (const Body<D>& body : scene.system.bodies) {
      const auto& names = contact.bodies;
      if (std::find(names.begin(), names.end(), body.name) == names.end()) continue;
      area = std::pow(box_around<D>(body.particles.X()).extent().maxCoeff(), D - 1);
      moves = moves || !(way_ahead(scene, body, state) < no_way);
    }
    if (moves || !(std::abs(energy->compute(state.motion())) <= no_share * contact.adhesion * area))
      continue;
    say("warning: contact '{}': nothing is in its reach at the start, and nothing moves '{}': no "
        "velocity, no net force, no load that changes; they meet only if their shapes change by as "
        "much. Move them nearer, or give an initial_velocity or a [[body_force]]\n",
        contact.name, joined(contact.bodies, "' and '"));
  }
}

#define MENISCUS_INSTANTIATE(D)                                             \
  template void say_drop_numbers(const Scene<D>&, const SceneInput&);       \
  template void say_softer_drops(const Scene<D>&, const RunRequest&, Real); \
  template void warn_of_idle_contacts(const Scene<D>&, const State&);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
