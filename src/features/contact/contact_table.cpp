// SPDX-License-Identifier: BSD-3-Clause
// The keys of [[contact]], their checks, and the bodies, terms and measures that it adds.
#include "features/contact/contact_table.hpp"

#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <cmath>

namespace meniscus::contact_table {
namespace {

/// The interaction if the key is absent.
std::string usual_interaction(const Block& block) {
  if (!block.has("contact_angle") && !block.has("adhesion")) return "lennard_jones";
  return block.has("sigma0") ? "scaled_lennard_jones" : "smooth_young";
}
}  // namespace

std::vector<std::string> forms() {
  return {contact_form_names.begin(), contact_form_names.end()};
}

Rows<Keys> Keys::rows() {
  Row<Keys> interaction =
      choice_row("interaction", &Keys::interaction, interactions<3>().names(),
                 "law of attraction and repulsion, whose own keys are in the same table. If it is "
                 "not given, a table with an adhesion or a contact_angle has smooth_young, one "
                 "with sigma0 besides scaled_lennard_jones, any other lennard_jones",
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
  form.read = [](Keys&, const Block&) {};  // read with the interaction, for its default
  return {
      text_row("name", &Keys::name,
               "name of the contact in messages and measures; empty: names of the bodies", ""),
      texts_row("bodies", &Keys::bodies,
                "names of two bodies, or of one that has a [contact.partner]"),
      interaction,
      form,
      choice_row("density", &Keys::density, {"constant", "referential"},
                 "surface forms: beta per current volume, or per reference volume (beta/J); the "
                 "form volume is referential",
                 "constant"),
      integer_row("points", &Keys::points, {0, 20},
                  "number of Gauss points per direction and facet of the surface (form volume: "
                  "cell). 0: chosen, 2 to 8 (rigid partners: to 4, form volume: 2), so that "
                  "spurious friction stays below 1e-3 of the normal force",
                  0),
      real_row("skin", &Keys::skin, dimension::none, {0.01, 10},
               "distance beyond the cut-off up to which pairs of points are listed / sigma0 "
               "(smooth_young: / quarter of its range). It changes the speed only",
               0.4),
      reals_row("up", &Keys::up, 0, dimension::none, range::any,
                "for a drop, the first body, on soft ground, the second body, with smooth_young: "
                "direction from the ground to the drop. Gaps are measured along it, and only the "
                "drop stores adhesion energy, as on a rigid partner. Without it each body stores "
                "half of the energy",
                std::vector<Real>{}),
      real_row("friction", &Keys::friction, {-2, -1, 1}, range::non_negative,
               "with a rigid partner: traction along it per relative speed where the surfaces "
               "touch, fading with the energy of the interaction",
               0.0),
  };
}

/// Key tables of all interactions and partners, for the key reference.
std::vector<KeyTable> tables_of_parts() {
  std::vector<KeyTable> tables;
  for (const auto& [name, interaction] : interactions<3>())
    tables.push_back(
        {fmt::format("[[contact]] interaction = \"{}\": {}", name, interaction.meaning),
         interaction.keys(),
         fmt::format("[[contact]]\nbodies = [\"drop\", \"other\"]\ninteraction = \"{}\"\n{}", name,
                     interaction.example)});
  tables.push_back({"[contact.partner] of any type", key_texts(Partner<3>::rows())});
  // 2D has all partners of 3D, and more.
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
void Partner<D>::check(const Block& block) const {
  if (!pressed()) {
    for (const char* key : {"force", "stiffness", "base", "ramp"})
      if (block.has(key))
        block.problem(key, "is of a partner that moves along a direction; add direction");
    return;
  }
  if (direction.size() != D)
    block.problem("direction",
                  fmt::format("has {} numbers; expected is a vector of {}", direction.size(), D));
  else if (!(Vec<D>::Map(direction.data()).norm() > 0))
    block.problem("direction", "has no direction; allowed is any vector of a finite length > 0");
  if (!displacement.empty())
    block.problem("displacement", "goes without direction; base moves the spring of the partner");
  if (!force && stiffness == 0)
    block.problem("direction", "nothing presses the partner; give force, or stiffness and base");
  if (base && stiffness == 0) block.problem("base", "has no spring; give stiffness, too");
  for (const auto& [key, formula] : {std::pair("force", &force), std::pair("base", &base)})
    if (*formula && (*formula)->depends_on_place())
      block.problem(key, "depends on the place; allowed is a formula of t");
}

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
  if (partner && partner->pressed() && friction > 0)
    block.problem("friction", "goes without a direction of the partner");
  if (!up.empty() && partner)
    block.problem("up", "is for two bodies; a [contact.partner] has a direction of its own");
  if (!up.empty() && up.size() != D)
    block.problem("up", fmt::format("has {} numbers; expected is a vector of {}", up.size(), D));
  else if (!up.empty() && !(Vec<D>::Map(up.data()).norm() > 0))
    block.problem("up", "has no direction; allowed is any vector of a finite length > 0");
  if (!planned.empty() && planned.front().geometry.grid.revolved) check_revolved(block);
  if (form != "volume") return;
  if (block.has("density") && density == "constant")
    block.problem("density",
                  "form = \"volume\" has beta per reference volume; allowed is referential");
  if (partner)
    block.problem("form",
                  "volume is for two bodies; allowed with a rigid partner are energy, pressure, "
                  "dissertation");
}

/// Reports what is not of revolution about the axis x = 0.
template <int D>
void Contact<D>::check_revolved(const Block& block) const {
  if (!partner && form != "energy")
    block.problem("form",
                  fmt::format("is \"{}\" between bodies of revolution; allowed is energy", form));
  if (up.size() == D && up.front() != 0)
    block.problem("up", "is not along the axis of revolution; allowed is 0 for x");
  if (!partner || !partner->shape) return;
  for (const Vec<D>& x :
       {Vec<D>(Vec<D>::Unit(0)), Vec<D>(Vec<D>::Unit(1)), Vec<D>(Vec<D>::Ones())}) {
    Vec<D> image = x;
    image[0] = -x[0];
    const auto foot = partner->shape->foot(x), other = partner->shape->foot(image);
    constexpr Real round_off = 1e-9;
    if (std::abs(foot.distance - other.distance) <= round_off * (1 + std::abs(foot.distance)))
      continue;
    return block.problem("partner",
                         "is not of revolution about the axis x = 0; allowed are a plane normal to "
                         "y, and a centre at x = 0");
  }
  const auto across = [](const Expression& d) { return !(d.constant() && d({0, 0, 0}) == 0); };
  if (!partner->displacement.empty() && across(partner->displacement.front()))
    block.problem("partner",
                  "is displaced across the axis of revolution; allowed is 0 for x in displacement");
  if (partner->pressed() && partner->direction.front() != 0)
    block.problem("partner",
                  "is pressed across the axis of revolution; allowed is 0 for x in direction");
}

template <int D>
void Contact<D>::build(Assembly<D>& assembly) const {
  law_.reset();
  partner_motion_ = new_partner_motion();
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
  if (const auto* W = law(assembly).pattern(); !partner && W && W->depends_on_place())
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

const bool registered = register_load<Contact>(
    "contact", Stage::contact, "adhesive contact of two bodies, or of one with a rigid partner");

}  // namespace meniscus::contact_table
