// SPDX-License-Identifier: BSD-3-Clause
// Fields of balls and cylinders at a point: closed forms of the distance from the centre.
#pragma once
#include "physics/contact/contact_law.hpp"

namespace meniscus {

/// Potential U of a round rigid body with unit particle density, and the vector S with div S = U
/// (see RigidField), at the distance a from the centre. k is the unit vector from the centre to the
/// point: S = a tangent k and grad S = tangent (I - k(x)k) + (U - (D - 1) tangent) k(x)k.
struct RadialField {
  Real U, tangent;
};

/// The field of a ball (CGCM note 3.2). The point may also be inside, as for all round fields. The
/// field there is minus the field of all space around a cavity. It is singular on the surface.
/// Lengths are scaled by sigma0.
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

/// The field of an infinite cylinder of radius R at the distance a from its axis, in 2D (CGCM note
/// 3.3). With a law that is not `integrated` along the axis it is the field of a disk.
///
/// r is the distance of the point from a point of the circle. The integrals are I_p = INT_0^pi r^-p
/// dt and J_p = INT_0^pi cos(t) r^-p dt. With the powers c r^-p of psi and phi (p = 12 and 6, less
/// one if `integrated`),
///
///   U       = sum c_psi ((a^2 - R^2) I_p - I_(p-2));
///   S/a     = -sum c_psi 2 R J_(p-2)/((p - 2) a);
///   dU/da   = -sum c_phi 2 R J_p.
///
/// These combinations equal those of J0, J1, J2 in the note, but do not cancel near contact.
/// Lengths are scaled by sigma0.
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
