// SPDX-License-Identifier: BSD-3-Clause
// Cylinder and point in the plane (CGCM note 3.3).
#pragma once
#include "radial_field.hpp"

namespace meniscus {

/// With the integrals I_p = INT_0^pi r^-p dt over the circle, r the distance of the point from it:
/// of each power c r^-p of psi and phi (p = 12 and 6, less one if `integrated`), with
/// J_p = INT_0^pi cos(t) r^-p dt,
///   U       = sum c_psi ((a^2 - R^2) I_p - I_(p-2))
///   S/a     = -sum c_psi 2 R J_(p-2)/((p - 2) a)
///   dU/da   = -sum c_phi 2 R J_p
/// These are the note's combinations of J0, J1, J2 without their cancellation near contact. Lengths
/// are scaled by sigma0.
class CylinderField {
 public:
  CylinderField(const ContactLaw& law, Real radius);

  RadialField at(Real distance) const;
  Real slope(Real distance) const;

 private:
  Real sigma0_, R_, unit_;
  PairCoefficients c_;
};

}  // namespace meniscus
