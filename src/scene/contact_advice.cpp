// SPDX-License-Identifier: BSD-3-Clause
// Impact pressure and elastocapillary number of a contact.
#include "meniscus/scene/contact_advice.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace meniscus {
namespace {

/// A body in the mean.
struct TouchingBody {
  Real density, shear_modulus, bulk_modulus, radius;  ///< of the ball (2D: disk) of its volume

  /// rho c of p-waves: pressure per speed at which it is hit.
  Real impedance() const { return std::sqrt(density * (bulk_modulus + 4 * shear_modulus / 3)); }
};

template <int D>
TouchingBody touching_body(const std::string& name, const Assembly<D>& assembly) {
  const Body<D>& body = assembly.body(name);
  Real volume = 0;
  for (Index A = 0; A < body.size(); ++A) volume += body.cells.volume(A);
  const Real mass = std::accumulate(body.mass.begin(), body.mass.end(), 0.0);
  const bool fluid = !assembly.viscosity(name).empty();
  return {mass / volume, fluid ? 0 : assembly.shear_modulus(name), assembly.bulk_modulus(name),
          D == 3 ? std::cbrt(3 * volume / (4 * std::numbers::pi))
                 : std::sqrt(volume / std::numbers::pi)};
}

/// Of its particles at the start; coefficients are near enough to places.
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

/// The largest speed of its particles relative to `other`.
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

template <int D>
void advise_on_impact(const BeginningContact<D>& contact, const std::vector<TouchingBody>& touching,
                      Assembly<D>& assembly) {
  const Body<D>& first = assembly.body(contact.bodies[0]);
  const State& begin = *assembly.initial();
  const bool two = touching.size() == 2;
  const Vec<D> other =
      two ? mean_velocity(assembly.body(contact.bodies[1]), begin) : contact.partner_velocity;
  const Real speed = largest_speed(first, begin, other);
  if (speed == 0) return;
  const Real Z = touching[0].impedance();
  const Real impact = speed * (two ? 1 / (1 / Z + 1 / touching[1].impedance()) : Z);
  const std::string pressure = assembly.units().symbol(dimension::pressure);
  assembly.note(fmt::format(
      "contact '{}': '{}' moves at {:.3g} {}, so that an impact presses with up to "
      "rho c v = {:.3g} {}; the contact holds {:.3g} {} at its least gap",
      contact.name, contact.bodies[0], speed, assembly.units().symbol(dimension::velocity), impact,
      pressure, contact.greatest_pressure, pressure));
  // Balls of 321 and 997 particles came through at 0.26 (scaled_lennard_jones) and at 0.74
  // (smooth_young) of it, and did not at 0.13 and 0.49.
  if (impact > contact.greatest_pressure / 5)
    assembly.warn(fmt::format(
        "contact '{}': an impact at {:.3g} {} may press with {:.3g} {}, where the contact holds "
        "{:.3g} {}: beyond a fifth of that surfaces may pass through each other, which stops the "
        "run; allowed are stronger contacts, softer bodies or less speed",
        contact.name, speed, assembly.units().symbol(dimension::velocity), impact, pressure,
        contact.greatest_pressure, pressure));
}

}  // namespace

template <int D>
void advise(const BeginningContact<D>& contact, Assembly<D>& assembly) {
  if (!assembly.initial()) return;  // was said when the scene began
  std::vector<TouchingBody> touching;
  for (const std::string& name : contact.bodies) {
    touching.push_back(touching_body(name, assembly));
    const TouchingBody& body = touching.back();
    if (!(body.shear_modulus > 0)) continue;
    const Real softness = contact.adhesion / (body.shear_modulus * body.radius);
    assembly.note(fmt::format("contact '{}': elastocapillary number W/(mu R) of '{}' {:.3g}",
                              contact.name, name, softness));
    const Real tension = assembly.surface_energy(name).value_or(0);
    const bool below_drop = &name != &contact.bodies[0] && touching[0].shear_modulus == 0;
    if (softness > 1 && tension < contact.adhesion / 2 && !below_drop)  // of drops others warn
      assembly.warn(fmt::format(
          "contact '{}': W/(mu R) of '{}' is {:.3g}: adhesion deforms it by more than its size, "
          "which its elasticity does not hold; expected is less than 1, by a stiffer body, less "
          "adhesion, or a [[surface_tension]] of more than half of it",
          contact.name, name, softness));
  }
  if (assembly.is_dynamic()) advise_on_impact(contact, touching, assembly);
}

template void advise(const BeginningContact<2>&, Assembly<2>&);
template void advise(const BeginningContact<3>&, Assembly<3>&);

}  // namespace meniscus
