// SPDX-License-Identifier: BSD-3-Clause
// Rows of [[contact]] and of the kinds of rigid partners.
#include "meniscus/scene/contact_settings.hpp"

#include "meniscus/core/error.hpp"

#include <fmt/format.h>

namespace meniscus {
namespace {

constexpr Dimension per_volume{-3, 0, 0}, per_area{-2, 0, 0};

/// Interaction energy and densities per area have other units in the planar kernel.
Row<ContactSettings> epsilon_row() {
  using S = ContactSettings;
  Row<S> row = real_row("epsilon", &S::epsilon, dimension::energy, range::positive,
                        "depth of the potential phi; kernel = \"planar\": per depth, N");
  row.read = [](S& s, const Block& block) {
    const bool planar = s.kernel == "planar";
    s.epsilon = block.real("epsilon", planar ? dimension::force : dimension::energy,
                           range::positive, std::nullopt);
  };
  return row;
}

Row<ContactSettings> beta_row() {
  using S = ContactSettings;
  Row<S> row = real_row("beta", &S::beta, per_volume, range::positive,
                        "particles of the interaction per volume of the first body, and of the "
                        "other side unless beta_other is given; kernel = \"planar\": per area");
  row.read = [](S& s, const Block& block) {
    s.beta = block.real("beta", s.kernel == "planar" ? per_area : per_volume, range::positive,
                        std::nullopt);
  };
  return row;
}

Row<ContactSettings> beta_other_row() {
  using S = ContactSettings;
  Row<S> row = real_row("beta_other", &S::beta_other, per_volume, range::positive,
                        "of the other body or the rigid partner", 1.0);
  row.fallback = "beta";
  row.read = [](S& s, const Block& block) {
    s.beta_other = s.beta;
    if (block.has("beta_other"))
      s.beta_other = block.real("beta_other", s.kernel == "planar" ? per_area : per_volume,
                                range::positive, std::nullopt);
  };
  return row;
}

struct HalfSpace {
  std::vector<Real> point, normal;
  static Rows<HalfSpace> rows() {
    return {reals_row("point", &HalfSpace::point, 0, dimension::length, range::any,
                      "a point of the plane"),
            reals_row("normal", &HalfSpace::normal, 0, dimension::none, range::any,
                      "out of the solid, of any length")};
  }
  template <int D>
  std::unique_ptr<RigidPartner<D>> make(const ContactLaw& law, Real beta) const {
    return rigid_half_space<D>(law, beta, Vec<D>::Map(point.data()), Vec<D>::Map(normal.data()));
  }
};

struct Round {
  std::vector<Real> centre;
  Real radius = 0;
  static Rows<Round> rows() {
    return {reals_row("centre", &Round::centre, 0, dimension::length, range::any, "centre"),
            real_row("radius", &Round::radius, dimension::length, range::positive, "radius")};
  }
};

struct RigidBall : Round {
  template <int D>
  std::unique_ptr<RigidPartner<D>> make(const ContactLaw& law, Real beta) const {
    return rigid_ball<D>(law, beta, Vec<D>::Map(centre.data()), radius);
  }
};

struct Cavity : Round {
  template <int D>
  std::unique_ptr<RigidPartner<D>> make(const ContactLaw& law, Real beta) const {
    return rigid_cavity<D>(law, beta, Vec<D>::Map(centre.data()), radius);
  }
};

struct Frame {
  std::vector<Real> low, high;
  Real thickness = 0;
  static Rows<Frame> rows() {
    return {reals_row("low", &Frame::low, 0, dimension::length, range::any,
                      "lower left corner of the room inside"),
            reals_row("high", &Frame::high, 0, dimension::length, range::any,
                      "upper right corner of the room inside"),
            real_row("thickness", &Frame::thickness, dimension::length, range::non_negative,
                     "of the walls; 0: infinite", 0.0)};
  }
  template <int D>
  std::unique_ptr<RigidPartner<D>> make(const ContactLaw& law, Real beta) const {
    return rigid_frame(law, beta, Vec<2>::Map(low.data()), Vec<2>::Map(high.data()),
                       thickness > 0 ? thickness : std::numeric_limits<Real>::infinity());
  }
};

/// Vectors of a partner have a component per dimension.
void require_components(const Block& block, int D) {
  for (const char* key : {"point", "normal", "centre", "low", "high", "displacement"})
    if (block.has(key)) {
      const auto count =
          std::string_view(key) == "displacement"
              ? block.expressions(key, 0, dimension::length, std::nullopt, Variables::time).size()
              : block
                    .reals(key, 0,
                           std::string_view(key) == "normal" ? dimension::none : dimension::length,
                           range::any, std::nullopt)
                    .size();
      if (count != static_cast<std::size_t>(D))
        block.problem(
            key, fmt::format("has {} components; allowed are {}, one per dimension", count, D));
    }
}

template <int D, class Kind>
auto reader() {
  return [](const Block& block) {
    Kind kind{};
    for (const auto& row : Kind::rows()) row.read(kind, block);
    return typename std::function<std::unique_ptr<RigidPartner<D>>(const ContactLaw&, Real)>(
        [kind](const ContactLaw& law, Real beta) { return kind.template make<D>(law, beta); });
  };
}

template <int D>
const auto& partner_kinds() {
  using Make = std::function<std::unique_ptr<RigidPartner<D>>(const ContactLaw&, Real)>;
  static const auto kinds = [] {
    std::map<std::string, std::function<Make(const Block&)>> all{
        {"half_space", reader<D, HalfSpace>()},
        {"ball", reader<D, RigidBall>()},
        {"cavity", reader<D, Cavity>()}};
    if constexpr (D == 2) all.emplace("frame", reader<D, Frame>());
    return all;
  }();
  return kinds;
}

}  // namespace

Rows<ContactSettings> ContactSettings::rows() {
  using S = ContactSettings;
  return {
      text_row("name", &S::name, "by which messages and measures call it; empty: the bodies", ""),
      texts_row("bodies", &S::bodies,
                "names of two bodies, or of one that has a [contact.partner]"),
      choice_row("kernel", &S::kernel, {"integrated", "planar"},
                 "plane strain: phi integrated along the third axis, or phi in the plane; without "
                 "meaning in 3D",
                 "integrated"),
      epsilon_row(),
      real_row("sigma0", &S::sigma0, dimension::length, range::positive,
               "distance of the minimum of phi"),
      beta_row(),
      beta_other_row(),
      real_row("cutoff", &S::cutoff, dimension::none, {least_cutoff, 100},
               "cut-off / sigma0 between two bodies, switched smoothly from 3/4 of it; rigid "
               "partners have none",
               4.0),
      real_row("least_gap", &S::least_gap, dimension::none, {0.1, 0.6},
               "gap / sigma0 below which a step is rejected and a start refused; the stiffness "
               "grows by its power -10",
               meniscus::least_gap),
      choice_row("form", &S::form, {contact_form_names.begin(), contact_form_names.end()},
                 "gradient of the surface energy (conserves energy and momenta exactly); "
                 "disjoining pressure; forces between volume points; traction of the dissertation "
                 "(not the gradient of any energy)",
                 "energy"),
      choice_row("density", &S::density, {"constant", "referential"},
                 "surface forms: beta per current volume, or per reference volume (beta/J); the "
                 "form volume is referential",
                 "constant"),
      integer_row("points", &S::points, {1, 20},
                  "Gauss points per direction and facet of the surface (form volume: cell)", 2),
      real_row("skin", &S::skin, dimension::none, {0.01, 10},
               "reach of the list beyond the cut-off / sigma0", 0.4),
  };
}

template <int D>
PartnerPlan<D> read_partner(const Block& block) {
  std::vector<std::string> names;
  for (const auto& entry : partner_kinds<D>()) names.push_back(entry.first);
  PartnerPlan<D> plan;
  const auto type = block.kind("type", names);
  if (!type) return plan;
  const auto kind = partner_kinds<D>().find(*type);
  require_components(block, D);
  plan.make = kind->second(block);
  if (block.has("displacement"))
    plan.displacement =
        block.expressions("displacement", 0, dimension::length, std::nullopt, Variables::time);
  block.done();
  return plan;
}

void describe_contact_keys(std::ostream& out) {
  describe<ContactSettings>(out, "[[contact]]");
  rows::print_table(out, "[contact.partner] of any type",
                    {{{"type", "text", "", "half_space | ball | cavity | frame (2D)", "required",
                       "kind of the rigid partner; ball and cavity are cylindrical in 2D"}},
                     {{"displacement", "numbers or formulas", "m", "", "0",
                       "prescribed motion, a formula of t for each component"}}});
  describe<HalfSpace>(out, "[contact.partner] type = \"half_space\"");
  describe<Round>(out, "[contact.partner] type = \"ball\" or \"cavity\"");
  describe<Frame>(out, "[contact.partner] type = \"frame\" (2D)");
}

template PartnerPlan<2> read_partner(const Block&);
template PartnerPlan<3> read_partner(const Block&);

}  // namespace meniscus
