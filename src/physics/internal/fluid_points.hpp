// SPDX-License-Identifier: BSD-3-Clause
// A fluid at the quadrature points of a group. Its pressure can work on the volume that the surface
// encloses (static-drop note 3), and on one volume change per nodal cell.
#pragma once
#include "physics/internal/averaged_cell.hpp"
#include "physics/internal/law.hpp"

#include <cmath>

namespace meniscus {

/// A law whose energy depends on J only: W = U(J) with U'' = kappa J^(m - 2) and kappa =
/// p_wave_modulus().
template <class L>
concept FluidLaw = Law<L> && requires(const L law, const Lanes theta) {
  { law.volumetric_energy(theta) } -> std::same_as<Lanes>;  ///< U(1 + theta)
  { law.mean_stress(theta) } -> std::same_as<Lanes>;        ///< U'(1 + theta)
  { law.volumetric_degree() } -> std::same_as<Real>;        ///< m
  { law.viscosity } -> std::convertible_to<Real>;
};

/// The energy of the points of a body, whose surface encloses J_e times its reference volume, is
///
///   sum w W,  W = [U(J) - U(J_e) - U'(J_e) (J - J_e)] + U(J_e).
///
/// The bracket, a Bregman distance, is never negative; it vanishes with its gradient at J = J_e. If
/// the pressure is uniform, the only force is that on the surface. The derivatives are
///
///   dW/dJ = U'(J) - U'(J_e),   dW/dJ_e = U'(J_e) - U''(J_e) (J - J_e).
///
/// As U'' is a power of J, the bracket is J_e^m U(1 + r) and dW/dJ = J_e^(m-1) U'(1 + r) with r =
/// (J - J_e)/J_e, which does not cancel. At the start J_e = 1 and W = U(J).
///
/// If `averaged`, J is the mean over the D + 1 points of a nodal cell. The viscous stress is
/// computed at each point.
///
/// J_e has the scalar type E, Real or Dual<Real>; functions of H use Lanes or Dual<Lanes>.
template <int D, FluidLaw L, class E = Real>
class FluidPoints {
 public:
  static constexpr bool viscous = L::viscous;

  FluidPoints(const L& law, bool averaged) : law_(law), averaged_(averaged) { enclose(0); }

  void enclose(const E& theta) {
    using std::pow;
    enclosed_ = theta;
    per_enclosed_ = 1.0 / (1.0 + theta);
    scale_ = pow(1.0 + theta, law_.volumetric_degree() - 1);
    enclosed_stress_ = law_.mean_stress(theta);
  }
  FluidPoints<D, L, Dual<Real>> about(const Dual<Real>& theta) const {
    FluidPoints<D, L, Dual<Real>> same(law_, averaged_);
    same.enclose(theta);
    return same;
  }

  Lanes energy_density(const Tensor<Lanes>& H) const { return energy(theta(H)); }
  template <class T>
  [[gnu::always_inline]] Tensor<T> stress(const Tensor<T>& H) const {
    return slope(theta(H)) * cofactor_of_deformation(H);
  }
  template <class T>
  [[gnu::always_inline]] T pull_on_enclosed(const Tensor<T>& H) const {
    return pull(theta(H));
  }
  Tensor<Lanes> local_stress(const Tensor<Lanes>& H) const {
    return law_.mean_stress(theta(H)) * cofactor_of_deformation(H);
  }
  template <class T>
  [[gnu::always_inline]] Tensor<T> viscous_stress(
      const Tensor<T>& H, const Tensor<T>& F_rate) const requires ViscousLaw<L> {
    return law_.viscous_stress(H, F_rate);
  }
  Real p_wave_modulus() const { return law_.p_wave_modulus(); }
  bool inviscid() const requires ViscousLaw<L> { return law_.inviscid(); }

 protected:
  /// J - 1.
  template <class T>
  [[gnu::always_inline]] T theta(const Tensor<T>& H) const {
    const T each = volume_change(H);
    return averaged_ ? cell_mean<D>(each) : each;
  }
  /// W as a function of J - 1; slope() and pull() below are dW/dJ and dW/dJ_e.
  Lanes energy(Lanes theta) const {
    return (1 + enclosed_) * scale_ * law_.volumetric_energy(excess(theta)) +
           law_.volumetric_energy(Lanes(enclosed_));
  }
  template <class T>
  [[gnu::always_inline]] T slope(const T& theta) const {
    return scale_ * law_.mean_stress(excess(theta));
  }
  template <class T>
  [[gnu::always_inline]] T pull(const T& theta) const {
    return enclosed_stress_ - scale_ * law_.p_wave_modulus() * excess(theta);
  }
  const L& law() const { return law_; }

 private:
  /// r = (J - J_e)/J_e.
  template <class T>
  [[gnu::always_inline]] T excess(const T& theta) const {
    return per_enclosed_ * (theta - enclosed_);
  }

  L law_;
  bool averaged_;
  E enclosed_, per_enclosed_, scale_;  // J_e - 1, 1/J_e, J_e^(m-1)
  E enclosed_stress_;                  // U'(J_e)
};

}  // namespace meniscus
