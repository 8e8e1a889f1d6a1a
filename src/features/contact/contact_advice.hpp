// SPDX-License-Identifier: BSD-3-Clause
// Advice on a contact: dimensionless numbers and warnings that compare it with its bodies.
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

/// A contact at the start of a run.
template <int D>
struct BeginningContact {
  std::string name;
  std::vector<std::string> bodies;  ///< two, or one if the other side is a rigid partner
  PlaneContact flat;                ///< the interaction of flat surfaces
  Real rest_gap;                    ///< distance of flat surfaces in equilibrium
  Real greatest_pressure;           ///< largest pressure that the contact of flat surfaces resists
  Real gap = 0;                     ///< smallest distance at the start
  std::shared_ptr<const PartnerShape<D>> partner = {};  ///< null: between two bodies
  RigidMotion<D> partner_motion = {};
};

/// Notes the pressure rho c v of an impact beside the largest pressure that the contact resists,
/// the elastocapillary number W/(mu R) of its solids, and the Tabor number if both sides are solid.
/// Warns if the impact pressure is too large. The impact speed v combines the speed at the start,
/// the largest speed of the partner until the end, and the speed that body forces add over the gap.
template <int D>
void advise(const BeginningContact<D>& contact, Assembly<D>& assembly);

/// Warns if a drop of low viscosity has to spread far on an adhesive flat wall. `wetted_area` is a
/// measure of the contact.
template <int D>
void advise_on_spreading(const std::string& contact, const std::string& drop, Real adhesion,
                         const std::function<Real(const Motion&)>& wetted_area,
                         Assembly<D>& assembly);

}  // namespace meniscus
