// SPDX-License-Identifier: BSD-3-Clause
// Laws of the gap between a body and rigid partners.
#include "meniscus/error.hpp"
#include "meniscus/physics/interaction_registry.hpp"
#include "physics/contact/adhesion.hpp"

#include <algorithm>

namespace meniscus {
namespace {

template <int D>
class DistanceField final : public RigidPartner<D> {
 public:
  DistanceField(std::shared_ptr<const Interaction> law,
                std::shared_ptr<const PartnerShape<D>> shape)
      : law_(std::move(law)),
        shape_(std::move(shape)),
        recess_(law_->recess()),
        core_(law_->least_gap()),
        at_core_(law_->at(core_)) {}

  RigidField<D> field(const Vec<D>& x) const override {
    const auto foot = shape_->foot(x);
    const auto [e, p] = state(foot.distance + recess_);
    const Mat<D> nn = foot.normal * foot.normal.transpose();
    return {p - e * foot.bend.trace(), -e * foot.normal, p * nn - e * foot.bend};
  }
  Real distance(const Vec<D>& x) const override { return shape_->foot(x).distance + recess_; }

 private:
  struct State {
    Real energy, pressure;
  };
  State state(Real gap) const {
    if (gap >= core_) {
      const PlaneState s = law_->at(gap);
      return {s.energy, s.pressure};
    }
    const Real depth = core_ - gap, p = at_core_.pressure, K = at_core_.stiffness;
    return {at_core_.energy + depth * (p + depth * K / 2), p + depth * K};
  }

  std::shared_ptr<const Interaction> law_;
  std::shared_ptr<const PartnerShape<D>> shape_;
  Real recess_, core_;
  PlaneState at_core_;
};

template <int D>
class GapContact final : public ContactModel<D> {
 public:
  explicit GapContact(GapLaw law) : law_(std::move(law)) {}

  void check(const Block& block, bool rigid) const override {
    if (!rigid && block.has("form") && block.text("form", "energy") != "energy")
      block.problem("form",
                    "with a law of the gap two bodies act on each other by its energy "
                    "alone; allowed is energy");
  }
  std::unique_ptr<ForceTerm> between(const Body<D>& first, const Body<D>& second,
                                     const ContactChoice& choice,
                                     const ContactSurfaces& surfaces) const override {
    const auto law = law_(surfaces);
    if (law->pattern() && law->pattern()->depends_on_place() && choice.up.empty())
      throw InputError(surfaces.place +
                       ": between two bodies adhesion may depend on the place where the second is "
                       "ground; allowed are the direction `up`, numbers and formulas of the time "
                       "t, or a [contact.partner]");
    return gap_pair<D>(first, second, law, choice);
  }
  std::unique_ptr<ForceTerm> with_partner(const Body<D>& body, const PartnerPlan<D>& plan,
                                          const ContactChoice& choice,
                                          const ContactSurfaces& surfaces) const override {
    const auto law = law_(surfaces);
    MovingPartner<D> partner{distance_field<D>(law, plan.shape), plan.motion, 1, plan.velocity_step,
                             plan.shape};
    return rigid_contact<D>({body, 1}, std::move(partner), law, choice);
  }
  std::shared_ptr<const Interaction> law(const ContactSurfaces& surfaces) const override {
    return law_(surfaces);
  }

 private:
  GapLaw law_;
};

}  // namespace

Real ContactSurfaces::tension() const {
  if (gamma) return *gamma;
  throw InputError(place +
                   ": contact_angle needs the surface tension of the first body, which has none; "
                   "allowed are adhesion, or a [[surface_tension]] of it");
}

template <int D>
std::unique_ptr<RigidPartner<D>> distance_field(std::shared_ptr<const Interaction> law,
                                                std::shared_ptr<const PartnerShape<D>> shape) {
  return std::make_unique<DistanceField<D>>(std::move(law), std::move(shape));
}

template <int D>
std::unique_ptr<ContactModel<D>> gap_contact(GapLaw law) {
  return std::make_unique<GapContact<D>>(std::move(law));
}

#define MENISCUS_INSTANTIATE(D)                                                    \
  template std::unique_ptr<RigidPartner<D>> distance_field(                        \
      std::shared_ptr<const Interaction>, std::shared_ptr<const PartnerShape<D>>); \
  template std::unique_ptr<ContactModel<D>> gap_contact(GapLaw);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
