// SPDX-License-Identifier: BSD-3-Clause
// Advice about a contact: impact pressure, elastocapillary number, Tabor number, and waves of
// spreading drops.
#include "features/contact/contact_advice.hpp"

#include "physics/contact/bent_line.hpp"
#include "physics/contact/contact_numbers.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace meniscus {
namespace {

/// Mean properties of a body in contact.
struct TouchingBody {
  Real density, shear_modulus, bulk_modulus, radius;  ///< of a ball (2D: disk) of its volume

  /// Impedance rho c of p-waves: the pressure of an impact divided by its speed.
  Real impedance() const { return std::sqrt(density * (bulk_modulus + 4 * shear_modulus / 3)); }
};

template <int D>
TouchingBody touching_body(const std::string& name, const Assembly<D>& assembly) {
  const Body<D>& body = assembly.body(name);
  const Real volume = body.volume();
  const Real mass = std::accumulate(body.mass.begin(), body.mass.end(), 0.0);
  const bool fluid = assembly.of(name).is_fluid();
  return {mass / volume, fluid ? 0 : assembly.shear_modulus(name), assembly.of(name).bulk_modulus,
          ball_radius(volume, body.space())};
}

/// Mean velocity of the particles at the start. Coefficients are used instead of values, which is
/// accurate enough here.
template <int D>
Vec<D> mean_velocity(const Body<D>& body, const State& begin) {
  Vec<D> sum = Vec<D>::Zero();
  Real mass = 0;
  for (Index A = 0; A < body.size(); ++A) {
    for (int i = 0; i < D; ++i) sum[i] += at(body.mass, A) * at(begin.v, body.first + A)[i];
    mass += at(body.mass, A);
  }
  return sum / mass;
}

/// The largest speed of the particles of a body relative to the velocity `other`.
template <int D>
Real largest_speed(const Body<D>& body, const State& begin, const Vec<D>& other) {
  Real largest = 0;
  for (Index A = 0; A < body.size(); ++A) {
    Vec<D> v = -other;
    for (int i = 0; i < D; ++i) v[i] += at(begin.v, body.first + A)[i];
    largest = std::max(largest, v.norm());
  }
  return largest;
}

/// Unit vector from the first body to the other body or partner.
template <int D>
Vec<D> towards(const BeginningContact<D>& contact, const Assembly<D>& assembly) {
  const auto middle = [&](const std::string& name) {
    const auto& X = assembly.body(name).particles.X();
    const Vec<D> sum = std::accumulate(X.begin(), X.end(), Vec<D>(Vec<D>::Zero()));
    return Vec<D>(sum / static_cast<Real>(X.size()));
  };
  const Vec<D> from = middle(contact.bodies[0]);
  if (!contact.partner) return (middle(contact.bodies[1]) - from).normalized();
  return -contact.partner->foot(from - contact.partner_motion.displacement(0)).normal;
}

/// The largest speed of the partner along a direction until the end of the run.
template <int D>
Real largest_speed_along(const Vec<D>& direction, const RigidMotion<D>& motion, Real end) {
  constexpr int looks = 200;
  Real largest = 0;
  for (int k = 0; k <= looks && motion.moves(); ++k)
    largest = std::max(largest, motion.velocity(end * k / looks, 1e-6 * end).dot(direction));
  return largest;
}

/// Speeds at which the first body approaches the other side.
struct Approaching {
  Real at_start;  ///< the largest speed of its particles relative to the other side
  Real later;     ///< at contact: largest partner speed, and speed gained from loads over the gap
};

template <int D>
Approaching approaching(const BeginningContact<D>& contact, const Assembly<D>& assembly) {
  const Body<D>& first = assembly.body(contact.bodies[0]);
  const State& begin = *assembly.initial();
  const Real end = assembly.end_time();
  const Vec<D> direction = towards(contact, assembly);
  Vec<D> other = Vec<D>::Zero(), pulled = assembly.acceleration(contact.bodies[0]);
  Real met = 0;
  if (contact.partner) {
    other = contact.partner_motion.velocity(0, 1e-6 * end);
    met = largest_speed(first, begin, Vec<D>(Vec<D>::Zero())) +
          largest_speed_along<D>(-direction, contact.partner_motion, end);
  } else {
    other = mean_velocity(assembly.body(contact.bodies[1]), begin);
    pulled -= assembly.acceleration(contact.bodies[1]);
  }
  const Real at_start = largest_speed(first, begin, other);
  const Real pull = std::max(0.0, pulled.dot(direction)),
             way = std::max(0.0, contact.gap - contact.rest_gap),
             fallen = std::min(pull * end, std::sqrt(2 * pull * way));
  return {at_start, std::hypot(std::max(at_start, met), fallen)};
}

template <int D>
void advise_on_impact(const BeginningContact<D>& contact, const std::vector<TouchingBody>& touching,
                      Assembly<D>& assembly) {
  const Approaching approach = approaching(contact, assembly);
  const Real speed = approach.later;
  if (!(speed > 0)) return;
  const bool two = touching.size() == 2;
  const Real Z = touching[0].impedance();
  const Real impact = speed * (two ? 1 / (1 / Z + 1 / touching[1].impedance()) : Z);
  const std::string pressure = assembly.units().symbol(dimension::pressure);
  assembly.note(fmt::format(
      "contact '{}': '{}' {} at {:.3g} {}, so that an impact presses with up to "
      "rho c v = {:.3g} {}; the contact holds {:.3g} {} at its least gap",
      contact.name, contact.bodies[0],
      speed > 1.001 * approach.at_start ? "is met, by its loads or the motion of the partner,"
                                        : "moves",
      speed, assembly.units().symbol(dimension::velocity), impact, pressure,
      contact.greatest_pressure, pressure));
  // Balls of 321 and 997 particles passed through the contact at 0.26 (scaled_lennard_jones) and at
  // 0.74 (smooth_young) of this pressure, but not at 0.13 and 0.49.
  if (impact > contact.greatest_pressure / 5)
    assembly.warn(fmt::format(
        "contact '{}': an impact at {:.3g} {} may press with {:.3g} {}, where the contact holds "
        "{:.3g} {}: beyond a fifth of that surfaces may pass through each other, which stops the "
        "run; allowed are stronger contacts, softer bodies or less speed",
        contact.name, speed, assembly.units().symbol(dimension::velocity), impact, pressure,
        contact.greatest_pressure, pressure));
}

/// Tabor number sigma (9 R/(2 pi W E*^2))^(1/3)/1.157 with the peak traction sigma. For a
/// Lennard-Jones contact it is (R W^2/(E*^2 g^3))^(1/3) with the equilibrium gap g (quasi-statics
/// note 6.1).
Real tabor_number(const std::vector<TouchingBody>& solids, const PlaneContact& flat) {
  Real compliance = 0, curvature = 0;  // 1/E* = sum (1 - nu)/(2 mu), 1/R
  for (const TouchingBody& solid : solids) {
    const Real K = solid.bulk_modulus, mu = solid.shear_modulus,
               nu = (3 * K - 2 * mu) / (2 * (3 * K + mu));
    compliance += (1 - nu) / (2 * mu);
    curvature += 1 / solid.radius;
  }
  return flat.peak_traction / 1.157 *
         std::cbrt(9 * compliance * compliance /
                   (2 * std::numbers::pi * flat.adhesion * curvature));
}

}  // namespace

