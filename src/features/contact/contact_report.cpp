// SPDX-License-Identifier: BSD-3-Clause
// Lines of the log about a [[contact]], and measures of drops on walls and on soft bodies.
#include "features/contact/contact_table.hpp"
#include "measure/ridge_measures.hpp"
#include "measure/wetting_measures.hpp"

#include <fmt/core.h>

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
      flat.equilibrium_gap, unit(dimension::length),
      flat.equilibrium_gap / surfaces(assembly).facet, flat.peak_traction,
      unit(dimension::pressure), flat.peak_gap, unit(dimension::length), flat.stiffness,
      unit({-2, -2, 1}));
  if (const std::string more = model->described(surfaces(assembly), assembly.units());
      !more.empty())
    note += ", " + more;
  // In form `dissertation` the traction is normal to the wall and does no work on the contact line,
  // so there is no contact angle.
  for (const std::string& body : bodies)
    if (const auto gamma = assembly.of(body).surface_energy; gamma && form != "dissertation")
      note += fmt::format(", contact angle of '{}': {}", body,
                          contact_angle_text(flat.adhesion, *gamma));
  assembly.note(note);
  assembly.note(
      fmt::format("contact '{}': {:.1f} MB", name, 1e-6 * static_cast<Real>(term.bytes())));
  report_points(assembly);
  if (assembly.initial()) advise(beginning(term, assembly), assembly);
  if (const auto doubt = model->doubt(surfaces(assembly)))
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
  BeginningContact<D> beginning{name, bodies, flat(assembly),
                                model->greatest_pressure(partner.has_value(), surfaces(assembly))};
  const Motion motion = assembly.initial()->motion();
  for (const MeasureSource& measure : term.measures())
    if (measure.name == "gap") beginning.gap = measure.compute(motion);
  if (partner) {
    beginning.partner = partner->shape;
    beginning.partner_motion = partner_motion();
  }
  return beginning;
}

/// Adds the measures of a drop that wets a rigid partner.
template <int D>
void Contact<D>::measure_wetting(Assembly<D>& assembly) const {
  if (!assembly.of(bodies[0]).surface_energy) return;
  for (MeasureSource& source : front_measures<D>(assembly.measure_named(name + ".wetted_area")))
    assembly.measure(name, std::move(source));
  assembly.wets({bodies[0],
                 {[shape = partner->shape, moved = partner_motion()](const Vec<D>& x, Real t) {
                    return shape->foot(x - moved.displacement(t)).distance;
                  },
                  flat(assembly).peak_gap}});
  if (partner->shape->flat() && assembly.initial() && assembly.is_dynamic())
    advise_on_spreading(name, bodies[0], flat(assembly).adhesion,
                        assembly.measure_named(name + ".wetted_area"), assembly);
  if (!partner->shape->round()) return;
  for (MeasureSource& source : cap_measures<D>(
           assembly.body(bodies[0]),
           [shape = partner->shape, moved = partner_motion()](const Vec<D>&x, Real t) {
             const auto foot = shape->foot(x - moved.displacement(t));
             return WallHeight{foot.distance, foot.bend.trace() / (D - 1)};
           },
           flat(assembly).peak_gap, partner->shape->flat()))
    if (source.name == "film")
      assembly.measure(name, std::move(source));
    else
      assembly.measure_of_cap(bodies[0], name, std::move(source), this->place);
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
  const Real W = model->greatest_adhesion(surfaces(assembly), assembly.end_time()),
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
    assembly.measure(name, {"wetted_area", D == 3 ? dimension::area : dimension::length,
                            "area in contact: energy of the interaction / adhesion",
                            [energy = assembly.measure_named(name + ".energy"), W = flat.adhesion](
                                const Motion& motion) { return -energy(motion) / W; }});
  for (MeasureSource& source : front_measures<D>(assembly.measure_named(name + ".wetted_area")))
    assembly.measure(name, std::move(source));
  for (MeasureSource& source :
       ridge_measures(assembly.body(bodies[0]), assembly.body(bodies[1]), flat.peak_gap))
    assembly.measure(name, std::move(source));
  if (const std::string why = folding(assembly); !why.empty())
    assembly.warn(fmt::format("contact '{}': {}", name, why));
  // Each surface stores half of the energy of the contact.
  const Real tension = assembly.of(bodies[1]).surface_energy.value_or(0);
  const Real half = model->greatest_adhesion(surfaces(assembly), assembly.end_time()) / 2;
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
