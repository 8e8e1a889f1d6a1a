// SPDX-License-Identifier: BSD-3-Clause
// Adhesive contact of two bodies, or of a body with a rigid partner.
#include "input/optional_rows.hpp"
#include "input/text.hpp"
#include "measure/ridge_measures.hpp"
#include "measure/wetting_measures.hpp"
#include "meniscus/error.hpp"
#include "meniscus/physics/interaction_registry.hpp"
#include "meniscus/scene/assembly.hpp"
#include "physics/contact/contact_numbers.hpp"
#include "physics/contact/points/contact_resolution.hpp"
#include "physics/contact/points/containment.hpp"
#include "scene/contact_advice.hpp"

#include <fmt/core.h>

#include <numeric>

namespace meniscus::contact_load {
namespace {

struct Keys {
  std::string name, form, density, interaction;
  std::vector<std::string> bodies;
  std::vector<Real> up;
  Real skin = 0, friction = 0;
  int points = 0;
  static Rows<Keys> rows();
};

/// What an absent key stands for.
std::string usual_interaction(const Block& block) {
  if (!block.has("contact_angle") && !block.has("adhesion")) return "lennard_jones";
  return block.has("sigma0") ? "scaled_lennard_jones" : "smooth_young";
}
std::vector<std::string> forms() {
  return {contact_form_names.begin(), contact_form_names.end()};
}

Rows<Keys> Keys::rows() {
  Row<Keys> interaction =
      choice_row("interaction", &Keys::interaction, interactions<3>().names(),
                 "by which they act on each other; its own keys follow in the same table. With an "
                 "adhesion or a contact_angle it may be left out: it is smooth_young then, or "
                 "with sigma0 scaled_lennard_jones",
                 "lennard_jones");
  interaction.read = [](Keys& keys, const Block& block) {
    keys.interaction =
        block.choice("interaction", interactions<3>().names(), usual_interaction(block));
  };
  Row<Keys> form =
      choice_row("form", &Keys::form, forms(),
                 "gradient of the surface energy (conserves energy and momenta exactly); "
                 "disjoining pressure; forces between volume points; traction of the dissertation "
                 "(not the gradient of any energy), the only one of legacy_switch",
                 "energy");
  form.read = [](Keys&, const Block&) {};  // with the interaction, which knows its usual one
  return {
      text_row("name", &Keys::name, "by which messages and measures call it; empty: the bodies",
               ""),
      texts_row("bodies", &Keys::bodies,
                "names of two bodies, or of one that has a [contact.partner]"),
      interaction,
      form,
      choice_row("density", &Keys::density, {"constant", "referential"},
                 "surface forms: beta per current volume, or per reference volume (beta/J); the "
                 "form volume is referential",
                 "constant"),
      integer_row(
          "points", &Keys::points, {0, 20},
          "Gauss points per direction and facet of the surface (form volume: cell); 0: so "
          "many that tangential forces of smooth bodies stay below 1e-3 of the normal ones, "
          "2 to 8 (rigid partners: to 4, form volume: 2)",
          0),
      real_row("skin", &Keys::skin, dimension::none, {0.01, 10},
               "reach of the list beyond the cut-off / sigma0 (a law of the gap: / quarter of its "
               "range)",
               0.4),
      reals_row("up", &Keys::up, 0, dimension::none, range::any,
                "of two bodies with a law of the gap: the first is a drop that rests on the "
                "second, ground below it, and this points from the ground to the drop. Gaps are "
                "those along it and the drop has all of the energy, as on a rigid partner; "
                "without it both surfaces have a half",
                std::vector<Real>{}),
      real_row("friction", &Keys::friction, {-2, -1, 1}, range::non_negative,
               "with a rigid partner: traction along it per relative speed where the surfaces "
               "touch, fading with the energy of the interaction",
               0.0),
  };
}

/// [contact.partner]
template <int D>
struct Partner {
  std::shared_ptr<const PartnerShape<D>> shape;
  std::vector<Expression> displacement;  // of the time; empty: at rest

  static Rows<Partner> rows() {
    Row<Partner> type = choice_row<Partner>("type", nullptr, partners<D>().names(),
                                            "kind of the rigid partner; its own keys follow");
    type.read = [](Partner& p, const Block& block) {
      const auto kind = block.kind("type", partners<D>().names());
      if (kind) p.shape = partners<D>().at(*kind).read(block);
    };
    return {type, optional_expressions_row("displacement", &Partner::displacement, D,
                                           dimension::length, Variables::time,
                                           "prescribed motion, a formula of t for each component")};
  }
};

/// Of the interactions and of the partners.
std::vector<KeyTable> tables_of_parts() {
  std::vector<KeyTable> tables;
  for (const auto& [name, interaction] : interactions<3>())
    tables.push_back(
        {fmt::format("[[contact]] interaction = \"{}\": {}", name, interaction.meaning),
         interaction.keys(),
         fmt::format("[[contact]]\nbodies = [\"drop\", \"other\"]\ninteraction = \"{}\"\n{}", name,
                     interaction.example)});
  // In the plane there are all partners of space, and more.
  tables.push_back({"[contact.partner] of any type", key_texts(Partner<2>::rows())});
  for (const auto& [name, partner] : partners<2>()) {
    const auto* in_space = partners<3>().find(name);
    tables.push_back({fmt::format("[contact.partner] type = \"{}\"{}: {}", name,
                                  in_space ? "" : " (2D)", partner.meaning),
                      in_space ? in_space->keys() : partner.keys(),
                      fmt::format("[contact.partner]\ntype = \"{}\"\n{}", name,
                                  in_space ? in_space->example : partner.example)});
  }
  return tables;
}

template <int D>
struct Contact final : Load<D>, Keys {
  static constexpr std::string_view example =
      "bodies = [\"drop\", \"other\"]\nepsilon = 1\nsigma0 = 0.3\nbeta = 1\n";
  std::unique_ptr<const ContactModel<D>> model;
  std::optional<Partner<D>> partner;  // none: between two bodies