template <int D>
void advise_on_spreading(const std::string& contact, const std::string& drop, Real adhesion,
                         const std::function<Real(const Motion&)>& wetted_area,
                         Assembly<D>& assembly) {
  constexpr Real calm = 0.1, far = 2;  // Ohnesorge number; wetted area at rest / at the start
  const Real gamma = assembly.of(drop).surface_energy.value_or(0);
  const std::vector<Real>& viscosity = assembly.of(drop).viscosity;
  if (!(gamma > 0) || viscosity.empty() || adhesion < gamma) return;  // beyond 90 degrees
  const Real volume = assembly.body(drop).volume();
  const TouchingBody whole = touching_body(drop, assembly);
  const Real mu = std::accumulate(viscosity.begin(), viscosity.end(), 0.0) /
                  static_cast<Real>(viscosity.size());
  const Real ohnesorge = mu / std::sqrt(whole.density * gamma * whole.radius);
  if (!(ohnesorge < calm)) return;
  if (const auto theta = contact_angle(adhesion, gamma)) {
    const int space = assembly.body(drop).space();
    const Real base = base_of_cap(*theta, space) * std::pow(volume, 1.0 / space),
               at_rest = space == 3 ? std::numbers::pi * base * base : 2 * base;
    if (at_rest < far * wetted_area(assembly.initial()->motion())) return;
  }
  const std::string more = mu > 0 ? fmt::format("{:.2g} times the viscosity", calm / ohnesorge)
                                  : std::string("a viscosity, of an Ohnesorge number of 0.1,");
  assembly.warn(fmt::format(
      "contact '{}': the Ohnesorge number of '{}' is {:.3g} and it has far to spread: below {:g} "
      "drops spread with waves, which take many steps and fine particles; take {} if only the rest "
      "matters, which does not depend on it",
      contact, drop, ohnesorge, calm, more));
}

template <int D>
void advise(const BeginningContact<D>& contact, Assembly<D>& assembly) {
  std::vector<TouchingBody> touching;
  for (const std::string& name : contact.bodies) {
    touching.push_back(touching_body(name, assembly));
    const TouchingBody& body = touching.back();
    if (!(body.shear_modulus > 0)) continue;
    const Real softness = contact.flat.adhesion / (body.shear_modulus * body.radius);
    assembly.note(fmt::format("contact '{}': elastocapillary number W/(mu R) of '{}' {:.3g}",
                              contact.name, name, softness));
    const Real tension = assembly.of(name).surface_energy.value_or(0);
    const bool below_drop = &name != &contact.bodies[0] && touching[0].shear_modulus == 0;
    // Another warning is about ground below drops.
    if (softness > 1 && tension < contact.flat.adhesion / 2 && !below_drop)
      assembly.warn(fmt::format(
          "contact '{}': W/(mu R) of '{}' is {:.3g}: adhesion deforms it by more than its size, "
          "which its elasticity does not hold; expected is less than 1, by a stiffer body, less "
          "adhesion, or a [[surface_tension]] of more than half of it",
          contact.name, name, softness));
  }
  const bool solid = std::all_of(touching.begin(), touching.end(),
                                 [](const TouchingBody& b) { return b.shear_modulus > 0; });
  if (solid && contact.flat.adhesion > 0 && (!contact.partner || contact.partner->flat()))
    assembly.note(fmt::format(
        "contact '{}': Tabor number {:.3g} (5 and more: adhesion acts within the contact, as JKR "
        "say; 0.1 and less: around it, as DMT say)",
        contact.name, tabor_number(touching, contact.flat)));
  if (assembly.is_dynamic()) advise_on_impact(contact, touching, assembly);
}

template void advise(const BeginningContact<2>&, Assembly<2>&);
template void advise(const BeginningContact<3>&, Assembly<3>&);
template void advise_on_spreading(const std::string&, const std::string&, Real,
                                  const std::function<Real(const Motion&)>&, Assembly<2>&);
template void advise_on_spreading(const std::string&, const std::string&, Real,
                                  const std::function<Real(const Motion&)>&, Assembly<3>&);

}  // namespace meniscus
