// SPDX-License-Identifier: BSD-3-Clause
// Balls, cavities and cylinders: fields that depend on the distance from a centre alone.
#pragma once
#include "meniscus/physics/rigid_partner.hpp"

#include <cmath>

namespace meniscus {

/// Per density beta2, at the distance a from the centre. S = a tangent k with the radial direction
/// k, and grad S = tangent (I - k(x)k) + (U - (D - 1) tangent) k(x)k because div S = U.
struct RadialField {
  Real U, tangent;
};

/// Round body or cavity from its closed form `Exact`: a struct made from (law, radius) with
///   RadialField at(Real a) const   of a full ball, for a on either side of the radius,
///   Real slope(Real a) const       dU/da.
template <int D, class Exact>
class RoundPartner final : public RigidPartner<D> {
 public:
  RoundPartner(const ContactLaw& law, Real beta, const Vec<D>& centre, Real radius, bool cavity)
      : exact_(law, radius),
        centre_(centre),
        radius_(radius),
        cavity_(cavity),
        beta_(cavity ? -beta : beta),  // all space less the ball
        core_(cavity ? radius - law.guard * law.sigma0 : radius + law.guard * law.sigma0) {
    if (core_ > 0) {
      at_core_ = exact_.at(core_);
      slope_ = exact_.slope(core_);
    }
  }

  RigidField<D> field(const Vec<D>& x) const override {
    const Vec<D> from_centre = x - centre_;
    const Real a = from_centre.norm();
    const Vec<D> k = a > 0 ? Vec<D>(from_centre / a) : Vec<D>::Unit(0);
    const RadialField f = inside_core(a) ? continued(a) : exact_.at(a);
    const Mat<D> kk = k * k.transpose();
    const Real radial = f.U - (D - 1) * f.tangent;
    return {beta_ * f.U, beta_ * f.tangent * from_centre,
            beta_ * (f.tangent * (Mat<D>::Identity() - kk) + radial * kk)};
  }

  Real distance(const Vec<D>& x) const override {
    const Real outside = (x - centre_).norm() - radius_;
    return cavity_ ? -outside : outside;
  }

 private:
  bool inside_core(Real a) const { return cavity_ ? a > core_ : a < core_; }

  /// U = U_c + U_c' (a - a_c), and a^D tangent = a^(D-1) S from the integral of a^(D-1) U.
  RadialField continued(Real a) const {
    const Real U0 = at_core_.U - slope_ * core_, c = core_;
    const auto flux = [&](Real r) { return std::pow(r, D) * (U0 / D + slope_ * r / (D + 1)); };
    const Real least = 1e-6 * radius_;  // S has a pole in the centre of a ball
    const Real r = a > least ? a : least;
    return {U0 + slope_ * r,
            (std::pow(c, D) * at_core_.tangent + flux(r) - flux(c)) / std::pow(r, D)};
  }

  Exact exact_;
  Vec<D> centre_;
  Real radius_;
  bool cavity_;
  Real beta_, core_;
  RadialField at_core_{};
  Real slope_ = 0;
};

}  // namespace meniscus
