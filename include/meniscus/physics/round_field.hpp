// SPDX-License-Identifier: BSD-3-Clause
// Balls and cylinders and a point: closed forms of the distance from their centre.
#pragma once
#include "meniscus/physics/contact_law.hpp"

namespace meniscus {

/// Per density beta2, at the distance a from the centre. S = a tangent k with the radial direction
/// k, and grad S = tangent (I - k(x)k) + (U - (D - 1) tangent) k(x)k because div S = U.
struct RadialField {
  Real U, tangent;
};

/// A ball (CGCM note 3.2). Like all round fields: also for a point inside, where it is minus the
/// field of all space around a cavity; singular on the surface. Lengths are scaled by sigma0.
class SphereField {
 public:
  SphereField(const ContactLaw& law, Real radius);

  RadialField at(Real distance) const;
  /// dU/da.
  Real slope(Real distance) const;

 private:
  Real attraction(Real a) const;

  Real sigma0_, R_, unit_;
};

/// A cylinder across the plane (CGCM note 3.3).
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