  void read_inner(const Block& block) {
    model = interactions<D>().at(interaction).read(block);
    form = block.choice("form", forms(), model->usual_form());
    if (const auto table = block.table("partner")) {
      partner = read<Partner<D>>(*table);
      table->done();
    }
    if (name.empty() && !bodies.empty())
      name = bodies[0] + "-" + (bodies.size() > 1 ? bodies[1] : "partner");
  }
  static std::vector<KeyTable> inner_tables() { return tables_of_parts(); }

  std::optional<typename Load<D>::Identity> identity() const override { return {{"name", name}}; }
  void check(const Block& block, const BodyPlans<D>& planned) const override;
  void build(Assembly<D>& assembly) const override;

 private:
  ContactChoice choice(const Assembly<D>& assembly) const;
  ContactSurfaces surfaces(const Assembly<D>& assembly) const;
  /// Computed once in build(), which uses it many times. Throws InputError if it is not finite.
  const PlaneContact& flat(const Assembly<D>& assembly) const {
    if (!flat_) {
      flat_ = model->flat(partner.has_value(), surfaces(assembly));
      require_finite(*flat_, this->place);
    }
    return *flat_;
  }
  ContactResolution resolution(const Assembly<D>& assembly) const;
  int points_chosen(const Assembly<D>& assembly) const;
  std::unique_ptr<ForceTerm> term(const Assembly<D>& assembly) const;
  RigidMotion<D> partner_motion() const;
  void require_gap(ForceTerm& term, const State& initial) const;
  void require_points_to_meet(const Assembly<D>& assembly) const;
  void report_points(Assembly<D>& assembly) const;
  StateCheck containment(const Assembly<D>& assembly) const;
  void report(const ForceTerm& term, Assembly<D>& assembly) const;
  void measure_wetting(Assembly<D>& assembly) const;
  void measure_soft_wetting(Assembly<D>& assembly) const;
  bool soft_wetting(const Assembly<D>& assembly) const;
  std::string folding(const Assembly<D>& assembly) const;
  std::string overlap(const Assembly<D>& assembly) const;
  BeginningContact<D> beginning(const ForceTerm& term, const Assembly<D>& assembly) const;

