// SPDX-License-Identifier: BSD-3-Clause
// Translation of a rigid partner.
#pragma once
#include "physics/contact/rigid/partner_press.hpp"

#include <memory>
#include <vector>

namespace meniscus {

/// Motion of a rigid partner by displacement(t) from its initial position. A point x has the
/// position x - displacement(t) in the frame of the partner. The power supplied from outside is
/// F.v, with the force F of the partner on the bodies and its velocity v. A pressed partner has the
/// displacement of its press instead, which is the present one at any time.
template <int D>
class RigidMotion {
 public:
  /// A partner at rest.
  RigidMotion() = default;
  /// `displacement`: D formulas of the time t; x, y and z are zero in them.
  explicit RigidMotion(std::vector<Expression> displacement);
  explicit RigidMotion(std::shared_ptr<PartnerPress<D>> press) : press_(std::move(press)) {}

  /// Null if the motion is prescribed.
  PartnerPress<D>* press() const { return press_.get(); }

  /// True if the displacement depends on time.
  bool moves() const;
  /// The time after which the partner stays at rest; for a pressed one, its force and its base.
  Real steady_after() const;
  Vec<D> displacement(Real t) const;
  /// The velocity, by a central difference of fourth order over t - 2 step ... t + 2 step, which is
  /// exact for polynomials of degree four. The time step is a good `step`.
  Vec<D> velocity(Real t, Real step) const;

 private:
  std::vector<Expression> displacement_;
  std::shared_ptr<PartnerPress<D>> press_;  // shared by all copies
};

}  // namespace meniscus
