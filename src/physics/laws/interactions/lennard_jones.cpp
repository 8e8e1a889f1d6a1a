// SPDX-License-Identifier: BSD-3-Clause
// Lennard-Jones interaction between the particles of two bodies, or of a body and a rigid partner,
// with continuous densities.
#include "input/optional_rows.hpp"
#include "meniscus/physics/interaction_registry.hpp"
#include "physics/contact/contact_numbers.hpp"

namespace meniscus {
namespace {

constexpr Dimension per_volume{-3, 0, 0}, per_area{-2, 0, 0};

struct Keys {
  std::string kernel;
  Real epsilon = 0, sigma0 = 0, cutoff = 0, least_gap = 0;
  Real beta = 0, beta_other = 0;  // densities of the first body and of the other side
  static Rows<Keys> rows();
};

/// The key epsilon. In the planar kernel, energies and densities per area have other units.
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

Row<Keys> kernel_row() {
  return choice_row("kernel", &Keys::kernel, {"integrated", "planar"},
                    "plane strain: phi integrated along the third axis, or phi in 2D; "
                    "without meaning in 3D",
                    "integrated");
}
Row<Keys> sigma0_row() {
  return real_row("sigma0", &Keys::sigma0, dimension::length, range::positive,
                  "distance of the minimum of phi");
}
Row<Keys> cutoff_row() {
  return real_row("cutoff", &Keys::cutoff, dimension::none, {least_cutoff, 100},
                  "cut-off / sigma0 between two bodies, switched smoothly from 3/4 of it; rigid "
                  "partners have none",
                  4.0);
}
Row<Keys> least_gap_row() {
  return real_row("least_gap", &Keys::least_gap, dimension::none, {0.1, 0.6},
                  "gap / sigma0 below which a step is rejected and a start refused; the stiffness "
                  "grows by its power -10",
                  meniscus::least_gap);
}

Rows<Keys> Keys::rows() {
  return {kernel_row(),     epsilon_row(), sigma0_row(),   beta_row(),
          beta_other_row(), cutoff_row(),  least_gap_row()};
}

/// Keys of the interaction whose epsilon follows from the adhesion.
struct ScaledKeys : Keys {
  std::optional<Real> angle, work;  // exactly one of them is given

  static Rows<ScaledKeys> rows() {
    return {optional_row("contact_angle", &ScaledKeys::angle, dimension::degrees, {1, 179},
                         "by adhesion",
                         "in degrees; adhesion = gamma (1 + cos theta), gamma the surface tension "
                         "of the first body"),
            optional_row("adhesion", &ScaledKeys::work, dimension::tension, range::positive,
                         "by contact_angle",
                         "energy per area that two half spaces release in contact (between two "
                         "bodies with the cut-off); epsilon and the densities follow from it"),
            of_all(kernel_row()),
            of_all(sigma0_row()),
            of_all(cutoff_row()),
            of_all(least_gap_row())};
  }
  Real adhesion(const ContactSurfaces& surfaces) const {
    return work ? *work : adhesion_of_angle(*angle, surfaces.tension());
  }

 private:
  static Row<ScaledKeys> of_all(const Row<Keys>& row) {
    return {row.key,
            row.type,
            row.unit,
            row.range,
            row.fallback,
            row.meaning,
            [read = row.read](ScaledKeys& keys, const Block& block) { read(keys, block); }};
  }
};

template <int D>
class Model final : public ContactModel<D> {
 public:
  explicit Model(Keys keys) : k_(std::move(keys)) {}
  /// A model whose epsilon follows from the adhesion.
  explicit Model(ScaledKeys keys) : k_(keys), scaled_(std::move(keys)) {
    k_.beta = k_.beta_other = 1;
  }

  void check(const Block& block, bool) const override {
    if (block.has("up"))
      block.problem("up",
                    "is for laws of the gap, such as smooth_young; allowed is to leave it out");
    if (scaled_ && scaled_->angle.has_value() == scaled_->work.has_value())
      block.problem("adhesion", scaled_->angle
                                    ? "is given beside contact_angle; allowed is one of them"
                                    : "and contact_angle are missing; one of them is needed");
  }

  std::unique_ptr<ForceTerm> between(const Body<D>& first, const Body<D>& second,
                                     const ContactChoice& choice,
                                     const ContactSurfaces& surfaces) const override {
    const ContactLaw cut = pair_law(false, surfaces);
    return contact_pair<D>({first, k_.beta}, {second, k_.beta_other}, cut, choice);
  }
  std::unique_ptr<ForceTerm> with_partner(const Body<D>& body, const PartnerPlan<D>& plan,
                                          const ContactChoice& choice,
                                          const ContactSurfaces& surfaces) const override {
    const ContactLaw uncut = pair_law(true, surfaces);
    MovingPartner<D> partner{plan.shape->lennard_jones(uncut, k_.beta_other), plan.motion,
                             k_.beta_other, plan.velocity_step, plan.shape};
    return rigid_contact<D>({body, k_.beta}, std::move(partner), uncut, choice);
  }
  std::shared_ptr<const Interaction> law(const ContactSurfaces& surfaces) const override {
    return std::make_shared<LennardJones>(pair_law(surfaces.rigid, surfaces),
                                          k_.beta * k_.beta_other);
  }

 private:
  /// The law with numbers for these surfaces. Throws InputError if an angle is given for a body
  /// without surface tension.
  ContactLaw pair_law(bool rigid, const ContactSurfaces& surfaces) const {
    ContactLaw law;
    if (surfaces.dimension == 2)
      law.kernel = pair_kernel_named(k_.kernel);
    else  // far from the axis, circles have the kernel of plane strain
      law.kernel = rigid || D == 3 ? PairKernel::space : PairKernel::integrated;
    law.epsilon = scaled_ ? 1 : k_.epsilon;
    law.sigma0 = k_.sigma0;
    law.cutoff = rigid ? std::numeric_limits<Real>::infinity() : k_.cutoff;
    law.guard = k_.least_gap;
    if (scaled_)
      law.epsilon =
          scaled_->adhesion(surfaces) / plane_contact(law, k_.beta * k_.beta_other).adhesion;
    return law;
  }

  Keys k_;
  std::optional<ScaledKeys> scaled_;
};

template <int D>
bool enter() {
  return register_entry(InteractionEntry<D>{
             "lennard_jones", "Lennard-Jones between particles spread over both sides",
             "epsilon = 1\nsigma0 = 0.3\nbeta = 1\n", [] { return key_texts(Keys::rows()); },
             [](const Block& block) -> std::unique_ptr<ContactModel<D>> {
               return std::make_unique<Model<D>>(read<Keys>(block));
             }}) &&
         register_entry(InteractionEntry<D>{
             "scaled_lennard_jones", "Lennard-Jones of a given adhesion or contact angle",
             "adhesion = 0.8\nsigma0 = 0.3\n", [] { return key_texts(ScaledKeys::rows()); },
             [](const Block& block) -> std::unique_ptr<ContactModel<D>> {
               return std::make_unique<Model<D>>(read<ScaledKeys>(block));
             }});
}

const bool registered = enter<2>() && enter<3>();

}  // namespace
}  // namespace meniscus
