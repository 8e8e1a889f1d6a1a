// SPDX-License-Identifier: BSD-3-Clause
// Lines of the log about a [[contact]], and measures of drops on walls and on soft bodies.
#include "features/contact/contact_table.hpp"
#include "measure/ridge_measures.hpp"
#include "measure/wetting_measures.hpp"
#include "measure/young_laplace.hpp"

#include <fmt/core.h>

#include <cmath>
#include <numbers>

namespace meniscus::contact_table {

/// Logs the number of contact points per facet and the error due to their distance.
template <int D>
void Contact<D>::report_points(Assembly<D>& assembly) const {
  if (form == "volume") return;
  const ContactResolution r = resolution(assembly);
  const int chosen = points_chosen(assembly);
  assembly.note(fmt::format(
      "contact '{}': {} points per direction and facet{}, {:.3g} {} apart: {} up to {:.1g} of the "
      "normal force{}",
      name, chosen, points > 0 ? "" : " (chosen)", r.facet / chosen,
      assembly.units().symbol(dimension::length), r.rigid ? "torque" : "tangential force",
      r.tangential_share(chosen), r.rigid ? " times a radius" : ""));
}

/// Logs adhesion, gap, strength and stiffness of the contact of flat surfaces.
template <int D>
void Contact<D>::report(const ForceTerm& term, Assembly<D>& assembly) const {
  const auto unit = [&](Dimension d) { return assembly.units().symbol(d); };
  const PlaneContact& flat = this->flat(assembly);
  std::string note = fmt::format("contact '{}', {}, form {}: adhesion W = {:.6g} {}", name,
                                 interaction, form, flat.adhesion, unit(dimension::tension));
  if (flat.lost_adhesion() > 0)
    note += fmt::format(" ({:.1f} % lost by the cut-off)", 100 * flat.lost_adhesion());
  note += fmt::format(
      ", equilibrium gap {:.4g} {} ({:.2g} of the size of the facets), peak traction {:.4g} {} at "
      "{:.4g} {}, stiffness {:.4g} {}",
      rest_gap(assembly), unit(dimension::length), rest_gap(assembly) / surfaces(assembly).facet,
      flat.peak_traction, unit(dimension::pressure), peak_gap(assembly), unit(dimension::length),
      flat.stiffness, unit({-2, -2, 1}));
  if (const std::string more = law(assembly).described(assembly.units()); !more.empty())
    note += ", " + more;
  // In form `dissertation` the traction is normal to the wall and does no work on the contact line,
  // so there is no contact angle.
  for (const std::string& body : bodies)
    if (const auto gamma = assembly.of(body).surface_energy; gamma && form != "dissertation")
      note += fmt::format(", contact angle of '{}': {}", body,
                          contact_angle_text(flat.adhesion, *gamma));
  assembly.note(note);
  const std::string key = this->place.substr(this->place.rfind(' ') + 1);
  for (auto& [length, value] : law(assembly).lengths_by_facets())
    assembly.length_by_cells(key + "." + length, value);
  assembly.note(
      fmt::format("contact '{}': {:.1f} MB", name, 1e-6 * static_cast<Real>(term.bytes())));
  report_points(assembly);
  if (assembly.initial()) advise(beginning(term, assembly), assembly);
  if (const auto doubt = law(assembly).doubt(surfaces(assembly).facet))
    assembly.warn(fmt::format("contact '{}': {}", name, *doubt));
  if (form == "dissertation")
    assembly.warn(fmt::format(
        "contact '{}': form = \"dissertation\" is not the gradient of an energy: energy drifts at "
        "any step and resolution, momenta are conserved in the limit of fine points only",
        name));
  if (form == "pressure")
    assembly.warn(fmt::format(
        "contact '{}': form = \"pressure\" conserves energy and momenta only where the points are "
        "closer than a third of the gap",
        name));
}

template <int D>
BeginningContact<D> Contact<D>::beginning(const ForceTerm& term,
                                          const Assembly<D>& assembly) const {
  BeginningContact<D> beginning{name, bodies, flat(assembly), rest_gap(assembly),
                                greatest_pressure(assembly)};
  const Motion motion = assembly.initial()->motion();
  for (const MeasureSource& measure : term.measures())
    if (measure.name == "gap") beginning.gap = measure.compute(motion);
  if (partner) {
    beginning.partner = partner->shape;
    beginning.partner_motion = partner_motion();
  }
  return beginning;
}

/// The contact line of the drop at a motion. If the adhesion varies, it is that at the mean place
/// of the particles.
template <int D>
LineAt Contact<D>::line(const Assembly<D>& assembly) const {
  if (form == "dissertation") return [](const Motion&) { return BentLine(); };
  const Real gamma = *assembly.of(bodies[0]).surface_energy, volume = surfaces(assembly).volume;
  law(assembly);
  if (!law_->pattern())
    return [line = bent_line(*law_, flat_.adhesion, gamma, volume, surfaces(assembly).dimension)](
               const Motion&) { return line; };
  return [law = law_, gamma, volume, &body = assembly.body(bodies[0]),
          moved = partner_motion()](const Motion& motion) {
    const auto u = body.part(motion.u);
    Vec<D> mean = -moved.displacement(motion.time);
    for (Index A = 0; A < body.size(); ++A)
      for (int i = 0; i < D; ++i)
        mean[i] += (at(body.particles.X(), A)[i] + at(u, A)[i]) / static_cast<Real>(body.size());
    return bent_line(*law, (*law->pattern())(spatial<D>(mean), motion.time), gamma, volume,
                     body.space());
  };
}

/// Logs where the wall of a drop on a rigid partner is, and the sharp line as an alternative.
template <int D>
void Contact<D>::report_line(const LineAt& line, Assembly<D>& assembly) const {
  if (!assembly.initial()) return;
  const Motion begin = assembly.initial()->motion();
  const BentLine at_rest = line(begin);
  if (!(at_rest.radius > 0)) {
    if (law(assembly).ends() && form != "dissertation")
      assembly.warn(fmt::format(
          "contact '{}': its range bends all of the surface of '{}', whose angle and base are read "
          "at the film; expected is a range of less than a tenth of the drop",
          name, bodies[0]));
    return;
  }
  const Real pi = std::numbers::pi, r = at_rest.radius, volume = surfaces(assembly).volume,
             space = surfaces(assembly).dimension, base = space == 3 ? pi * r * r : 2 * r;
  const std::string unit = assembly.units().symbol(dimension::length);
  assembly.note(fmt::format(
      "contact '{}': at rest on a plane the base of '{}' has the radius {:.4g} {}; angle, base and "
      "height are read at the wall, {:.4g} {} below the film, whose gap changes lengths by {:+.2g} "
      "%",
      name, bodies[0], r, unit, at_rest.depth, unit,
      100.0 / space * at_rest.depth * base / volume));
  const Real wet = assembly.measure_named(name + ".wetted_area")(begin);
  if (wet > 0.3 * base && !law(assembly).pattern() && partner->shape->round())
    assembly.note(fmt::format(
        "contact '{}': '{}' begins on its wall: if it stays there and has a face there, a "
        "[[wetted]] face has a sharp contact line, is more accurate and faster",
        name, bodies[0]));
}

/// The contact angle of the profile of Young and Laplace with base, volume and weight of a drop.
/// Where the weight is not normal to the wall, or without such a profile, it is the angle `near`
/// the wall.
template <int D>
MeasureSource Contact<D>::angle_under_weight(const MeasureSource& near, const LineAt& line,
                                             const Assembly<D>& assembly) const {
  const auto angle = [of_part = near.compute, line, gamma = *assembly.of(bodies[0]).surface_energy,
                      base_of = assembly.measure_named(name + ".base_radius"),
                      volume_of = assembly.measure_named(bodies[0] + ".volume"),
                      weight_at = assembly.weight(bodies[0]), space = surfaces(assembly).dimension,
                      up = partner->shape->foot(Vec<D>::Zero()).normal](const Motion& motion) {
    constexpr Real degree = std::numbers::pi / 180;
    const Real base = base_of(motion),
               area = space == 3 ? std::numbers::pi * base * base : 2 * base,
               volume = volume_of(motion) + line(motion).depth * area;
    const Vec<D> weight = weight_at(motion.time);
    const Real down = -weight.dot(up);
    if ((weight + down * up).norm() > 1e-9 * weight.norm()) return of_part(motion);
    const Real bond = down / (gamma * volume),
               theta = space == 3 ? profile_on<3>(base, volume, bond).contact_angle
                                  : profile_on<2>(base, volume, bond).contact_angle;
    return std::isnan(theta) ? of_part(motion) : theta / degree;
  };
  return {near.name, near.dimension,
          "in degrees, of the profile of Young and Laplace with its base, volume and weight",
          angle};
}

/// Adds the measures of a drop that wets a rigid partner.
template <int D>
void Contact<D>::measure_wetting(Assembly<D>& assembly) const {
  if (!assembly.of(bodies[0]).surface_energy) return;
  const LineAt line = this->line(assembly);
  for (MeasureSource& source : front_measures(assembly.measure_named(name + ".wetted_area"), line,
                                              surfaces(assembly).dimension))
    assembly.measure(name, std::move(source));
  const auto gap = [shape = partner->shape, moved = partner_motion()](const Vec<D>& x, Real t) {
    return shape->foot(x - moved.displacement(t)).distance;
  };
  assembly.wets({bodies[0], {gap, peak_gap(assembly)}});
  assembly.walls_of(bodies[0])->push_back(gap);
  report_line(line, assembly);
  if (partner->shape->flat() && assembly.initial() && assembly.is_dynamic())
    advise_on_spreading(name, bodies[0], flat(assembly).adhesion,
                        assembly.measure_named(name + ".wetted_area"), assembly);
  if (partner->shape->round()) measure_angles(line, assembly);
}

/// Adds the measures of the shape of a drop on a wall of constant curvature.
template <int D>
void Contact<D>::measure_angles(const LineAt& line, Assembly<D>& assembly) const {
  // At this part of the film the energy of smooth_young has changed by 1 %.
  constexpr Real part_of_film = 0.2;
  const std::string& drop = bodies[0];
  const Body<D>& body = assembly.body(drop);
  const Real rest = rest_gap(assembly), peak = peak_gap(assembly);
  const Real gamma = *assembly.of(drop).surface_energy, volume = surfaces(assembly).volume;
  const auto moved = partner_motion();
  const DropOnWall<D> wall{
      [shape = partner->shape, moved](const Vec<D>& x, Real t) {
        return shape->foot(x - moved.displacement(t));
      },
      rest + part_of_film * (peak - rest),
      law(assembly).ends() ? law(assembly).range() - law(assembly).recess()
                           : rest + 3 * (peak - rest),
      line,
      [moved, step = 1e-4 * assembly.end_time()](Real t) { return moved.velocity(t, step); },
      [weight = assembly.weight(drop), gamma, volume](Real t) -> Vec<D> {
        return weight(t) / (gamma * volume);
      },
      partner->shape->flat(),
      assembly.walls_of(drop)};
  std::optional<MeasureSource> near;
  for (MeasureSource& source : profile_measures<D>(body, wall))
    if (source.name == "contact_angle")
      near = std::move(source);
    else
      assembly.measure(name, std::move(source));
  const bool weighs =
      wall.flat && !assembly.of(drop).accelerations.empty() && !assembly.of(drop).other_body_forces;
  for (MeasureSource& source : cap_measures<D>(body, wall))
    if (source.name == "film")
      assembly.measure(name, std::move(source));
    else if (source.name == "contact_angle")
      assembly.measure_of_cap(drop, name,
                              weighs ? angle_under_weight(*near, line, assembly) : source,
                              this->place, near);
    else
      assembly.measure_of_cap(drop, name, std::move(source), this->place);
}

/// The largest adhesion at the centre of the first body at a thousand times until the end.
template <int D>
Real Contact<D>::greatest_adhesion(const Assembly<D>& assembly) const {
  constexpr int times = 1000;
  Real greatest = flat(assembly).adhesion;
  if (const AdhesionPattern* W = law(assembly).pattern())
    for (int k = 0; k <= times; ++k)
      greatest =
          std::max(greatest, (*W)(surfaces(assembly).centre, k * assembly.end_time() / times));
  return greatest;
}

/// True if the first body is a drop and the second is a solid.
template <int D>
bool Contact<D>::soft_wetting(const Assembly<D>& assembly) const {
  return !partner && assembly.of(bodies[0]).surface_energy && assembly.of(bodies[0]).is_fluid() &&
         !assembly.of(bodies[1]).is_fluid();
}

/// Warns that the surface of soft ground may fold. The adhesion W with range l pulls the surface
/// nearer by about W/E; if this is a considerable part of l, the surface jumps into contact
/// (wetting note 10). Empty if no fold is expected.
template <int D>
std::string Contact<D>::folding(const Assembly<D>& assembly) const {
  constexpr Real largest = 1.0 / 3, peak_of_chi = 1.875;
  const PlaneContact& flat = this->flat(assembly);
  const Real W = greatest_adhesion(assembly),
             range = peak_of_chi * flat.adhesion / flat.peak_traction;
  const Real mu = assembly.shear_modulus(bodies[1]), K = assembly.of(bodies[1]).bulk_modulus,
             E = 9 * K * mu / (3 * K + mu);
  const Real number = W / (E * range);
  if (number <= largest || assembly.of(bodies[1]).surface_energy.value_or(0) > W / 2) return {};
  const auto unit = [&](Dimension d) { return assembly.units().symbol(d); };
  return fmt::format(
      "adhesion with actin / (Young's modulus x range) is {:.3g} of '{}', {:.4g} {} at most, "
      "{:.4g} {} and {:.4g} {}: beyond 1/3 its surface jumps into contact and folds; expected "
      "is a modulus of at least {:.4g} {}, a range of at least {:.4g} {}, less adhesion, or a "
      "[[surface_tension]] of it of more than {:.4g} {}",
      number, bodies[1], W, unit(dimension::tension), E, unit(dimension::pressure), range,
      unit(dimension::length), W / (largest * range), unit(dimension::pressure), W / (largest * E),
      unit(dimension::length), W / 2, unit(dimension::tension));
}

/// Adds the measures of a drop that wets a soft body.
template <int D>
void Contact<D>::measure_soft_wetting(Assembly<D>& assembly) const {
  if (!soft_wetting(assembly)) return;
  const PlaneContact& flat = this->flat(assembly);
  // If the adhesion varies, the contact itself has this measure.
  if (!assembly.has_measure(name + ".wetted_area"))
    assembly.measure(name, {"wetted_area", of_sum(dimension::area, D),
                            "area in contact: energy of the interaction / adhesion",
                            [energy = assembly.measure_named(name + ".energy"), W = flat.adhesion](
                                const Motion& motion) { return -energy(motion) / W; }});
  for (MeasureSource& source : front_measures(
           assembly.measure_named(name + ".wetted_area"), [](const Motion&) { return BentLine(); },
           surfaces(assembly).dimension))
    assembly.measure(name, std::move(source));
  for (MeasureSource& source :
       ridge_measures(assembly.body(bodies[0]), assembly.body(bodies[1]), flat.peak_gap))
    assembly.measure(name, std::move(source));
  if (const std::string why = folding(assembly); !why.empty())
    assembly.warn(fmt::format("contact '{}': {}", name, why));
  // Each surface stores half of the energy of the contact.
  const Real tension = assembly.of(bodies[1]).surface_energy.value_or(0);
  const Real half = greatest_adhesion(assembly) / 2;
  if (up.empty() && tension < half)
    assembly.warn(fmt::format(
        "contact '{}': half of the adhesion, {:.4g} {}, is taken from the surface of '{}', whose "
        "tension is {:.4g}: "
        "its surface crumples where its elasticity does not prevent it; expected is a "
        "[[surface_tension]] of more than that, or the direction `up` of a ground",
        name, half, assembly.units().symbol(dimension::tension), bodies[1], tension));
}

#define MENISCUS_INSTANTIATE(D)                                           \
  template void Contact<D>::report(const ForceTerm&, Assembly<D>&) const; \
  template void Contact<D>::measure_wetting(Assembly<D>&) const;          \
  template void Contact<D>::measure_soft_wetting(Assembly<D>&) const;     \
  template bool Contact<D>::soft_wetting(const Assembly<D>&) const;       \
  template std::string Contact<D>::folding(const Assembly<D>&) const;
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus::contact_table
