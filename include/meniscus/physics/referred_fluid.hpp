// SPDX-License-Identifier: BSD-3-Clause
// A fluid at the stress points of a body that was referred anew (body/reference.hpp).
#pragma once
#include "meniscus/body/body.hpp"
#include "meniscus/physics/fluid_points.hpp"

#include <vector>

namespace meniscus {

/// F is the deformation since the new reference, in which a nodal cell has J_0 times its volume in
/// the reference of the scene. The law sees J = J_0 det F. Per volume of the new reference
///   W' = W(J) / J_0,  P' = dW/dJ cof F,
/// and the viscous stress, which depends on the present motion alone, is that of the law. The
/// surface encloses J_e = J_e0 times what it does relative to the new reference, J_e0 being the
/// mean of J_0.
template <int D, FluidLaw L, class E = Real>
class ReferredFluid : FluidPoints<D, L, E> {
  using Fluid = FluidPoints<D, L, E>;

 public:
  static constexpr bool viscous = L::viscous;
  using Fluid::inviscid;
  using Fluid::p_wave_modulus;
  using Fluid::viscous_stress;

  /// J_0 of the nodal cell, J_e0 of the body.
  ReferredFluid(const Fluid& fluid, Real cell_ratio, Real enclosed_ratio)
      : Fluid(fluid), cell_ratio_(cell_ratio), enclosed_ratio_(enclosed_ratio) {
    enclose(0);
  }

  void enclose(const E& theta) { Fluid::enclose(total(enclosed_ratio_, theta)); }
  ReferredFluid<D, L, Dual<Real>> about(const Dual<Real>& theta) const {
    ReferredFluid<D, L, Dual<Real>> same(Fluid::about(theta), cell_ratio_, enclosed_ratio_);
    same.enclose(theta);
    return same;
  }
  Lanes energy_density(const Tensor<Lanes>& H) const {
    return (1 / cell_ratio_) * this->energy(theta(H));
  }
  template <class T>
  [[gnu::always_inline]] Tensor<T> stress(const Tensor<T>& H) const {
    return this->slope(theta(H)) * cofactor_of_deformation(H);
  }
  template <class T>
  [[gnu::always_inline]] T pull_on_enclosed(const Tensor<T>& H) const {
    return (enclosed_ratio_ / cell_ratio_) * this->pull(theta(H));
  }
  Tensor<Lanes> local_stress(const Tensor<Lanes>& H) const {
    return this->law().mean_stress(theta(H)) * cofactor_of_deformation(H);
  }

 private:
  /// ratio (1 + theta) - 1
  template <class T>
  [[gnu::always_inline]] static T total(Real ratio, const T& theta) {
    return (ratio - 1) + ratio * theta;
  }
  template <class T>
  [[gnu::always_inline]] T theta(const Tensor<T>& H) const {
    return total(cell_ratio_, Fluid::theta(H));
  }

  Real cell_ratio_, enclosed_ratio_;
};

/// The fluids of all nodal cells of a body with a reference of its own; `points` has one for all,
/// or one each.
template <int D, FluidLaw L>
std::vector<ReferredFluid<D, L>> referred(const Body<D>& body,
                                          const std::vector<FluidPoints<D, L>>& points) {
  Real now = 0, before = 0;
  for (Index A = 0; A < body.size(); ++A) {
    now += body.cells.volume(A);
    before += body.cells.volume(A) / body.volume_ratio(A);
  }
  std::vector<ReferredFluid<D, L>> all;
  for (Index A = 0; A < body.size(); ++A)
    all.emplace_back(at(points, points.size() > 1 ? A : 0), body.volume_ratio(A), now / before);
  return all;
}

}  // namespace meniscus
