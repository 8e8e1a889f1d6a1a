// SPDX-License-Identifier: BSD-3-Clause
// Contacts of a scene: from its tables to force terms, with what they mean for two flat bodies.
#include "meniscus/core/error.hpp"
#include "meniscus/core/names.hpp"
#include "meniscus/physics/contact_numbers.hpp"

#include <fmt/format.h>

#include <set>

#include "plan.hpp"

namespace meniscus {
namespace {

template <int D>
ContactLaw law_of(const ContactSettings& s) {
  ContactLaw law;
  law.kernel = D == 3 ? PairKernel::space : pair_kernel_named(s.kernel);
  law.epsilon = s.epsilon;
  law.sigma0 = s.sigma0;
  law.cutoff = s.cutoff;
  law.guard = s.least_gap;
  return law;
}

ContactChoice choice_of(const ContactSettings& s) {
  ContactChoice choice;
  choice.name = s.name;
  for (std::size_t k = 0; k < contact_form_names.size(); ++k)
    if (contact_form_names[k] == s.form) choice.form = static_cast<ContactForm>(k);
  choice.density = s.density == "constant" ? SiteDensity::constant : SiteDensity::referential;
  choice.points = s.points;
  choice.skin = s.skin;
  return choice;
}

/// Adhesion, gap, strength and stiffness of the contact as if it were flat.
template <int D>
void report(const Plan<D>& plan, const ContactSettings& s, const ContactLaw& law,
            const ForceTerm& term, Scene<D>& scene) {
  const auto unit = [&](Dimension d) { return scene.units.symbol(d); };
  const PlaneContact flat = plane_contact(law, s.beta * s.beta_other);
  std::string note = fmt::format("contact '{}', form {}: adhesion W = {:.6g} {}", s.name, s.form,
                                 flat.adhesion, unit(dimension::tension));
  if (law.cut())
    note += fmt::format(" ({:.1f} % lost by the cut-off at {:.3g} sigma0)",
                        100 * flat.lost_adhesion(), law.cutoff);
  note += fmt::format(", equilibrium gap {:.4g} {}, peak traction {:.4g} {}, stiffness {:.4g} {}",
                      flat.equilibrium_gap, unit(dimension::length), flat.peak_traction,
                      unit(dimension::pressure), flat.stiffness, unit({-2, -2, 1}));
  for (const TensionSettings& tension : plan.tensions)
    if (std::find(s.bodies.begin(), s.bodies.end(), tension.body) != s.bodies.end())
      note += fmt::format(", contact angle of '{}': {}", tension.body,
                          contact_angle_text(flat.adhesion, tension.gamma));
  scene.notes.push_back(note);
  scene.notes.push_back(
      fmt::format("contact '{}': {:.1f} MB", s.name, 1e-6 * static_cast<Real>(term.bytes())));
  if (s.form == "dissertation")
    scene.warnings.push_back(fmt::format(
        "contact '{}': form = \"dissertation\" is not the gradient of an energy: energy drifts at "
        "any step and resolution, momenta are conserved in the limit of fine points only",
        s.name));
  if (s.form == "pressure")
    scene.warnings.push_back(fmt::format(
        "contact '{}': form = \"pressure\" conserves energy and momenta only where the points are "
        "closer than a third of the gap",
        s.name));
}

/// Two surfaces that start closer than least_gap have forces that no step can follow.
template <int D>
void require_gap(const std::string& place, ForceTerm& term, const Scene<D>& scene) {
  NodalVectors force(scene.initial.u.size(), Lanes::zero());
  if (const auto failure = term.add_force(scene.initial.motion(), force).failure)
    throw InputError(fmt::format("{}: {}; move the bodies apart", place, failure->cause));
}

}  // namespace

template <int D>
void plan_contacts(const Block& root, Plan<D>& plan) {
  std::set<std::string> names;
  for (const Block& block : root.tables("contact")) {
    PlannedContact<D> contact;
    ContactSettings& s = contact.settings = read<ContactSettings>(block);
    contact.place = block.place();
    const auto partner = block.table("partner");
    if (partner) contact.partner = read_partner<D>(*partner);
    const std::size_t wanted = partner ? 1 : 2;
    if (block.has("bodies") && s.bodies.size() != wanted)
      block.problem("bodies", fmt::format("names {} bodies; allowed are two, or one with a "
                                          "[contact.partner]",
                                          s.bodies.size()));
    for (const std::string& name : s.bodies) plan.require(block, name, "bodies");
    if (s.bodies.size() == 2 && s.bodies[0] == s.bodies[1])
      block.problem("bodies", fmt::format("'{}' cannot be in contact with itself", s.bodies[0]));
    if (s.form == "volume") {
      if (block.has("density") && s.density == "constant")
        block.problem("density",
                      "form = \"volume\" has beta per reference volume; allowed is "
                      "referential");
      if (partner)
        block.problem("form",
                      "volume is for two bodies; allowed with a rigid partner are energy, "
                      "pressure, dissertation");
    }
    if (s.name.empty() && !s.bodies.empty())
      s.name = s.bodies[0] + "-" + (s.bodies.size() > 1 ? s.bodies[1] : "partner");
    if (!names.insert(s.name).second)
      block.problem("name", fmt::format("there is a contact '{}' already; give it a name", s.name));
    block.done();
    plan.contacts.push_back(std::move(contact));
  }
}

template <int D>
void build_contacts(const Plan<D>& plan, Scene<D>& scene) {
  for (const PlannedContact<D>& contact : plan.contacts) {
    const ContactSettings& s = contact.settings;
    ContactLaw law = law_of<D>(s);
    const ContactBody<D> first{body_named(scene.system, s.bodies[0]), s.beta};
    std::unique_ptr<ForceTerm> term;
    if (contact.partner) {
      law.cutoff = std::numeric_limits<Real>::infinity();
      MovingPartner<D> partner;
      partner.shape = contact.partner->make(law, s.beta_other);
      partner.beta = s.beta_other;
      if (!contact.partner->displacement.empty())
        partner.motion = RigidMotion<D>(contact.partner->displacement);
      partner.velocity_step = 1e-4 * scene.time.end;
      term = rigid_contact(first, std::move(partner), law, choice_of(s));
    } else {
      const ContactBody<D> second{body_named(scene.system, s.bodies[1]), s.beta_other};
      term = contact_pair(first, second, law, choice_of(s));
    }
    require_gap(contact.place, *term, scene);
    report(plan, s, law, *term, scene);
    for (MeasureSource& m : term->measures()) {
      m.name = s.name + "." + m.name;
      scene.measures.push_back(std::move(m));
    }
    scene.steps_may_be_rejected = true;
    scene.system.terms.push_back(std::move(term));
  }
}

template void plan_contacts(const Block&, Plan<2>&);
template void plan_contacts(const Block&, Plan<3>&);
template void build_contacts(const Plan<2>&, Scene<2>&);
template void build_contacts(const Plan<3>&, Scene<3>&);

}  // namespace meniscus
