// SPDX-License-Identifier: BSD-3-Clause
// Field of a half space: a power law of the distance.
#pragma once
#include "numbers/simd.hpp"
#include "physics/contact/contact_law.hpp"

namespace meniscus {

/// U of a half space without cut-off at the distance a, per density beta2: U(a) = epsilon sigma0^(3
/// - planar) (A z^-m - B z^-n) with z = a/sigma0 (CGCM note 3.1). The kernels `space` and
/// `integrated` give the same U.
class PlaneField {
 public:
  explicit PlaneField(const ContactLaw& law) : sigma0_(law.sigma0) {
    constexpr Real pi = std::numbers::pi;
    const bool planar = law.kernel == PairKernel::planar;
    A_ = planar ? 63 * pi / 2560 : pi / 45;
    B_ = planar ? 3 * pi / 16 : pi / 3;
    m_ = planar ? 10 : 9;
    n_ = m_ - 6;
    unit_ = law.epsilon * law.sigma0 * law.sigma0 * (planar ? 1 : law.sigma0);
  }

  /// The k-th derivative of U for k = 0, 1 or 2. For k = -1, minus the integral of U from a to
  /// infinity, which is S along the normal.
  template <class T>
  T derivative(int k, T a) const {
    const T z = a / sigma0_;
    Real scale = k < 0 ? sigma0_ : 1;
    for (int i = 0; i < k; ++i) scale /= sigma0_;
    return unit_ * scale * (A_ * power(m_, k, z) - B_ * power(n_, k, z));
  }
  template <class T>
  T S(T a) const {
    return derivative(-1, a);
  }
  template <class T>
  T U(T a) const {
    return derivative(0, a);
  }
  Real dU(Real a) const { return derivative(1, a); }

  /// The distance at which the k-th derivative is zero.
  Real root(int k) const {
    return sigma0_ * std::pow(A_ * power(m_, k, 1) / (B_ * power(n_, k, 1)), 1.0 / 6);
  }

 private:
  /// The derivative d^k/dz^k z^-p.
  template <class T>
  static T power(int p, int k, T z) {
    Real factor = k < 0 ? Real(1) / (1 - p) : 1;
    for (int i = 0; i < k; ++i) factor *= -(p + i);
    const T by_z = 1.0 / z;
    T value = 1;
    for (int i = 0; i < p + k; ++i) value *= by_z;
    return factor * value;
  }

  Real sigma0_, unit_, A_, B_;
  int m_, n_;
};

/// Like PlaneField, but below the smallest gap and inside the surface, U continues linearly. U is
/// repulsive there, its slope is continuous, and S is its integral.
class GuardedPlane {
 public:
  explicit GuardedPlane(const ContactLaw& law)
      : exact_(law),
        core_(law.guard * law.sigma0),
        S_(exact_.S(core_)),
        U_(exact_.U(core_)),
        dU_(exact_.dU(core_)) {}

  template <class T>
  T U(T a) const {
    return from_core(a, U_ + dU_ * (a - core_), exact_.U(a));
  }
  template <class T>
  T S(T a) const {
    const T d = a - core_;
    return from_core(a, S_ + d * (U_ + d * dU_ / 2.0), exact_.S(a));
  }

 private:
  Real from_core(Real a, Real below, Real above) const { return a < core_ ? below : above; }
  Lanes from_core(Lanes a, Lanes below, Lanes above) const {
    return select(a.v < core_, below, above);
  }

  PlaneField exact_;
  Real core_, S_, U_, dU_;
};

}  // namespace meniscus
