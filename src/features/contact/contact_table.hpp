// SPDX-License-Identifier: BSD-3-Clause
// The table [[contact]]: its keys, and the term and measures that it adds.
#pragma once
#include "features/contact/contact_advice.hpp"
#include "input/optional_rows.hpp"
#include "input/ramp.hpp"
#include "measure/wetting_measures.hpp"
#include "meniscus/physics/interaction_registry.hpp"
#include "meniscus/scene/assembly.hpp"
#include "physics/contact/adhesion.hpp"
#include "physics/contact/contact_numbers.hpp"
#include "physics/contact/points/contact_resolution.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace meniscus::contact_table {

struct Keys {
  std::string name, form, density, interaction;
  std::vector<std::string> bodies;
  std::vector<Real> up;
  Real skin = 0, friction = 0;
  int points = 0;
  static Rows<Keys> rows();
};

/// Names of the forms of the forces of a contact.
std::vector<std::string> forms();

/// The table [contact.partner].
template <int D>
struct Partner {
  std::shared_ptr<const PartnerShape<D>> shape;
  std::vector<Expression> displacement;  // formulas of the time; empty: at rest
  // These keys are for a partner that is pressed.
  std::vector<Real> direction;
  std::optional<Expression> force, base;
  Real stiffness = 0;
  Ramp ramp;

  bool pressed() const { return !direction.empty(); }
  void check(const Block& block) const;
  static Rows<Partner> rows() {
    Row<Partner> type = choice_row<Partner>("type", nullptr, partners<D>().names(),
                                            "kind of the rigid partner; its own keys follow");
    type.read = [](Partner& p, const Block& block) {
      const auto kind = block.kind("type", partners<D>().names());
      if (kind) p.shape = partners<D>().at(*kind).read(block);
    };
    return {
        type,
        optional_expressions_row("displacement", &Partner::displacement, D, dimension::length,
                                 Variables::time,
                                 "prescribed motion, a formula of t for each component"),
        reals_row("direction", &Partner::direction, 0, dimension::none, range::any,
                  "along which a partner without mass moves by itself, to where its force on "
                  "the body is that of the next keys",
                  std::vector<Real>{}),
        optional_expression_row("force", &Partner::force, of_sum(dimension::force, D), range::any,
                                "0", "that pushes it along the direction, a formula of t"),
        real_row("stiffness", &Partner::stiffness,
                 D == 3 ? dimension::tension : dimension::pressure, range::non_negative,
                 "of a spring between it and its base", 0.0),
        optional_expression_row("base", &Partner::base, dimension::length, range::any, "0",
                                "displacement of the base along the direction, a formula of t"),
        ramp_row("ramp", &Partner::ramp, "force from 0")};
  }
};

/// Tables of keys of the interactions and of the partners.
std::vector<KeyTable> tables_of_parts();

template <int D>
struct Contact final : Load<D>, Keys {
  static constexpr std::string_view example =
      "bodies = [\"drop\", \"other\"]\nepsilon = 1\nsigma0 = 0.3\nbeta = 1\n";
  std::unique_ptr<const ContactModel<D>> model;
  std::optional<Partner<D>> partner;  // empty for a contact of two bodies

  void read_inner(const Block& block) {
    model = interactions<D>().at(interaction).read(block);
    form = block.choice("form", forms(), model->usual_form());
    if (const auto table = block.table("partner")) {
      partner = read<Partner<D>>(*table);
      partner->check(*table);
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
  /// The interaction of flat surfaces and its properties. Computed once, because build() uses them
  /// many times. Throws InputError if they are not finite.
  const Interaction& law(const Assembly<D>& assembly) const {
    if (!law_) {
      law_ = model->law(surfaces(assembly));
      flat_ = law_->flat();
      require_finite(flat_, this->place);
    }
    return *law_;
  }
  const PlaneContact& flat(const Assembly<D>& assembly) const {
    law(assembly);
    return flat_;
  }
  /// The pressure of flat surfaces at the smallest gap: a larger pressure overcomes the contact.
  Real greatest_pressure(const Assembly<D>& assembly) const {
    return law(assembly).at(law(assembly).least_gap()).pressure;
  }
  Real greatest_adhesion(const Assembly<D>& assembly) const;
  /// Distances from the surface of the other side.
  Real rest_gap(const Assembly<D>& assembly) const {
    return flat(assembly).equilibrium_gap - law(assembly).recess();
  }
  Real peak_gap(const Assembly<D>& assembly) const {
    return flat(assembly).peak_gap - law(assembly).recess();
  }
  LineAt line(const Assembly<D>& assembly) const;
  ContactResolution resolution(const Assembly<D>& assembly) const;
  int points_chosen(const Assembly<D>& assembly) const;
  std::unique_ptr<ForceTerm> term(const Assembly<D>& assembly) const;
  /// The motion of the partner in the last build. All who use it share the way of a pressed
  /// partner.
  const RigidMotion<D>& partner_motion() const { return *partner_motion_; }
  RigidMotion<D> new_partner_motion() const;
  void require_gap(ForceTerm& term, const State& initial) const;
  void require_points_to_meet(const Assembly<D>& assembly) const;
  void report_points(Assembly<D>& assembly) const;
  StateCheck containment(const Assembly<D>& assembly) const;
  void report(const ForceTerm& term, Assembly<D>& assembly) const;
  MeasureSource angle_under_weight(const MeasureSource& near, const LineAt& line,
                                   const Assembly<D>& assembly) const;
  void report_line(const LineAt& line, Assembly<D>& assembly) const;
  void measure_wetting(Assembly<D>& assembly) const;
  void measure_angles(const LineAt& line, Assembly<D>& assembly) const;
  void measure_soft_wetting(Assembly<D>& assembly) const;
  bool soft_wetting(const Assembly<D>& assembly) const;
  std::string folding(const Assembly<D>& assembly) const;
  std::string overlap(const Assembly<D>& assembly) const;
  void check_revolved(const Block& block) const;
  BeginningContact<D> beginning(const ForceTerm& term, const Assembly<D>& assembly) const;

  // Results of the last build.
  mutable std::shared_ptr<const Interaction> law_;
  mutable PlaneContact flat_;
  mutable std::optional<RigidMotion<D>> partner_motion_;
};

}  // namespace meniscus::contact_table
