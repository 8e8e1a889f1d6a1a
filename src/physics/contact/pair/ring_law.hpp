// SPDX-License-Identifier: BSD-3-Clause
// Lennard-Jones interaction of two circles about a common axis.
#pragma once
#include "physics/contact/contact_law.hpp"

namespace meniscus {

/// Energy of two circles per product of their area vectors, with its derivatives with the place (r,
/// z) of the first. The components of area vectors along the axis have `along`, those across it
/// `across`.
template <class T>
struct RingPair {
  struct Energy {
    T value, by_r, by_z;
  };
  Energy along, across;
};

/// The mean over the angle phi between two points, of u (along the axis) and of u cos(phi) (across
/// it), where u is the pair energy of surface points in 3D (axisymmetry note 6). Far from the
/// axis this is the kernel `integrated` over 2 pi r. As in that kernel, u is switched off by the
/// distance in the half plane.
class RingLaw {
 public:
  explicit RingLaw(const ContactLaw& law)
      : per_sigma_(1 / law.sigma0),
        begin_(law.cut() ? switch_begin * law.reach() : 0),
        per_width_(law.cut() ? 1 / ((1 - switch_begin) * law.reach()) : 0) {
    constexpr PairCoefficients c = pair_coefficients(PairKernel::space);
    const Real unit = law.epsilon * law.sigma0 * law.sigma0;
    u10_ = unit * c.u12 / 8;
    u4_ = unit * c.u6;
  }

  /// `radius`: distance of the first point from the axis. `r`: from the second point to the first.
  /// `square`: of the length of r.
  template <class T>
  [[gnu::always_inline]] RingPair<T> operator()(T radius, const T* r, T square) const {
    using std::sqrt;
    const T own = radius * per_sigma_, dr = r[0] * per_sigma_, dz = r[1] * per_sigma_,
            other = own - dr, near = square * (per_sigma_ * per_sigma_);
    // The squared distance of points of the circles is a - b cos(phi); a^2 - b^2 = near far.
    const T b = 2.0 * own * other, a = near + b, far = near + 2.0 * b;
    const T q = 1.0 / (near * far), a2 = a * a;
    const T q3 = q * sqrt(q), q5 = q3 * q, q7 = q5 * q, q9 = q7 * q;  // half powers of q
    // f = mean of u, b g = mean of u cos(phi); f_a, g_a: derivatives with a; f_e, g_e: with 1/q.
    const T f = u10_ * (35.0 * a2 * a2 * q9 - 30.0 * a2 * q7 + 3.0 * q5) + u4_ * a * q3;
    const T f_a = u10_ * (140.0 * a2 * q9 - 60.0 * q7) * a + u4_ * q3;
    const T f_e =
        u10_ * (-157.5 * a2 * a2 * q9 + 105.0 * a2 * q7 - 7.5 * q5) * q - 1.5 * u4_ * a * q5;
    const T g = u10_ * (35.0 * a2 * q9 - 15.0 * q7) * a + u4_ * q3;
    const T g_a = u10_ * (105.0 * a2 * q9 - 15.0 * q7);
    const T g_e = u10_ * (-157.5 * a2 * q9 + 52.5 * q7) * a * q - 1.5 * u4_ * q5;
    const T a_r = 2.0 * own, e_r = 2.0 * (dr * far + near * (own + other));
    const T a_z = 2.0 * dz, e_z = 2.0 * dz * (far + near);
    const typename PairLaw<PairKernel::integrated>::template Switch<T> Q(sqrt(square), begin_,
                                                                         per_width_);
    const T falls = Q.first / sqrt(square);
    const auto switched = [&](T value, T by_r, T by_z) {
      return typename RingPair<T>::Energy{value * Q.value,
                                          by_r * per_sigma_ * Q.value + value * falls * r[0],
                                          by_z * per_sigma_ * Q.value + value * falls * r[1]};
    };
    return {switched(f, f_a * a_r + f_e * e_r, f_a * a_z + f_e * e_z),
            switched(b * g, 2.0 * other * g + b * (g_a * a_r + g_e * e_r),
                     b * (g_a * a_z + g_e * e_z))};
  }

 private:
  Real per_sigma_, u10_, u4_;
  Real begin_, per_width_;  // of the switch; zeros without cut-off
};

}  // namespace meniscus
