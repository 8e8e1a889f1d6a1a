// SPDX-License-Identifier: BSD-3-Clause
// A nodal cell whose quadrature points share a volume change.
#pragma once
#include "numbers/dual.hpp"
#include "numbers/elementary.hpp"
#include "numbers/tensor.hpp"

namespace meniscus {

/// Mean over the D + 1 quadrature points of a nodal cell, in all lanes. The points have equal
/// weights.
template <int D>
[[gnu::always_inline]] inline Lanes cell_mean(Lanes x) {
  if constexpr (D == 3)
    return 0.25 * sum(x);
  else
    return (1.0 / 3.0) * (x[0] + x[1] + x[2]);
}
template <int D>
[[gnu::always_inline]] inline Dual<Lanes> cell_mean(const Dual<Lanes>& x) {
  return {cell_mean<D>(x.v), cell_mean<D>(x.d)};
}

/// The kinematics at the points of a nodal cell (locking note 2). The law sees F* instead of F,
///
///   F* = s F,  s^3 = Jm / J,  Jm = J^own Js^(1 - own),
///
/// where Js is a volume change that the points share. With W(F*) as energy, P* = dW/dF(F*) and p =
/// P* : F* / 3 the stress is
///
///   P = s P* + (r - (1 - own) p / J) cof F.
///
/// r is the derivative of the energy by Js - 1, per volume: the mean of (1 - own) p / Js if no
/// other cell shares Js. If J is the same at all points and equal to Js, F* = F and P = P*. T is
/// Lanes or Dual<Lanes>.
template <class T>
struct AveragedCell {
  T J, shared_J;
  T stretch;       ///< s - 1, without cancellation near the reference state
  Tensor<T> seen;  ///< F* - I

  [[gnu::always_inline]] AveragedCell(const Tensor<T>& H, const T& J_less_1, const T& shared_less_1,
                                      Real own)
      : J(1.0 + J_less_1),
        shared_J(1.0 + shared_less_1),
        stretch(expm1(((1 - own) / 3) * log1p((shared_less_1 - J_less_1) / J))),
        seen(add_diagonal((1.0 + stretch) * H, stretch)) {}

  /// p for the stress P* of the law.
  [[gnu::always_inline]] T mean_stress(const Tensor<T>& law_stress) const {
    return (1.0 / 3.0) * (trace(law_stress) + contract(law_stress, seen));
  }
  /// P.
  [[gnu::always_inline]] Tensor<T> stress(const Tensor<T>& H, const Tensor<T>& law_stress,
                                          const T& p, Real own, const T& r) const {
    return (1.0 + stretch) * law_stress + (r - (1 - own) * p / J) * cofactor_of_deformation(H);
  }
};

}  // namespace meniscus
