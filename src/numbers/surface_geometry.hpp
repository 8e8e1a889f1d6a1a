// SPDX-License-Identifier: BSD-3-Clause
// Normal, area ratio and curvature of a deformed surface from the deformation gradient F, its
// gradient G and the reference normal (RKPM note 3). Always in three dimensions: in plane strain a
// curve is the cylinder over it (F33 = 1, N3 = 0).
#pragma once
#include "numbers/tensor.hpp"

#include <array>
#include <cmath>

namespace meniscus {

/// Quantities of a deformed surface point that follow from F and the reference unit normal N alone.
template <class T>
struct SurfaceFrame {
  std::array<T, 3> n;  ///< current outward unit normal, n = F^-T N / s
  T s;                 ///< |F^-T N|
  T area_ratio;        ///< da/dA = J s
  Tensor<T> inverse;   ///< F^-1
  /// T = C^-1 - a a^T / s^2 with a = C^-1 N: the inverse of the surface metric, T N = 0.
  Tensor<T> metric;
};

/// `N` is a unit vector; F may be deformation_gradient(H). Does not check that det F > 0.
template <class T>
SurfaceFrame<T> surface_frame(const Tensor<T>& F, const std::array<T, 3>& N) {
  using std::sqrt;
  SurfaceFrame<T> f;
  const Tensor<T> cof = cofactor(F);
  const T J = determinant(F), one_over_J = T(1.0) / J;
  f.inverse = one_over_J * transpose(cof);
  std::array<T, 3> m;  // F^-T N
  for (std::size_t i = 0; i < 3; ++i)
    m[i] = f.inverse.a[0][i] * N[0] + f.inverse.a[1][i] * N[1] + f.inverse.a[2][i] * N[2];
  f.s = sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
  f.area_ratio = J * f.s;
  for (std::size_t i = 0; i < 3; ++i) f.n[i] = m[i] / f.s;
  // F^-1 (I - n n^T) F^-T, which is C^-1 - a a^T / s^2 because a / s = F^-1 n.
  std::array<T, 3> b;
  for (std::size_t K = 0; K < 3; ++K)
    b[K] = f.inverse.a[K][0] * f.n[0] + f.inverse.a[K][1] * f.n[1] + f.inverse.a[K][2] * f.n[2];
  const Tensor<T> C_inverse = f.inverse * transpose(f.inverse);
  f.metric = Tensor<T>::map([&](int K, int L) { return C_inverse(K, L) - at(b, K) * at(b, L); });
  return f;
}

/// n_i G_iKL, the only combination of the 27 numbers G[i](K, L) = x_i,KL that curvature needs.
template <class T>
Tensor<T> contract_normal(const std::array<T, 3>& n, const std::array<Tensor<T>, 3>& G) {
  return n[0] * G[0] + n[1] * G[1] + n[2] * G[2];
}

/// Twice the mean curvature, 2 kappa = -div n = T_KL (n_i G_iKL - N_K,L / s); -2/R on a sphere.
/// `nG` = n_i G_iKL, `grad_N` = N_K,L of any extension of N off the reference surface.
template <class T>
T twice_mean_curvature(const SurfaceFrame<T>& f, const Tensor<T>& nG, const Tensor<T>& grad_N) {
  return contract(f.metric, nG) - contract(f.metric, grad_N) / f.s;
}

/// grad_s n = P F^-T (sym(grad N)/s - n_i G_i) F^-1 P with P = I - n n^T. It is symmetric, and its
/// trace is -2 kappa. It is the new grad N of the surface after an update of the reference.
template <class T>
Tensor<T> normal_gradient(const SurfaceFrame<T>& f, const Tensor<T>& nG, const Tensor<T>& grad_N) {
  const Tensor<T> bending = Tensor<T>::map([&](int K, int L) {
    return T(0.5) * ((grad_N(K, L) + grad_N(L, K)) / f.s - nG(K, L) - nG(L, K));
  });
  const Tensor<T> P = Tensor<T>::map([&](int i, int j) {
    return i == j ? T(1.0) - at(f.n, i) * at(f.n, j) : -(at(f.n, i) * at(f.n, j));
  });
  const Tensor<T> A = f.inverse * P;
  return transpose(A) * bending * A;
}

/// Product of the principal curvatures from B = grad_s n: (tr^2 B - tr B^2) / 2.
template <class T>
T gauss_curvature(const Tensor<T>& B) {
  const T tr = trace(B);
  return T(0.5) * (tr * tr - contract(B, transpose(B)));
}

/// A matrix or vector in 3D. In 2D (plane strain) the 33 component becomes `diagonal`: 1 for F, 0
/// for grad N or G_i.
template <int D>
Tensor<Real> embed(const Mat<D>& x, Real diagonal) {
  return Tensor<Real>::map(
      [&](int i, int j) { return i < D && j < D ? x(i, j) : (i == j ? diagonal : 0.0); });
}
template <int D>
std::array<Real, 3> embed(const Vec<D>& x) {
  std::array<Real, 3> y{};
  for (int i = 0; i < D; ++i) at(y, i) = x[i];
  return y;
}

}  // namespace meniscus
