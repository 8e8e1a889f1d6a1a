// SPDX-License-Identifier: BSD-3-Clause
// The energy books, and saving and restoring of a state.
#include "solve/state.hpp"

#include "meniscus/error.hpp"

#include <fmt/core.h>

namespace meniscus {

void require_saved(bool in_range, const Archive& a, std::string_view name) {
  if (a.is_reading() && !in_range)
    throw FileError(
        fmt::format("the saved state '{}' is out of range: its file was changed", name));
}

void Books::begin(const Report& report, Real power_of_loads) {
  heat = report.heat;
  external_power = report.external_power;
  load_power = power_of_loads;
  outside = report.outside;
}

void Books::push(const Resultant& by, Real dt) {
  momentum += dt * by.force;
  angular_momentum += dt * by.moment;
  impulses += dt * by.force_size;
  angular_impulses += dt * by.moment_size;
}

void Books::remap(Real change) {
  remapped += change;
  last_remap = change;
  dissipated_at_remap = dissipated;
}

void Books::scale_momenta(Real factor) {
  momentum *= factor;
  angular_momentum *= factor;
}

void Books::add(const Report& report, Real power_of_loads, Real dt, Real last_share) {
  dissipated += report.lost + dt * (1 - last_share) * heat;
  external_work += report.external_work + dt / 2 * (external_power + load_power);
  push(outside, dt / 2);
  begin(report, power_of_loads);
  push(outside, dt / 2);
  dissipated += dt * last_share * heat;
  external_work += dt / 2 * (external_power + load_power);
}

void Books::archive(const Archive& a, int space_dimension) {
  const Dimension energy = of_sum(dimension::energy, space_dimension);
  const Dimension power = of_sum(dimension::power, space_dimension);
  a("dissipated", dissipated, energy);
  a("external_work", external_work, energy);
  a("remapped", remapped, energy);
  // Without a remap, nothing is saved of the last.
  if (a.is_reading()) last_remap = dissipated_at_remap = 0;
  if (a.is_reading() ? a.has("last_remap") : last_remap != 0) {
    const Archive last = a.in("last_remap");
    last("energy", last_remap, energy);
    last("dissipated", dissipated_at_remap, energy);
  }
  a("heat", heat, power);
  a("external_power", external_power, power);
  a("load_power", load_power, power);
  // Without external forces, nothing is saved of them.
  const bool acts = impulses + angular_impulses + outside.force_size + outside.moment_size > 0;
  if (a.is_reading()) {
    outside = {};
    impulses = angular_impulses = 0;
  }
  if (!(a.is_reading() ? a.has("outside") : acts)) return;
  const Archive part = a.in("outside");
  const Dimension force = of_sum(dimension::force, space_dimension);
  const Dimension moment = of_sum(dimension::energy, space_dimension);
  part("force", outside.force, force);
  part("moment", outside.moment, moment);
  part("force_size", outside.force_size, force);
  part("moment_size", outside.moment_size, moment);
  part("impulses", impulses, of_sum(dimension::momentum, space_dimension));
  part("angular_impulses", angular_impulses, of_sum(dimension::angular_momentum, space_dimension));
}

void State::archive(const Archive& a, int space_dimension) {
  a("time", time, dimension::time);
  a("step", step);
  a("epoch", epoch);
  require_saved(time >= 0 && step >= 0 && step <= 1e15 && epoch >= 0, a, "time, step, epoch");
  a("displacement", u, space_dimension, dimension::length);
  a("velocity", v, space_dimension, dimension::velocity);
  a("force", force, space_dimension, of_sum(dimension::force, space_dimension));
  for (Unknown& field : fields) {
    const Archive part = a.in("fields").in(field.spec.name);
    Dimension rate = field.spec.dimension;
    --rate.time;
    part("value", field.x, field.spec.components, field.spec.dimension);
    if (field.spec.evolution != Evolution::carried)
      part("rate", field.rate, field.spec.components, rate);
    part("force", field.f, field.spec.components);
  }
  if (!reactions.force.empty()) {
    a("reactions/force", reactions.force, of_sum(dimension::force, space_dimension));
    a("reactions/work", reactions.work, of_sum(dimension::energy, space_dimension));
  }
  books.archive(a.in("books"), space_dimension);
  a("demand/stiffness", demand.stiffness, {0, -2, 0});
  a("demand/longest", demand.longest, dimension::time);
  require_saved(demand.stiffness >= 0 && demand.longest > 0, a, "demand");
  if (a.is_reading()) energies.clear();
}

}  // namespace meniscus
