// SPDX-License-Identifier: BSD-3-Clause
// Adhesive contact of two bodies, or of a body with a rigid partner.
#include "meniscus/core/error.hpp"
#include "meniscus/core/optional_rows.hpp"
#include "meniscus/physics/contact_numbers.hpp"
#include "meniscus/physics/interaction_registry.hpp"
#include "meniscus/scene/assembly.hpp"

#include <fmt/core.h>

namespace meniscus {
namespace {

struct Keys {
  std::string name, form, density, interaction;
  std::vector<std::string> bodies;
  Real skin = 0;
  int points = 0;
  static Rows<Keys> rows();
};

Rows<Keys> Keys::rows() {
  return {
      text_row("name", &Keys::name, "by which messages and measures call it; empty: the bodies",
               ""),
      texts_row("bodies", &Keys::bodies,
                "names of two bodies, or of one that has a [contact.partner]"),
      choice_row("interaction", &Keys::interaction, interactions<3>().names(),
                 "by which they act on each other; its own keys follow in the same table",
                 "lennard_jones"),
      choice_row("form", &Keys::form, {contact_form_names.begin(), contact_form_names.end()},
                 "gradient of the surface energy (conserves energy and momenta exactly); "
                 "disjoining pressure; forces between volume points; traction of the dissertation "
                 "(not the gradient of any energy)",
                 "energy"),
      choice_row("density", &Keys::density, {"constant", "referential"},
                 "surface forms: beta per current volume, or per reference volume (beta/J); the "
                 "form volume is referential",
                 "constant"),
      integer_row("points", &Keys::points, {1, 20},
                  "Gauss points per direction and facet of the surface (form volume: cell)", 2),
      real_row("skin", &Keys::skin, dimension::none, {0.01, 10},
               "reach of the list beyond the cut-off / sigma0", 0.4),
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
         interaction.keys()});
  // In the plane there are all partners of space, and more.
  tables.push_back({"[contact.partner] of any type", key_texts(Partner<2>::rows())});
  for (const auto& [name, partner] : partners<2>()) {
    const auto* in_space = partners<3>().find(name);
    tables.push_back({fmt::format("[contact.partner] type = \"{}\"{}: {}", name,
                                  in_space ? "" : " (2D)", partner.meaning),
                      in_space ? in_space->keys() : partner.keys()});
  }
  return tables;
}

template <int D>
struct Contact final : Load<D>, Keys {
  std::unique_ptr<const ContactModel<D>> model;
  std::optional<Partner<D>> partner;  // none: between two bodies

  void read_inner(const Block& block) {
    model = interactions<D>().at(interaction).read(block);
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
  ContactChoice choice() const;
  std::unique_ptr<ForceTerm> term(const Assembly<D>& assembly) const;
  void require_gap(ForceTerm& term, const State& initial) const;
  void report(const ForceTerm& term, Assembly<D>& assembly) const;
};

template <int D>
void Contact<D>::check(const Block& block, const BodyPlans<D>& planned) const {
  const std::size_t wanted = partner ? 1 : 2;
  if (block.has("bodies") && bodies.size() != wanted)
    block.problem("bodies", fmt::format("names {} bodies; allowed are two, or one with a "
                                        "[contact.partner]",
                                        bodies.size()));
  for (const std::string& body : bodies) require_body(block, planned, body, "bodies");
  if (bodies.size() == 2 && bodies[0] == bodies[1])
    block.problem("bodies", fmt::format("'{}' cannot be in contact with itself", bodies[0]));
  model->check(block, partner.has_value());
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
  std::unique_ptr<ForceTerm> term = this->term(assembly);
  require_gap(*term, assembly.initial());
  report(*term, assembly);
  assembly.add(std::move(term), name);
}

template <int D>
ContactChoice Contact<D>::choice() const {
  ContactChoice choice;
  choice.name = name;
  for (std::size_t k = 0; k < contact_form_names.size(); ++k)
    if (contact_form_names[k] == form) choice.form = static_cast<ContactForm>(k);
  choice.density = density == "constant" ? SiteDensity::constant : SiteDensity::referential;
  choice.points = points;
  choice.skin = skin;
  return choice;
}

template <int D>
std::unique_ptr<ForceTerm> Contact<D>::term(const Assembly<D>& assembly) const {
  const Body<D>& first = assembly.body(bodies[0]);
  if (!partner) return model->between(first, assembly.body(bodies[1]), choice());
  RigidMotion<D> motion;
  if (!partner->displacement.empty()) motion = RigidMotion<D>(partner->displacement);
  return model->with_partner(first, {partner->shape, motion, 1e-4 * assembly.end_time()}, choice());
}

/// Two surfaces that start closer than the least gap have forces that no step can follow.
template <int D>
void Contact<D>::require_gap(ForceTerm& term, const State& initial) const {
  NodalVectors force(initial.u.size(), Lanes::zero());
  if (const auto failure = term.add_force(initial.motion(), force).failure)
    throw InputError(fmt::format("{}: {}; move the bodies apart", this->place, failure->cause));
}

/// Adhesion, gap, strength and stiffness of the contact as if it were flat.
template <int D>
void Contact<D>::report(const ForceTerm& term, Assembly<D>& assembly) const {
  const auto unit = [&](Dimension d) { return assembly.units().symbol(d); };
  const PlaneContact flat = model->flat(partner.has_value());
  std::string note = fmt::format("contact '{}', {}, form {}: adhesion W = {:.6g} {}", name,
                                 interaction, form, flat.adhesion, unit(dimension::tension));
  if (flat.lost_adhesion() > 0)
    note += fmt::format(" ({:.1f} % lost by the cut-off)", 100 * flat.lost_adhesion());
  note += fmt::format(", equilibrium gap {:.4g} {}, peak traction {:.4g} {}, stiffness {:.4g} {}",
                      flat.equilibrium_gap, unit(dimension::length), flat.peak_traction,
                      unit(dimension::pressure), flat.stiffness, unit({-2, -2, 1}));
  for (const std::string& body : bodies)
    if (const auto gamma = assembly.surface_energy(body))
      note += fmt::format(", contact angle of '{}': {}", body,
                          contact_angle_text(flat.adhesion, *gamma));
  assembly.note(note);
  assembly.note(
      fmt::format("contact '{}': {:.1f} MB", name, 1e-6 * static_cast<Real>(term.bytes())));
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

const bool registered = register_load<Contact>(
    "contact", Stage::contact, "adhesive contact of two bodies, or of one with a rigid partner");

}  // namespace
}  // namespace meniscus
