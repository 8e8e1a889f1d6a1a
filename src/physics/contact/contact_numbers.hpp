// SPDX-License-Identifier: BSD-3-Clause
// Interaction of two flat bodies: adhesion, equilibrium gap, strength, stiffness.
#pragma once
#include "physics/contact/contact_law.hpp"
#include "physics/contact/gap/interaction.hpp"

#include <limits>
#include <optional>
#include <string>

namespace meniscus {

/// Characteristic numbers of the contact of two flat bodies. `beta_product` is beta1 beta2. Without
/// a cut-off they have a closed form (CGCM note 3.1). With a cut-off they are exact to rounding,
/// except softening_gap, which has half of the digits.
PlaneContact plane_contact(const ContactLaw& law, Real beta_product);

/// Throws InputError that begins with `place` if a number of the contact is infinite or not a
/// number, or if its adhesion, gap or traction is not positive: the numbers of the interaction are
/// then too large or too small for floating-point arithmetic.
void require_finite(const PlaneContact& contact, const std::string& place);

/// Two half spaces (half planes) at the gap g > 0. The kernel `planar` counts per length and depth.
PlaneState plane_state(const ContactLaw& law, Real beta_product, Real gap);

/// The pair law between bodies with `beta_product` = beta1 beta2, as an interaction of surfaces.
/// at() ignores the cut-off and uses the closed form, since the cut-off hardly changes the
/// stiffness.
class LennardJones : public Interaction {
 public:
  LennardJones(const ContactLaw& law, Real beta_product)
      : law_(law), uncut_(law), beta_product_(beta_product) {
    uncut_.cutoff = std::numeric_limits<Real>::infinity();
  }
  PlaneState at(Real gap) const override { return plane_state(uncut_, beta_product_, gap); }
  Real range() const override { return 5 * law_.sigma0; }
  Real least_gap() const override { return law_.guard * law_.sigma0; }
  std::optional<int> far_power() const override {
    return law_.kernel == PairKernel::planar ? 4 : 3;
  }
  PlaneContact flat() const override { return plane_contact(law_, beta_product_); }

 private:
  ContactLaw law_, uncut_;
  Real beta_product_;
};

/// The angle in radians at which a liquid with surface tension gamma meets a rigid plane to which
/// it adheres, cos theta = W/gamma - 1 (Young-Dupre); none where W >= 2 gamma: complete wetting.
std::optional<Real> contact_angle(Real adhesion, Real gamma);

/// gamma (1 + cos theta) of an angle in degrees.
Real adhesion_of_angle(Real degrees, Real gamma);

/// "61.3 degrees" or "complete wetting".
std::string contact_angle_text(Real adhesion, Real gamma);

}  // namespace meniscus
