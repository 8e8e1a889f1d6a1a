// SPDX-License-Identifier: BSD-3-Clause
// Field of a cylinder at a point: complete elliptic integrals (`integrated`) or rational functions
// (`planar`) near the cylinder, power series far away.
#include "physics/contact/rigid/round_field.hpp"

#include <array>

namespace meniscus {
namespace {

/// Complete elliptic integrals K and E of the parameter m (not the modulus), computed from 1 - m by
/// the arithmetic-geometric mean.
struct Elliptic {
  Real K, E;
};
Elliptic complete_elliptic(Real one_minus_m) {
  constexpr Real pi = std::numbers::pi;
  Real a = 1, b = std::sqrt(one_minus_m), weight = 0.5, sum = (1 - one_minus_m) / 2;
  while (a - b > 1e-8 * a) {  // the difference is about squared in each step
    const Real c = (a - b) / 2, mean = (a + b) / 2;
    b = std::sqrt(a * b);
    a = mean;
    weight *= 2;
    sum += weight * c * c;
  }
  const Real K = pi / (a + b);
  const Real last = (a - b) / 2;
  return {K, K * (1 - sum - 2 * weight * last * last)};
}

/// Combinations of the integrals over a circle of radius R, at the distance a from its centre.
class Circle {
 public:
  struct Moments {
    Real U;       ///< (a^2 - R^2) I_p - I_(p-2)
    Real J_by_a;  ///< J_p/a
  };

  Circle(bool odd, Real a, Real R) : a_(a), R_(R), far_(a < far_ratio * R || R < far_ratio * a) {
    if (!far_) integrate(odd);
  }

  Moments moments(int p) const {
    if (far_) return series(p / 2.0);
    const Real I = at(I_, p / 2), below = at(I_, p / 2 - 1);
    return {(a_ - R_) * (a_ + R_) * I - below,
            ((a_ * a_ + R_ * R_) * I - below) / (2 * a_ * a_ * R_)};
  }

 private:
  /// Ratio of the radii below which the series is used.
  static constexpr Real far_ratio = 0.35;

  /// Computes I_p upwards: nu Q I_(2 nu + 2) = (2 nu - 1) A I_(2 nu) - (nu - 1) I_(2 nu - 2) with A
  /// = a^2 + R^2, Q = (a^2 - R^2)^2.
  void integrate(bool odd) {
    constexpr Real pi = std::numbers::pi;
    const Real difference = std::abs(a_ - R_), sum = a_ + R_;
    const Real Q = (difference * sum) * (difference * sum), A = a_ * a_ + R_ * R_;
    Real nu = 1;
    if (odd) {
      const Elliptic complete = complete_elliptic((difference / sum) * (difference / sum));
      nu = 1.5;
      I_[0] = 2 * complete.K / sum;
      I_[1] = 2 * sum * complete.E / Q;  // from I_-1 = 2 (a + R) E
    } else {
      I_[0] = pi;
      I_[1] = pi / (difference * sum);
    }
    for (int k = 1; k < 6; ++k, nu += 1)
      at(I_, k + 1) = ((2 * nu - 1) * A * at(I_, k) - (nu - 1) * at(I_, k - 1)) / (nu * Q);
  }

  /// Series for the ratio y < 1 of the radii. With the larger radius b, nu = p/2, g_k = (nu)_k/k!
  /// and f_k = (nu - 1)_k/k!, all terms have the same sign:
  ///
  ///   J_p = pi b^-p sum_(k>=0) g_(k+1) g_k y^(2k+1)
  ///   U   = 2 pi b^(2-p) sum_(k>=1) g_(k-1) f_k y^(2k) outside, -2 pi b^(2-p) sum_(k>=0) g_k f_k
  ///         y^(2k) inside.
  Moments series(Real nu) const {
    const bool outside = a_ > R_;
    const Real b = outside ? a_ : R_, y = (outside ? R_ : a_) / b;
    Real U = 0, J = 0, power = 1, f = 1, g = 1, g_before = 0, term = 1;
    for (int k = 0; term > 1e-18 * J; ++k) {
      const Real g_next = g * (nu + k) / (k + 1);
      term = g_next * g * power;
      J += term;
      U += (outside ? g_before : g) * f * power;
      f *= (nu - 1 + k) / (k + 1);
      g_before = g;
      g = g_next;
      power *= y * y;
    }
    const Real scale = std::numbers::pi * std::pow(b, -2 * nu);
    return {(outside ? 2 : -2) * scale * b * b * U, scale * J / b * (outside ? y : 1)};
  }

  Real a_, R_;
  bool far_;
  std::array<Real, 7> I_{};  ///< [k] I_p for p = odd + 2 k
};

}  // namespace

CylinderField::CylinderField(const ContactLaw& law, Real radius)
    : sigma0_(law.sigma0), R_(radius / law.sigma0), c_(pair_coefficients(law.kernel)) {
  unit_ = law.epsilon * sigma0_ * sigma0_ * (c_.odd == 1 ? sigma0_ : 1);
}

RadialField CylinderField::at(Real distance) const {
  const Circle circle(c_.odd == 1, distance / sigma0_, R_);
  const int p12 = 12 - c_.odd, p6 = 6 - c_.odd;
  const Real U = c_.psi12 * circle.moments(p12).U + c_.psi6 * circle.moments(p6).U;
  const Real tangent = -2 * R_ *
                       (c_.psi12 / (p12 - 2) * circle.moments(p12 - 2).J_by_a +
                        c_.psi6 / (p6 - 2) * circle.moments(p6 - 2).J_by_a);
  return {unit_ * U, unit_ * tangent};
}

Real CylinderField::slope(Real distance) const {
  const Real a = distance / sigma0_;
  const Circle circle(c_.odd == 1, a, R_);
  return -unit_ / sigma0_ * 2 * R_ * a *
         (c_.phi12 * circle.moments(12 - c_.odd).J_by_a +
          c_.phi6 * circle.moments(6 - c_.odd).J_by_a);
}

}  // namespace meniscus
