// SPDX-License-Identifier: BSD-3-Clause
// Adhesive contact of two bodies, or of a body with a rigid partner.
#include "meniscus/physics/contact.hpp"

#include "meniscus/core/error.hpp"
#include "meniscus/core/optional_rows.hpp"
#include "meniscus/physics/contact_numbers.hpp"
#include "meniscus/physics/partner_registry.hpp"
#include "meniscus/scene/assembly.hpp"

#include <fmt/format.h>

namespace meniscus {
namespace {

constexpr Dimension per_volume{-3, 0, 0}, per_area{-2, 0, 0};

struct Keys {
  std::string name, kernel, form, density;
  std::vector<std::string> bodies;
  Real epsilon = 0, sigma0 = 0, cutoff = 0, least_gap = 0, skin = 0;
  Real beta = 0, beta_other = 0;  // of the first body, and of the other side
  int points = 0;
  static Rows<Keys> rows();
};

/// Interaction energy and densities per area have other units in the planar kernel.
Row<Keys> epsilon_row() {
  Row<Keys> row = real_row("epsilon", &Keys::epsilon, dimension::energy, range::positive,
                           "depth of the potential phi; kernel = \"planar\": per depth, N");
  row.read = [](Keys& k, const Block& block) {
    const bool planar = k.kernel == "planar";
    k.epsilon = block.real("epsilon", planar ? dimension::force : dimension::energy,
                           range::positive, std::nullopt);
  };
  return row;
}

Row<Keys> beta_row() {
  Row<Keys> row = real_row("beta", &Keys::beta, per_volume, range::positive,
                           "particles of the interaction per volume of the first body, and of the "
                           "other side unless beta_other is given; kernel = \"planar\": per area");
  row.read = [](Keys& k, const Block& block) {
    k.beta = block.real("beta", k.kernel == "planar" ? per_area : per_volume, range::positive,
                        std::nullopt);
  };
  return row;
}

Row<Keys> beta_other_row() {
  Row<Keys> row = real_row("beta_other", &Keys::beta_other, per_volume, range::positive,
                           "of the other body or the rigid partner", 1.0);
  row.fallback = "beta";
  row.read = [](Keys& k, const Block& block) {
    k.beta_other = k.beta;
    if (block.has("beta_other"))
      k.beta_other = block.real("beta_other", k.kernel == "planar" ? per_area : per_volume,
                                range::positive, std::nullopt);
  };
  return row;
}

Rows<Keys> Keys::rows() {
  return {
      text_row("name", &Keys::name, "by which messages and measures call it; empty: the bodies",
               ""),
      texts_row("bodies", &Keys::bodies,
                "names of two bodies, or of one that has a [contact.partner]"),
      choice_row("kernel", &Keys::kernel, {"integrated", "planar"},
                 "plane strain: phi integrated along the third axis, or phi in the plane; without "
                 "meaning in 3D",
                 "integrated"),
      epsilon_row(),
      real_row("sigma0", &Keys::sigma0, dimension::length, range::positive,
               "distance of the minimum of phi"),
      beta_row(),
      beta_other_row(),
      real_row("cutoff", &Keys::cutoff, dimension::none, {least_cutoff, 100},
               "cut-off / sigma0 between two bodies, switched smoothly from 3/4 of it; rigid "
               "partners have none",
               4.0),
      real_row("least_gap", &Keys::least_gap, dimension::none, {0.1, 0.6},
               "gap / sigma0 below which a step is rejected and a start refused; the stiffness "
               "grows by its power -10",
               meniscus::least_gap),
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

/// [contact.partner], but for the keys of its type.
template <int D>
struct Partner {
  PartnerMaker<D> make;
  std::vector<Expression> displacement;  // of the time; empty: at rest

  static Rows<Partner> rows() {
    Row<Partner> type =
        choice_row<Partner>("type", nullptr, partners<D>().names(), "kind of the rigid partner");
    type.read = [](Partner& p, const Block& block) {
      const auto* entry =
          partners<D>().find(block.choice("type", partners<D>().names(), std::nullopt));
      if (entry) p.make = entry->read(block);
    };
    return {type,
            optional_expressions_row("displacement", &Partner::displacement, D, dimension::length,
                                     "prescribed motion, a formula of t for each component")};
  }
};

std::vector<KeyTable> partner_tables() {
  // In the plane there are all partners of space, and more.
  std::vector<KeyTable> tables{{"[contact.partner] of any type", key_texts(Partner<2>::rows())}};
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
  std::optional<Partner<D>> partner;  // none: between two bodies

  void read_inner(const Block& block) {
    if (const auto table = block.table("partner")) {
      partner = read<Partner<D>>(*table);
      table->done();
    }
    if (name.empty() && !bodies.empty())
      name = bodies[0] + "-" + (bodies.size() > 1 ? bodies[1] : "partner");
  }
  static std::vector<KeyTable> inner_tables() { return partner_tables(); }

  std::optional<typename Load<D>::Identity> identity() const override { return {{"name", name}}; }
  void check(const Block& block, const BodyPlans<D>& planned) const override;
  void build(Assembly<D>& assembly) const override;

 private:
  ContactLaw law() const;
  ContactChoice choice() const;
  std::unique_ptr<ForceTerm> term(const ContactLaw& law, const Assembly<D>& assembly) const;
  void require_gap(ForceTerm& term, const State& initial) const;
  void report(const ContactLaw& law, const ForceTerm& term, Assembly<D>& assembly) const;
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
  const ContactLaw law = this->law();
  std::unique_ptr<ForceTerm> term = this->term(law, assembly);
  require_gap(*term, assembly.initial());
  report(law, *term, assembly);
  assembly.add(std::move(term), name);
}

template <int D>
ContactLaw Contact<D>::law() const {
  ContactLaw law;
  law.kernel = D == 3 ? PairKernel::space : pair_kernel_named(kernel);
  law.epsilon = epsilon;
  law.sigma0 = sigma0;
  law.cutoff = partner ? std::numeric_limits<Real>::infinity() : cutoff;
  law.guard = least_gap;
  return law;
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
std::unique_ptr<ForceTerm> Contact<D>::term(const ContactLaw& law,
                                            const Assembly<D>& assembly) const {
  const ContactBody<D> first{assembly.body(bodies[0]), beta};
  if (!partner)
    return contact_pair(first, ContactBody<D>{assembly.body(bodies[1]), beta_other}, law, choice());
  MovingPartner<D> moving;
  moving.shape = partner->make(law, beta_other);
  moving.beta = beta_other;
  if (!partner->displacement.empty()) moving.motion = RigidMotion<D>(partner->displacement);
  moving.velocity_step = 1e-4 * assembly.end_time();
  return rigid_contact(first, std::move(moving), law, choice());
}

/// Two surfaces that start closer than least_gap have forces that no step can follow.
template <int D>
void Contact<D>::require_gap(ForceTerm& term, const State& initial) const {
  NodalVectors force(initial.u.size(), Lanes::zero());
  term.add_force(initial.motion(), force);
  if (const auto failure = term.failure())
    throw InputError(fmt::format("{}: {}; move the bodies apart", this->place, failure->cause));
}

/// Adhesion, gap, strength and stiffness of the contact as if it were flat.
template <int D>
void Contact<D>::report(const ContactLaw& law, const ForceTerm& term, Assembly<D>& assembly) const {
  const auto unit = [&](Dimension d) { return assembly.units().symbol(d); };
  const PlaneContact flat = plane_contact(law, beta * beta_other);
  std::string note = fmt::format("contact '{}', form {}: adhesion W = {:.6g} {}", name, form,
                                 flat.adhesion, unit(dimension::tension));
  if (law.cut())
    note += fmt::format(" ({:.1f} % lost by the cut-off at {:.3g} sigma0)",
                        100 * flat.lost_adhesion(), law.cutoff);
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
