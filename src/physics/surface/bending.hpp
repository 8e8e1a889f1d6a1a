// SPDX-License-Identifier: BSD-3-Clause
// Bending energy of Helfrich at a point of a surface, from the derivatives of its position by two
// parameters (membranes note 2).
#pragma once
#include "numbers/types.hpp"

#include <array>
#include <cmath>

namespace meniscus {

/// Derivatives of the position x of a surface point by two parameters, in 3D: x,1 x,2 x,11 x,12
/// x,22. The normal x,1 x x,2 points outward.
template <class T>
using SurfaceDerivatives = std::array<std::array<T, 3>, 5>;

/// An energy per area of the parameters, and its derivative by each of the SurfaceDerivatives.
template <class T>
struct BendingEnergy {
  T energy;
  SurfaceDerivatives<T> slope;
};

namespace bending {

template <class T>
T dot(const std::array<T, 3>& a, const std::array<T, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
/// a x + b y
template <class T>
std::array<T, 3> sum_of(const T& a, const std::array<T, 3>& x, const T& b,
                        const std::array<T, 3>& y) {
  return {a * x[0] + b * y[0], a * x[1] + b * y[1], a * x[2] + b * y[2]};
}
template <class T>
std::array<T, 3> scaled(const T& a, const std::array<T, 3>& x) {
  return {a * x[0], a * x[1], a * x[2]};
}

}  // namespace bending

/// Metric, normal and curvature of a surface point.
template <class T>
struct CurvedPoint {
  T J;                     ///< area per area of the parameters
  std::array<T, 3> n;      ///< outward unit normal
  T g11, g12, g22;         ///< inverse metric
  std::array<T, 3> S;      ///< g^ab x,ab
  T twice_mean_curvature;  ///< -n.S, 2/R on a sphere

  explicit CurvedPoint(const SurfaceDerivatives<T>& d) {
    using std::sqrt;
    const std::array<T, 3>&a = d[0], &b = d[1];
    const std::array<T, 3> m{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                             a[0] * b[1] - a[1] * b[0]};
    const T square = bending::dot(m, m), over_square = 1.0 / square;
    J = sqrt(square);
    n = bending::scaled(1.0 / J, m);
    g11 = over_square * bending::dot(b, b);
    g22 = over_square * bending::dot(a, a);
    g12 = -over_square * bending::dot(a, b);
    S = bending::sum_of(g11, d[2], 2.0 * g12, d[3]);
    S = bending::sum_of(T(1.0), S, g22, d[4]);
    twice_mean_curvature = -bending::dot(n, S);
  }
};

/// The energy kappa/2 (2H - c0)^2 J of a surface point, with 2H =
/// CurvedPoint::twice_mean_curvature, and its exact derivatives.
template <class T>
BendingEnergy<T> bending_energy(const SurfaceDerivatives<T>& d, Real kappa, Real c0) {
  const CurvedPoint<T> p(d);
  const T bent = p.twice_mean_curvature - c0, density = 0.5 * kappa * bent * bent,
          pull = p.J * density, moment = p.J * kappa * bent;
  const std::array<T, 3> up1 = bending::sum_of(p.g11, d[0], p.g12, d[1]),
                         up2 = bending::sum_of(p.g12, d[0], p.g22, d[1]);
  const T n11 = bending::dot(p.n, d[2]), n12 = bending::dot(p.n, d[3]),
          n22 = bending::dot(p.n, d[4]);
  // b^ab = g^am n_mn g^nb with n_mn = n.x,mn
  const T c11 = p.g11 * n11 + p.g12 * n12, c12 = p.g11 * n12 + p.g12 * n22,
          c21 = p.g12 * n11 + p.g22 * n12, c22 = p.g12 * n12 + p.g22 * n22;
  const T b11 = c11 * p.g11 + c12 * p.g12, b12 = c11 * p.g12 + c12 * p.g22,
          b22 = c21 * p.g12 + c22 * p.g22;
  const auto slope = [&](const std::array<T, 3>& up, const T& ba, const T& bb) {
    const std::array<T, 3> curved =
                               bending::sum_of(2.0 * moment * ba, d[0], 2.0 * moment * bb, d[1]),
                           stretched =
                               bending::sum_of(pull, up, moment * bending::dot(up, p.S), p.n);
    return bending::sum_of(T(1.0), curved, T(1.0), stretched);
  };
  return {pull,
          {slope(up1, b11, b12), slope(up2, b12, b22), bending::scaled(-moment * p.g11, p.n),
           bending::scaled(-2.0 * moment * p.g12, p.n), bending::scaled(-moment * p.g22, p.n)}};
}

}  // namespace meniscus