  mutable std::optional<PlaneContact> flat_;
};

template <int D>
void Contact<D>::check(const Block& block, const BodyPlans<D>& planned) const {
  require_plain_name(block, name);
  const std::size_t wanted = partner ? 1 : 2;
  if (block.has("bodies") && bodies.size() != wanted)
    block.problem("bodies", fmt::format("names {} bodies; allowed are two, or one with a "
                                        "[contact.partner]",
                                        bodies.size()));
  for (const std::string& body : bodies) require_body(block, planned, body, "bodies");
  if (bodies.size() == 2 && bodies[0] == bodies[1])
    block.problem("bodies", fmt::format("'{}' cannot be in contact with itself", bodies[0]));
  model->check(block, partner.has_value());
  if (friction > 0 && !partner)
    block.problem("friction", "is for rigid partners; allowed between two bodies is 0");
  if (!up.empty() && partner)
    block.problem("up", "is for two bodies; a [contact.partner] has a direction of its own");
  if (!up.empty() && up.size() != D)
    block.problem("up", fmt::format("has {} numbers; expected is a vector of {}", up.size(), D));
  else if (!up.empty() && !(Vec<D>::Map(up.data()).norm() > 0))
    block.problem("up", "has no direction; allowed is any vector of a finite length > 0");
  if (form != "volume") return;
  if (block.has("density") && density == "constant")
    block.problem("density",
                  "form = \"volume\" has beta per reference volume; allowed is referential");
  if (partner)
    block.problem("form",
                  "volume is for two bodies; allowed with a rigid partner are energy, pressure, "
                  "dissertation");
}

template <int D>
void Contact<D>::build(Assembly<D>& assembly) const {
  flat_.reset();
  require_points_to_meet(assembly);
  std::unique_ptr<ForceTerm> term = this->term(assembly);
  const StateCheck inside = containment(assembly);
  if (const State* initial = assembly.initial()) {
    if (const auto failure = inside(initial->motion()))
      throw InputError(fmt::format("{}: {}; move the bodies apart", this->place,
                                   assembly.located(*failure).text()));
    require_gap(*term, *initial);
  }
  assembly.check(inside);
  report(*term, assembly);
  if (density == "referential" || form == "volume")
    for (const std::string& body : bodies)
      assembly.keep_reference(body, "its [[contact]] has beta per volume of the reference");
  if (!partner && model->placed(surfaces(assembly)))
    assembly.keep_reference(bodies[1], "the adhesion of its [[contact]] is a formula of it");
  assembly.add(std::move(term), name);
  assembly.contact({name, bodies, flat(assembly).adhesion});
  if (partner) {
    assembly.draw({name, partner->shape, partner_motion()});
    measure_wetting(assembly);
  } else {
    measure_soft_wetting(assembly);
  }
}

template <int D>
std::optional<TensionForm> form_of_tension(const Assembly<D>& assembly, const std::string& body) {
  const auto& tension = assembly.of(body).tension;
  return tension ? std::optional(tension->form) : std::nullopt;
}

template <int D>
ContactSurfaces Contact<D>::surfaces(const Assembly<D>& assembly) const {
  Real facet = 0;
  for (const std::string& body : bodies) facet = std::max(facet, facet_size(assembly.body(body)));
  const auto& X = assembly.body(bodies[0]).particles.X();
  const Vec<D> sum = std::accumulate(X.begin(), X.end(), Vec<D>(Vec<D>::Zero()));
  return {this->place,
          facet,
          assembly.of(bodies[0]).surface_energy,
          spatial<D>(sum / static_cast<Real>(X.size())),
          form_of_tension(assembly, bodies[0]),
          bodies.size() > 1 ? assembly.of(bodies[1]).surface_energy : std::nullopt};
}

template <int D>
ContactResolution Contact<D>::resolution(const Assembly<D>& assembly) const {
  return {surfaces(assembly).facet, flat(assembly).equilibrium_gap, partner.has_value()};
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

/// Which keys decide what the contact holds, for a run in which surfaces come through it.
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
      model->greatest_pressure(partner.has_value(), surfaces(assembly)),
      assembly.units().symbol(dimension::pressure), joined(lengths, ", "), joined(strengths, ", "),
      points_chosen(assembly));
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
RigidMotion<D> Contact<D>::partner_motion() const {
  return partner->displacement.empty() ? RigidMotion<D>() : RigidMotion<D>(partner->displacement);
}

/// Two surfaces that start closer than the least gap have forces that no step can follow.
template <int D>
void Contact<D>::require_gap(ForceTerm& term, const State& initial) const {
  NodalVectors force(initial.u.size(), Lanes::zero());
  if (const auto failure = term.add_force(initial.motion(), force).failure)
    throw InputError(fmt::format("{}: {}; move the bodies apart", this->place, failure->cause));
}

/// Surfaces whose points lie farther apart than the interaction reaches go through each other.
template <int D>
void Contact<D>::require_points_to_meet(const Assembly<D>& assembly) const {
  const ContactResolution r = resolution(assembly);
  const int chosen = points_chosen(assembly);
  if (!r.unfelt(chosen)) return;
  throw InputError(fmt::format(
      "{}: the contact points of '{}' and '{}' are {:.3g} apart, {} per direction and facet, where "
      "their equilibrium gap is {:.3g}: they would pass between each other unfelt; allowed are "
      "distances up to {:.3g} (finer bodies, or an interaction of longer reach)",
      this->place, bodies[0], bodies[1], r.facet / chosen, chosen, r.gap, r.longest_spacing()));
}

/// How many points there are, and what their distance costs.
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

/// Nothing but the forces keeps bodies out of each other: a body that went through the surface of
/// another all the same must not run on.
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

/// Adhesion, gap, strength and stiffness of the contact as if it were flat.
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
  // The traction along the normal of the wall does no work on the line of contact.
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

/// What a drop does on a wall.
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

/// Whether the first is a drop, and the second is not.
template <int D>
bool Contact<D>::soft_wetting(const Assembly<D>& assembly) const {
  return !partner && assembly.of(bodies[0]).surface_energy && assembly.of(bodies[0]).is_fluid() &&
         !assembly.of(bodies[1]).is_fluid();
}

/// Why the surface of soft ground may fold: a traction of the adhesion W over the range l pulls it
/// nearer by about W/E, and at a part of l it jumps into contact (wetting note 10). Empty where
/// that is not to be expected.
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

/// What a drop does on a soft body.
template <int D>
void Contact<D>::measure_soft_wetting(Assembly<D>& assembly) const {
  if (!soft_wetting(assembly)) return;
  const PlaneContact& flat = this->flat(assembly);
  // Where adhesion varies the contact has it.
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
  // Half of the energy of the contact is that of either surface.
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

const bool registered = register_load<Contact>(
    "contact", Stage::contact, "adhesive contact of two bodies, or of one with a rigid partner");

}  // namespace
}  // namespace meniscus::contact_load
