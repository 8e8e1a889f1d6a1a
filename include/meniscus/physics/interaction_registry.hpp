// SPDX-License-Identifier: BSD-3-Clause
// The registry of the interactions of [[contact]].
//
// A law of the gap is a struct derived from Interaction in its own file in
// src/physics/laws/interactions. It has rows(), an example and, if needed, check(block) and
// fitted(surfaces). The file ends with
//
//   const bool registered = register_interaction<MyLaw>("my_law", "short description");
//
// The law then acts between two bodies, and between a body and rigid partners of any shape.
// Interactions that need more than the gap implement ContactModel.
#pragma once
#include "meniscus/physics/partner_registry.hpp"
#include "physics/contact/contact_terms.hpp"
#include "physics/surface/surface_tension.hpp"

namespace meniscus {

/// A rigid partner as described in a scene.
template <int D>
struct PartnerPlan {
  std::shared_ptr<const PartnerShape<D>> shape;
  RigidMotion<D> motion;
  Real velocity_step;  ///< as in MovingPartner
};

/// Data of the surfaces between which an interaction acts. It can use them for parameters that the
/// scene leaves out.
struct ContactSurfaces {
  std::string place;          ///< place of the contact in the scene, for messages
  Real facet;                 ///< edge of the larger facets
  std::optional<Real> gamma;  ///< surface tension of the first body, if it has any
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< mean position of the particles of the
                                                     ///< first body
  std::optional<TensionForm> tension_form = {};      ///< of its [[surface_tension]], if it has one
  std::optional<Real> gamma_beyond = {};             ///< surface tension of the second body, if any
  bool rigid = false;                                ///< the other side is a rigid partner
  int dimension = 3;
  Real volume = 0;  ///< of the first body

  /// gamma, for a contact angle; throws InputError if the first body has no surface tension.
  Real tension() const;
};

/// An interaction with the parameters of a scene, ready to act between bodies.
template <int D>
class ContactModel {
 public:
  virtual ~ContactModel() = default;

  /// The default form of its forces.
  virtual std::string usual_form() const { return "energy"; }
  /// Notes problems in the block, for two bodies or for a body and a rigid partner.
  virtual void check(const Block& block, bool rigid) const = 0;
  virtual std::unique_ptr<ForceTerm> between(const Body<D>& first, const Body<D>& second,
                                             const ContactChoice& choice,
                                             const ContactSurfaces& surfaces) const = 0;
  virtual std::unique_ptr<ForceTerm> with_partner(const Body<D>& body, const PartnerPlan<D>& plan,
                                                  const ContactChoice& choice,
                                                  const ContactSurfaces& surfaces) const = 0;
  /// The interaction of these surfaces if they are flat. Throws InputError if they lack a surface
  /// tension that it needs, or if a number of it is not allowed for them.
  virtual std::shared_ptr<const Interaction> law(const ContactSurfaces& surfaces) const = 0;
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

/// Makes a law of the gap for given surfaces.
using GapLaw = std::function<std::shared_ptr<const Interaction>(const ContactSurfaces&)>;

/// A contact model that applies a law of the gap to two bodies, or to a body and rigid partners.
template <int D>
std::unique_ptr<ContactModel<D>> gap_contact(GapLaw law);

/// The field of a law e(g) at the distance d from a shape, g = d + recess: S = -e(g) grad d and U =
/// div S. A surface that faces the partner (n = -grad d) then has the energy S.n = e per area.
/// Below the smallest gap the pressure grows linearly.
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
