// SPDX-License-Identifier: BSD-3-Clause
// Dual numbers: a value and its derivative along one direction. A function template evaluated with
// dual numbers returns its exact derivative.
#pragma once
#include "numbers/elementary.hpp"
#include "numbers/tensor.hpp"

#include <type_traits>

namespace meniscus {

/// v + d e with e^2 = 0, over Real or Lanes.
template <class T>
struct Dual {
  T v;  ///< value
  T d;  ///< derivative

  Dual() = default;
  Dual(Real value) : v(value), d(0.0) {}
  Dual(Lanes value) requires std::is_same_v<T, Lanes> : v(value), d(0.0) {}
  template <class S>
  Dual(const Dual<S>& all) requires(std::is_same_v<T, Lanes>&& std::is_same_v<S, Real>)
      : v(all.v), d(all.d) {}
  Dual(T value, T derivative) : v(value), d(derivative) {}

  Dual operator-() const { return {-v, -d}; }
  Dual& operator+=(const Dual& b) { return *this = *this + b; }

  friend Dual operator+(const Dual& a, const Dual& b) { return {a.v + b.v, a.d + b.d}; }
  friend Dual operator-(const Dual& a, const Dual& b) { return {a.v - b.v, a.d - b.d}; }
  friend Dual operator*(const Dual& a, const Dual& b) { return {a.v * b.v, a.v * b.d + a.d * b.v}; }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const T quotient = a.v / b.v;
    return {quotient, (a.d - quotient * b.d) / b.v};
  }
  friend Dual operator+(const Dual& a, Real b) { return {a.v + b, a.d}; }
  friend Dual operator+(Real a, const Dual& b) { return {a + b.v, b.d}; }
  friend Dual operator-(const Dual& a, Real b) { return {a.v - b, a.d}; }
  friend Dual operator-(Real a, const Dual& b) { return {a - b.v, -b.d}; }
  friend Dual operator*(const Dual& a, Real b) { return {a.v * b, a.d * b}; }
  friend Dual operator*(Real a, const Dual& b) { return {a * b.v, a * b.d}; }
  friend Dual operator/(const Dual& a, Real b) { return {a.v / b, a.d / b}; }
  friend Dual operator/(Real a, const Dual& b) {
    const T quotient = a / b.v;
    return {quotient, -quotient * b.d / b.v};
  }
};

template <class T>
Dual<T> sqrt(const Dual<T>& x) {
  using std::sqrt;
  const T root = sqrt(x.v);
  return {root, 0.5 * x.d / root};
}
template <class T>
Dual<T> log1p(const Dual<T>& x) {
  return {log1p(x.v), x.d / (1.0 + x.v)};
}
template <class T>
Dual<T> log1p_remainder(const Dual<T>& x) {
  return {log1p_remainder(x.v), -x.v * x.d / (1.0 + x.v)};
}
template <class T>
Dual<T> expm1(const Dual<T>& x) {
  const T e = expm1(x.v);
  return {e, (1.0 + e) * x.d};
}
template <class T>
Dual<T> exp_remainder(const Dual<T>& x) {
  return {exp_remainder(x.v), expm1(x.v) * x.d};
}
inline Dual<Real> pow(const Dual<Real>& x, Real power) {
  return {std::pow(x.v, power), power * std::pow(x.v, power - 1) * x.d};
}

inline Dual<Lanes> select(Lanes::Mask mask, const Dual<Lanes>& yes, const Dual<Lanes>& no) {
  return {select(mask, yes.v, no.v), select(mask, yes.d, no.d)};
}
/// Sum of the four lanes, in a fixed order.
inline Dual<Real> sum(const Dual<Lanes>& a) {
  return {sum(a.v), sum(a.d)};
}

/// The value without the derivative, which comparisons use.
inline Lanes value(Lanes x) {
  return x;
}
inline Lanes value(const Dual<Lanes>& x) {
  return x.v;
}

/// x + dx e
template <class T>
Tensor<Dual<T>> dual(const Tensor<T>& x, const Tensor<T>& dx) {
  return Tensor<Dual<T>>::map([&](int i, int j) { return Dual<T>(x(i, j), dx(i, j)); });
}
template <class T>
Tensor<T> derivative(const Tensor<Dual<T>>& x) {
  return Tensor<T>::map([&](int i, int j) { return x(i, j).d; });
}

}  // namespace meniscus
