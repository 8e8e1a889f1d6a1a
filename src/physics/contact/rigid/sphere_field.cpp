// SPDX-License-Identifier: BSD-3-Clause
// Field of a ball in closed form, or by a series where the closed form cancels.
#include "physics/contact/rigid/round_field.hpp"

namespace meniscus {
namespace {

/// The series sum over k = 1 ... 13 of c_k y^(2k-2), c_k = 4 k (k + 1)/(3 (2k + 1)).
Real attraction_series(Real y) {
  Real sum = 0;
  for (int k = 13; k > 0; --k) sum = sum * (y * y) + 4.0 * k * (k + 1) / (3 * (2 * k + 1));
  return sum;
}

}  // namespace

SphereField::SphereField(const ContactLaw& law, Real radius)
    : sigma0_(law.sigma0),
      R_(radius / law.sigma0),
      unit_(std::numbers::pi * law.epsilon * sigma0_ * sigma0_ * sigma0_) {}

RadialField SphereField::at(Real distance) const {
  const Real a = distance / sigma0_, R2 = R_ * R_, a2 = a * a, R3 = R2 * R_;
  const Real d = (a - R_) * (a + R_), d2 = d * d, d3 = d * d2, d8 = d2 * d3 * d3;
  const Real U12 =
      4 * R3 * (((15 * a2 + 63 * R2) * a2 + 45 * R2 * R2) * a2 + 5 * R3 * R3) / (45 * d * d8);
  const Real U6 = -8 * R3 / (3 * d3);
  const Real t12 = -4 * R3 * ((5 * a2 + 14 * R2) * a2 + 5 * R2 * R2) / (135 * d8);
  return {unit_ * (U12 + U6), unit_ * (t12 + attraction(a))};
}

Real SphereField::slope(Real distance) const {
  const Real a = distance / sigma0_, R2 = R_ * R_, a2 = a * a, R3 = R2 * R_;
  const Real d = (a - R_) * (a + R_), d2 = d * d, d4 = d2 * d2;
  const Real repulsion =
      -16 * R3 * a * (a2 + R2) * ((5 * a2 + 22 * R2) * a2 + 5 * R2 * R2) / (5 * d4 * d4 * d2);
  return unit_ / sigma0_ * (repulsion + 16 * R3 * a / d4);
}

/// The part of S/a with sigma0^6, divided by pi epsilon. If the radii are very different, its terms
/// cancel, and a series is used.
Real SphereField::attraction(Real a) const {
  const Real y = a > R_ ? R_ / a : a / R_;
  if (y < 0.25)
    return attraction_series(y) * (a > R_ ? y * y * y / (a * a * a) : 1 / (R_ * R_ * R_));
  const Real d = (a - R_) * (a + R_);
  const Real log_ratio = 2 * std::log1p(2 * (a > R_ ? R_ : a) / std::abs(a - R_));
  return (R_ * (a * a + R_ * R_) / (3 * d * d) - log_ratio / (12 * a)) / (a * a);
}

}  // namespace meniscus
