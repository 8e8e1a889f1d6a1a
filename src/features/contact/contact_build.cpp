// SPDX-License-Identifier: BSD-3-Clause
// The force term of a [[contact]], its contact points, and checks of the initial state.
#include "features/contact/contact_table.hpp"
#include "input/text.hpp"
#include "meniscus/error.hpp"
#include "physics/contact/points/containment.hpp"

#include <fmt/core.h>

#include <numeric>

namespace meniscus::contact_table {
namespace {

template <int D>
std::optional<TensionForm> form_of_tension(const Assembly<D>& assembly, const std::string& body) {
  const auto& tension = assembly.of(body).tension;
  return tension ? std::optional(tension->form) : std::nullopt;
}

}  // namespace

template <int D>
ContactSurfaces Contact<D>::surfaces(const Assembly<D>& assembly) const {
  Real facet = 0;
  for (const std::string& body : bodies) facet = std::max(facet, facet_size(assembly.body(body)));
  const Body<D>& first = assembly.body(bodies[0]);
  const auto& X = first.particles.X();
  const Vec<D> sum = std::accumulate(X.begin(), X.end(), Vec<D>(Vec<D>::Zero()));
  return {this->place,
          facet,
          assembly.of(bodies[0]).surface_energy,
          spatial<D>(sum / static_cast<Real>(X.size())),
          form_of_tension(assembly, bodies[0]),
          bodies.size() > 1 ? assembly.of(bodies[1]).surface_energy : std::nullopt,
          partner.has_value(),
          first.space(),
          first.volume()};
}

template <int D>
ContactResolution Contact<D>::resolution(const Assembly<D>& assembly) const {
  const Real gap = flat(assembly).equilibrium_gap;
  return {surfaces(assembly).facet, gap, partner.has_value(),
          law(assembly).ends() ? law(assembly).range() - gap : 0};
}

template <int D>
int Contact<D>::points_chosen(const Assembly<D>& assembly) const {
  if (points > 0) return points;
  return form == "volume" ? 2 : resolution(assembly).enough_points();
}

template <int D>
ContactChoice Contact<D>::choice(const Assembly<D>& assembly) const {
  ContactChoice choice;
  choice.name = name;
  for (std::size_t k = 0; k < contact_form_names.size(); ++k)
    if (contact_form_names[k] == form) choice.form = static_cast<ContactForm>(k);
  choice.density = density == "constant" ? SiteDensity::constant : SiteDensity::referential;
  for (std::size_t side = 0; side < bodies.size(); ++side)
    choice.on_patches[side] = assembly.of(bodies[side]).has_balanced_tension();
  choice.points = points_chosen(assembly);
  choice.skin = skin;
  choice.friction = friction;
  choice.up = up;
  if (const std::string why = soft_wetting(assembly) ? folding(assembly) : ""; !why.empty())
    choice.fold = ": " + why;
  choice.overlap = overlap(assembly);
  choice.wets = assembly.of(bodies[0]).surface_energy.has_value();
  return choice;
}

/// Advice for a run in which a surface passes through the contact: the pressure it withstands, and
/// the keys that raise it.
template <int D>
std::string Contact<D>::overlap(const Assembly<D>& assembly) const {
  std::vector<std::string> lengths, strengths;
  for (const KeyText& key : interactions<D>().at(interaction).keys()) {
    if (key.key == "range" || key.key == "offset" || key.key == "sigma0")
      lengths.push_back(key.key);
    if (key.key == "adhesion" || key.key == "epsilon") strengths.push_back(key.key);
  }
  return fmt::format(
      ": what presses harder than {:.3g} {} comes through this contact; a shorter {} or more {} "
      "hold more, slower or softer bodies press less, and more points than {} per facet or finer "
      "cells see a corner earlier",
      greatest_pressure(assembly), assembly.units().symbol(dimension::pressure),
      joined(lengths, ", "), joined(strengths, ", "), points_chosen(assembly));
}

template <int D>
std::unique_ptr<ForceTerm> Contact<D>::term(const Assembly<D>& assembly) const {
  const Body<D>& first = assembly.body(bodies[0]);
  if (!partner)
    return model->between(first, assembly.body(bodies[1]), choice(assembly), surfaces(assembly));
  return model->with_partner(first, {partner->shape, partner_motion(), 1e-4 * assembly.end_time()},
                             choice(assembly), surfaces(assembly));
}

template <int D>
RigidMotion<D> Contact<D>::new_partner_motion() const {
  if (!partner) return {};
  if (!partner->pressed())
    return partner->displacement.empty() ? RigidMotion<D>() : RigidMotion<D>(partner->displacement);
  return RigidMotion<D>(std::make_shared<PartnerPress<D>>(typename PartnerPress<D>::Settings{
      Vec<D>::Map(partner->direction.data()).normalized(), partner->force.value_or(Expression(0)),
      partner->base.value_or(Expression(0)), partner->stiffness, partner->ramp}));
}

/// Throws InputError if the surfaces start closer than the least gap, where no step can resolve the
/// forces.
template <int D>
void Contact<D>::require_gap(ForceTerm& term, const State& initial) const {
  NodalVectors force(initial.u.size(), Lanes::zero());
  if (const auto failure = term.add_force(initial.motion(), force).failure)
    throw InputError(fmt::format("{}: {}; move the bodies apart", this->place, failure->cause));
}

/// Throws InputError if contact points are farther apart than the interaction reaches: the bodies
/// could pass through each other without a force.
template <int D>
void Contact<D>::require_points_to_meet(const Assembly<D>& assembly) const {
  const ContactResolution r = resolution(assembly);
  const int chosen = points_chosen(assembly);
  if (!r.points_miss(chosen)) return;
  throw InputError(fmt::format(
      "{}: the contact points of '{}' and '{}' are {:.3g} apart, {} per direction and facet, where "
      "their equilibrium gap is {:.3g}: the bodies would go through each other without a force; "
      "allowed are distances up to {:.3g} (finer bodies, or an interaction of longer reach)",
      this->place, bodies[0], bodies[1], r.facet / chosen, chosen, r.gap, r.longest_spacing()));
}

/// Check of the state: only forces keep the bodies apart, so a run must end if a body has passed
/// through the surface of another.
template <int D>
StateCheck Contact<D>::containment(const Assembly<D>& assembly) const {
  const Body<D>& first = assembly.body(bodies[0]);
  const auto named = [term = fmt::format("contact '{}'", name)](std::optional<Failure> failure) {
    if (failure) failure->term = term;
    return failure;
  };
  if (!partner)
    return [named, &first, &second = assembly.body(bodies[1])](const Motion& motion) {
      return named(body_inside(first, second, motion));
    };
  return [named, &first, places = partner->shape->places(),
          moved = partner_motion()](const Motion& motion) {
    if (places.empty()) return std::optional<Failure>();
    std::vector<Vec<D>> now = places;
    for (Vec<D>& x : now) x += moved.displacement(motion.time);
    return named(partner_inside<D>(first, now, motion));
  };
}

template struct Contact<2>;
template struct Contact<3>;

}  // namespace meniscus::contact_table
