// SPDX-License-Identifier: BSD-3-Clause
// What the numbers of a contact mean beside those of its bodies.
#pragma once
#include "meniscus/physics/partner_registry.hpp"
#include "meniscus/scene/assembly.hpp"
#include "physics/contact/gap/interaction.hpp"
#include "physics/contact/rigid/rigid_motion.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace meniscus {

/// A contact as it begins.
template <int D>
struct BeginningContact {
  std::string name;
  std::vector<std::string> bodies;  ///< two, or one that touches a rigid partner
  PlaneContact flat;                ///< the interaction of flat surfaces
  Real greatest_pressure;           ///< that flat surfaces hold
  Real gap = 0;                     ///< least distance at the start
  std::shared_ptr<const PartnerShape<D>> partner = {};  ///< null: between two bodies
  RigidMotion<D> partner_motion = {};
};

/// Notes the pressure rho c v of an impact beside the largest that the contact holds, the
/// elastocapillary number W/(mu R) of its solids, and the Tabor number where both sides are solid.
/// Warns where the contact is overcome. The speed v of the impact is that of the start, of the
/// fastest motion of the partner until the end, and what body forces add over the gap.
template <int D>
void advise(const BeginningContact<D>& contact, Assembly<D>& assembly);

/// Warns if a drop of low viscosity has to spread far on a flat wall to which it adheres.
/// `wetted_area` is a measure of the contact.
template <int D>
void advise_on_spreading(const std::string& contact, const std::string& drop, Real adhesion,
                         const std::function<Real(const Motion&)>& wetted_area,
                         Assembly<D>& assembly);

}  // namespace meniscus
