// SPDX-License-Identifier: BSD-3-Clause
// The registry of interactions by which a [[contact]] acts.
//
// A law of the gap is a struct derived from Interaction in its own file in src/interactions, with
// rows(), an example and, if it needs them, check(block) and fitted(surfaces), which ends with
//   const bool registered = register_interaction<MyLaw>("my_law", "what it is");
// It then acts between two bodies, and between a body and rigid partners of any shape. A
// ContactModel of its own is for interactions that know more than a law of the gap.
#pragma once
#include "meniscus/physics/contact.hpp"
#include "meniscus/physics/partner_registry.hpp"

namespace meniscus {

/// The rigid partner that a scene describes.
template <int D>
struct PartnerPlan {
  std::shared_ptr<const PartnerShape<D>> shape;
  RigidMotion<D> motion;
  Real velocity_step;  ///< as in MovingPartner
};

/// What an interaction can know of the surfaces between which it acts, for numbers that a scene
/// leaves to it.
struct ContactSurfaces {
  std::string place;          ///< of the contact in the scene, for messages
  Real facet;                 ///< edge of the larger facets
  std::optional<Real> gamma;  ///< surface tension of the first body, if it has any
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< of the particles of the first body
  std::string tension_form = {};          ///< of its [[surface_tension]]; empty: it has none
  std::optional<Real> gamma_beyond = {};  ///< of the second body, if there is one and it has any

  /// gamma, for a contact angle; throws InputError if the first body has none.
  Real tension() const;
};

/// An interaction as a scene describes it, ready to act between bodies.
template <int D>
class ContactModel {
 public:
  virtual ~ContactModel() = default;

  /// The form of its forces where a scene names none.
  virtual std::string usual_form() const { return "energy"; }
  /// Notes in the block what cannot be, between two bodies or of one with a rigid partner.
  virtual void check(const Block& block, bool rigid) const = 0;
  virtual std::unique_ptr<ForceTerm> between(const Body<D>& first, const Body<D>& second,
                                             const ContactChoice& choice,
                                             const ContactSurfaces& surfaces) const = 0;
  virtual std::unique_ptr<ForceTerm> with_partner(const Body<D>& body, const PartnerPlan<D>& plan,
                                                  const ContactChoice& choice,
                                                  const ContactSurfaces& surfaces) const = 0;
  /// Whether its adhesion is a formula of the place.
  virtual bool placed(const ContactSurfaces&) const { return false; }
  /// What it means for flat surfaces.
  virtual PlaneContact flat(bool rigid, const ContactSurfaces& surfaces) const = 0;
  /// The largest adhesion between two bodies until `end`, if it changes with time.
  virtual Real greatest_adhesion(const ContactSurfaces& surfaces, [[maybe_unused]] Real end) const {
    return flat(false, surfaces).adhesion;
  }
  /// The pressure of flat surfaces at the least gap: what presses harder comes through.
  virtual Real greatest_pressure(bool rigid, const ContactSurfaces& surfaces) const = 0;
  /// The lengths that it chose, in words; empty: flat() says it all.
  virtual std::string described(const ContactSurfaces&, const UnitSystem&) const { return {}; }
  /// Why it may be wrong there, if it may.
  virtual std::optional<std::string> doubt(const ContactSurfaces& surfaces) const = 0;
};

template <int D>
struct InteractionEntry {
  static constexpr const char* kind = "interaction";
  std::string_view name, meaning, example;
  std::vector<KeyText> (*keys)();
  std::unique_ptr<ContactModel<D>> (*read)(const Block&);  ///< notes problems in the block
};

template <int D>
const Registry<InteractionEntry<D>>& interactions() {
  return Registry<InteractionEntry<D>>::all();
}

/// A law of the gap for given surfaces.
using GapLaw = std::function<std::shared_ptr<const Interaction>(const ContactSurfaces&)>;

/// A law of the gap on two bodies, or on a body and rigid partners.
template <int D>
std::unique_ptr<ContactModel<D>> gap_contact(GapLaw law);

/// The field of a law e(d) of the distance from a shape: S = -e(d) grad d, so that the energy S.n
/// of a surface that faces the partner (n = -grad d) is e per area, and U = div S. Nearer than the
/// least gap the pressure goes on growing linearly.
template <int D>
std::unique_ptr<RigidPartner<D>> distance_field(std::shared_ptr<const Interaction> law,
                                                std::shared_ptr<const PartnerShape<D>> shape);

template <int D, class L>
bool register_interaction_in(std::string_view name, std::string_view meaning) {
  return register_entry(InteractionEntry<D>{
      name, meaning, example_of<L>(), [] { return key_texts(L::rows()); },
      [](const Block& block) {
        auto law = std::make_shared<L>();
        for (const auto& row : L::rows()) row.read(*law, block);
        if constexpr (requires { law->check(block); })
          if (block.in_order()) law->check(block);
        return gap_contact<D>(
            [law](const ContactSurfaces& surfaces) -> std::shared_ptr<const Interaction> {
              if constexpr (requires { law->fitted(surfaces); })
                return law->fitted(surfaces);
              else
                return law;
            });
      }});
}

template <class L>
bool register_interaction(std::string_view name, std::string_view meaning) {
  return register_interaction_in<2, L>(name, meaning) &&
         register_interaction_in<3, L>(name, meaning);
}

}  // namespace meniscus
