// SPDX-License-Identifier: BSD-3-Clause
// The selective form of the q_scni integration, with one volume change per nodal cell. It keeps
// nearly incompressible solids from locking (RKPM note 5.4).
#pragma once
#include "numbers/dual.hpp"
#include "physics/internal/law.hpp"

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
Dual<Lanes> cell_mean(const Dual<Lanes>& x) {
  return {cell_mean<D>(x.v), cell_mean<D>(x.d)};
}

/// Applies a law to the D + 1 quadrature points of a nodal cell together. Each point has its own
/// deformation gradient, scaled to the mean volume change of the cell:
///
///   F* = s F,  s^3 = Jm / J,  Jm = mean of J over the points (current / reference volume).
///
/// The energy of the cell is the sum of w W(F*), and the stress is its exact gradient. With P* =
/// dW/dF(F*) and p = P* : F* / 3,
///
///   P = s P* + (mean p / Jm - p / J) cof F.
///
/// The viscous stress uses F itself. In linear elasticity this averages the dilatation and keeps
/// the deviator of each point. If J is constant in a cell, the energy is the energy of the law.
template <int D, Law L>
class CellAverage {
 public:
  static constexpr bool viscous = L::viscous;

  explicit CellAverage(const L& law) : law_(law) {}

  Lanes energy_density(const Tensor<Lanes>& H) const {
    const Lanes theta = volume_change(H), mean_theta = mean(theta);
    return law_.energy_density(scaled(H, stretch(theta, mean_theta)));
  }

  /// T is Lanes or Dual<Lanes> in this class.
  template <class T>
  [[gnu::always_inline]] Tensor<T> stress(const Tensor<T>& H) const {
    const T theta = volume_change(H), mean_theta = mean(theta);
    const T s = stretch(theta, mean_theta);
    const Tensor<T> H_star = scaled(H, s), P = law_.stress(H_star);
    const T p = (1.0 / 3.0) * (trace(P) + contract(P, H_star));
    const T excess = mean(p) / (1.0 + mean_theta) - p / (1.0 + theta);
    return (1.0 + s) * P + excess * cofactor_of_deformation(H);
  }

  template <class T>
  [[gnu::always_inline]] Tensor<T> viscous_stress(
      const Tensor<T>& H, const Tensor<T>& F_rate) const requires ViscousLaw<L> {
    return law_.viscous_stress(H, F_rate);
  }

  std::optional<std::string> warning(const Tensor<Real>& H) const requires WarningLaw<L> {
    return law_.warning(H);
  }

  Real p_wave_modulus() const { return law_.p_wave_modulus(); }
  bool inviscid() const requires ViscousLaw<L> { return law_.inviscid(); }

  CellAverage at_time(Real t) const requires RampedLaw<L> { return CellAverage(law_.at_time(t)); }
  Lanes energy_rate(const Tensor<Lanes>& H) const requires RampedLaw<L> {
    const Lanes theta = volume_change(H);
    return law_.energy_rate(scaled(H, stretch(theta, mean(theta))));
  }
  Real steady_after() const requires RampedLaw<L> { return law_.steady_after(); }

 private:
  template <class T>
  [[gnu::always_inline]] static T mean(const T& x) {
    return cell_mean<D>(x);
  }
  /// s - 1 from J - 1 and Jm - 1, without cancellation near the reference state.
  template <class T>
  [[gnu::always_inline]] static T stretch(const T& theta, const T& mean_theta) {
    return expm1((1.0 / 3.0) * log1p((mean_theta - theta) / (1.0 + theta)));
  }
  /// F* - I = (1 + s) H + s I, here with s - 1 as argument.
  template <class T>
  [[gnu::always_inline]] static Tensor<T> scaled(const Tensor<T>& H, const T& s) {
    return add_diagonal((1.0 + s) * H, s);
  }

  L law_;
};

}  // namespace meniscus
