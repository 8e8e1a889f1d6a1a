// SPDX-License-Identifier: BSD-3-Clause
// Jets: numbers with exact first and second derivatives with respect to the position.
#pragma once
#include "numbers/types.hpp"

#include <cmath>

namespace meniscus {

/// A number with its gradient and Hessian with respect to X. A formula written with jets returns
/// exact derivatives.
template <int D>
struct Jet {
  Real value;
  Vec<D> gradient = Vec<D>::Zero();
  Mat<D> hessian = Mat<D>::Zero();

  Jet(Real constant) : value(constant) {}
  Jet(Real v, const Vec<D>& g, const Mat<D>& h) : value(v), gradient(g), hessian(h) {}
  /// The coordinate X_k itself.
  static Jet variable(const Vec<D>& X, int k) { return {X[k], Vec<D>::Unit(k), Mat<D>::Zero()}; }

  /// f(*this) for a function f with value f, derivative `slope` and second derivative `second`.
  Jet chain(Real f, Real slope, Real second) const {
    return {f, slope * gradient, slope * hessian + second * gradient * gradient.transpose()};
  }
  friend Jet operator+(const Jet& a, const Jet& b) {
    return {a.value + b.value, a.gradient + b.gradient, a.hessian + b.hessian};
  }
  friend Jet operator-(const Jet& a, const Jet& b) {
    return {a.value - b.value, a.gradient - b.gradient, a.hessian - b.hessian};
  }
  friend Jet operator*(const Jet& a, const Jet& b) {
    return {a.value * b.value, a.value * b.gradient + b.value * a.gradient,
            a.value * b.hessian + b.value * a.hessian + a.gradient * b.gradient.transpose() +
                b.gradient * a.gradient.transpose()};
  }
  friend Jet operator/(const Jet& a, const Jet& b) {
    return a * b.chain(1 / b.value, -1 / (b.value * b.value), 2 / (b.value * b.value * b.value));
  }
  friend Jet sin(const Jet& a) {
    return a.chain(std::sin(a.value), std::cos(a.value), -std::sin(a.value));
  }
  friend Jet cos(const Jet& a) {
    return a.chain(std::cos(a.value), -std::sin(a.value), -std::cos(a.value));
  }
};

/// f(a, b) for a function with value f, derivatives f_a and f_b and second derivatives f_aa, f_ab
/// and f_bb.
template <int D>
Jet<D> chain(const Jet<D>& a, const Jet<D>& b, Real f, Real f_a, Real f_b, Real f_aa, Real f_ab,
             Real f_bb) {
  const Mat<D> mixed = a.gradient * b.gradient.transpose();
  return {f, f_a * a.gradient + f_b * b.gradient,
          f_a * a.hessian + f_b * b.hessian + f_aa * a.gradient * a.gradient.transpose() +
              f_ab * (mixed + mixed.transpose()) + f_bb * b.gradient * b.gradient.transpose()};
}

}  // namespace meniscus
