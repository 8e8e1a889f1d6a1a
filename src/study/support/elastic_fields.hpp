// SPDX-License-Identifier: BSD-3-Clause
// Displacements with exact derivatives for studies of elasticity.
#pragma once
#include "body/shapes/smooth_map.hpp"

#include <array>

namespace meniscus::study {

/// u_i = sum over k of a_ik X_k, plus b_ikl X_k X_l if quadratic. All coefficients differ.
template <int D>
SmoothMap<D> polynomial_field(bool quadratic) {
  return smooth_map<D>([quadratic](const std::array<Jet<D>, D>& X) {
    std::array<Jet<D>, D> u = X;
    for (int i = 0; i < D; ++i) {
      at(u, i) = Jet<D>(0);
      for (int k = 0; k < D; ++k) {
        at(u, i) = at(u, i) + std::sin(1.0 + 3 * i + k) * at(X, k);
        for (int l = k; quadratic && l < D; ++l)
          at(u, i) = at(u, i) + std::cos(2.0 + 5 * i + 2 * (k + l) + k * l) * at(X, k) * at(X, l);
      }
    }
    return u;
  });
}

/// A field with about half a wave over the body, without symmetry.
template <int D>
SmoothMap<D> smooth_field() {
  return smooth_map<D>([](const std::array<Jet<D>, D>& X) {
    std::array<Jet<D>, D> u = X;
    u[0] = sin(3.0 * X[0] + 0.3) * cos(2.2 * X[1] - 0.4);
    u[1] = cos(2.4 * X[0] + 0.7) * sin(2.8 * X[1] + 0.2);
    if constexpr (D == 3) {
      u[0] = u[0] * cos(1.9 * X[2]);
      u[1] = u[1] * sin(2.1 * X[2] + 0.9);
      u[2] = sin(2.5 * X[0] + 1.1) * sin(1.8 * X[1] + 0.5) * cos(2.6 * X[2] - 0.3);
    }
    return u;
  });
}

/// A divergence-free field: in 2D the curl of sin(3 x + 0.3) sin(2.4 y + 0.5).
template <int D>
SmoothMap<D> divergence_free_field() {
  return smooth_map<D>([](const std::array<Jet<D>, D>& X) {
    std::array<Jet<D>, D> u = X;
    if constexpr (D == 2) {
      u[0] = 2.4 * sin(3.0 * X[0] + 0.3) * cos(2.4 * X[1] + 0.5);
      u[1] = -3.0 * cos(3.0 * X[0] + 0.3) * sin(2.4 * X[1] + 0.5);
    } else {
      u[0] = sin(2.6 * X[1] + 0.3) * cos(2.1 * X[2]);
      u[1] = sin(2.3 * X[2] + 0.5) * cos(1.9 * X[0]);
      u[2] = sin(2.2 * X[0]) * cos(2.7 * X[1] + 0.1);
    }
    return u;
  });
}

}  // namespace meniscus::study
