// SPDX-License-Identifier: BSD-3-Clause
// A fluid at the quadrature points of a body after an update of its reference (body/reference.hpp).
#pragma once
#include "body/body.hpp"
#include "physics/internal/fluid_points.hpp"

#include <vector>

namespace meniscus {

/// The fluid after the update. F is the deformation from the new reference, in which a nodal cell
/// has J_0 times its volume in the reference of the scene. The law is evaluated at J = J_0 det F.
/// Per volume of the new reference,
///
///   W' = W(J) / J_0,  P' = dW/dJ cof F.
///
/// The viscous stress does not change, since it depends on the current motion only. The surface
/// encloses J_e0 times its volume ratio to the new reference, where J_e0 is the mean of J_0.
template <int D, FluidLaw L, class E = Real>
class ReferredFluid : FluidPoints<D, L, E> {
  using Fluid = FluidPoints<D, L, E>;

 public:
  static constexpr bool viscous = L::viscous;
  using Fluid::inviscid;
  using Fluid::p_wave_modulus;
  using Fluid::viscous_stress;

  /// `cell_ratio`: J_0 of the nodal cell; `enclosed_ratio`: J_e0 of the body.
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

/// The fluids of all nodal cells of a body with an updated reference. `points` has one fluid for
/// all cells, or one for each.
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
