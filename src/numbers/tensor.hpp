// SPDX-License-Identifier: BSD-3-Clause
// A 3x3 tensor of any scalar: double in tests and output, four quadrature points at once in the
// time loop, complex for the complex-step derivative. Material laws use it always in 3D (2D is
// plane strain: F33 = 1), so that traces and deviators are right in 2D too.
//
// All functions are always_inline: g++ keeps some of them as calls in a large stress function. The
// function then takes twice as long, since each call loses registers and common subexpressions.
#pragma once
#include "numbers/types.hpp"

namespace meniscus {

/// Components a[i][j] of a 3x3 tensor, by rows.
template <class T>
struct Tensor {
  T a[3][3];

  T& operator()(int i, int j) { return a[i][j]; }
  const T& operator()(int i, int j) const { return a[i][j]; }

  static Tensor zero() { return diagonal(T(0.0)); }
  static Tensor identity() { return diagonal(T(1.0)); }
  static Tensor diagonal(T d) {
    const T o(0.0);
    return {{{d, o, o}, {o, d, o}, {o, o, d}}};
  }

  [[gnu::always_inline]] friend Tensor operator+(const Tensor& x, const Tensor& y) {
    return map([&](int i, int j) { return x(i, j) + y(i, j); });
  }
  [[gnu::always_inline]] friend Tensor operator-(const Tensor& x, const Tensor& y) {
    return map([&](int i, int j) { return x(i, j) - y(i, j); });
  }
  [[gnu::always_inline]] friend Tensor operator*(const T& s, const Tensor& x) {
    return map([&](int i, int j) { return s * x(i, j); });
  }
  [[gnu::always_inline]] friend Tensor operator*(const Tensor& x, const Tensor& y) {
    return map(
        [&](int i, int j) { return x(i, 0) * y(0, j) + x(i, 1) * y(1, j) + x(i, 2) * y(2, j); });
  }

  /// The tensor whose components are f(i, j).
  template <class F>
  [[gnu::always_inline]] static Tensor map(F&& f) {
    Tensor t;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) t.a[i][j] = f(i, j);
    return t;
  }
};

template <class T>
[[gnu::always_inline]] inline Tensor<T> transpose(const Tensor<T>& x) {
  return Tensor<T>::map([&](int i, int j) { return x(j, i); });
}

template <class T>
[[gnu::always_inline]] inline T trace(const Tensor<T>& x) {
  return x(0, 0) + x(1, 1) + x(2, 2);
}

/// Double contraction x:y = x_ij y_ij.
template <class T>
[[gnu::always_inline]] inline T contract(const Tensor<T>& x, const Tensor<T>& y) {
  T s = x(0, 0) * y(0, 0);
  for (int k = 1; k < 9; ++k) s = s + x(k / 3, k % 3) * y(k / 3, k % 3);
  return s;
}

/// cof x = det(x) x^-T.
template <class T>
[[gnu::always_inline]] inline Tensor<T> cofactor(const Tensor<T>& x) {
  return Tensor<T>::map([&](int i, int j) {
    const int p = (i + 1) % 3, q = (i + 2) % 3, r = (j + 1) % 3, s = (j + 2) % 3;
    return x(p, r) * x(q, s) - x(p, s) * x(q, r);
  });
}

template <class T>
[[gnu::always_inline]] inline T determinant(const Tensor<T>& x) {
  return x(0, 0) * (x(1, 1) * x(2, 2) - x(1, 2) * x(2, 1)) +
         x(0, 1) * (x(1, 2) * x(2, 0) - x(1, 0) * x(2, 2)) +
         x(0, 2) * (x(1, 0) * x(2, 1) - x(1, 1) * x(2, 0));
}

/// x + s I.
template <class T>
[[gnu::always_inline]] inline Tensor<T> add_diagonal(Tensor<T> x, const T& s) {
  for (int i = 0; i < 3; ++i) x(i, i) = x(i, i) + s;
  return x;
}

/// F = I + H.
template <class T>
[[gnu::always_inline]] inline Tensor<T> deformation_gradient(const Tensor<T>& H) {
  return add_diagonal(H, T(1.0));
}

/// J - 1 - tr H = (tr^2 H - tr H^2)/2 + det H for H = F - I: the volume change beyond first order.
template <class T>
[[gnu::always_inline]] inline T higher_volume_change(const Tensor<T>& H) {
  const T second = H(0, 0) * H(1, 1) - H(0, 1) * H(1, 0) + H(1, 1) * H(2, 2) - H(1, 2) * H(2, 1) +
                   H(2, 2) * H(0, 0) - H(2, 0) * H(0, 2);
  return second + determinant(H);
}

/// J - 1 from H = F - I without cancellation.
template <class T>
[[gnu::always_inline]] inline T volume_change(const Tensor<T>& H) {
  return trace(H) + higher_volume_change(H);
}

/// cof F = J F^-T from H = F - I: (1 + tr H) I - H^T + cof H.
template <class T>
[[gnu::always_inline]] inline Tensor<T> cofactor_of_deformation(const Tensor<T>& H) {
  return add_diagonal(cofactor(H) - transpose(H), 1.0 + trace(H));
}

/// E = (H + H^T + H^T H)/2, the Green strain for H = F - I, accurate near the identity.
template <class T>
[[gnu::always_inline]] inline Tensor<T> green_strain(const Tensor<T>& H) {
  const Tensor<T> HtH = transpose(H) * H;
  return Tensor<T>::map([&](int i, int j) { return T(0.5) * (H(i, j) + H(j, i) + HtH(i, j)); });
}

}  // namespace meniscus
