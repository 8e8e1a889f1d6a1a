// SPDX-License-Identifier: BSD-3-Clause
// Branches of Maxwell: springs in series with dampers, beside the elastic stress of a body
// (viscoelasticity note 1).
#pragma once
#include "numbers/elementary.hpp"
#include "numbers/tensor.hpp"
#include "physics/internal/point_laws.hpp"
#include "state/point_state.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace meniscus {

/// A spring with a shear modulus in series with a damper. A stress relaxes with `time`.
struct MaxwellBranch {
  Real modulus, time;
};

/// The inverse of the isochoric right Cauchy-Green tensor, less I: J^(2/3) C^-1 - I, for H = F - I.
inline Tensor<Lanes> relaxed_state(const Tensor<Lanes>& H) {
  const Lanes change = volume_change(H), grown = expm1((2.0 / 3.0) * log1p(change));
  const Tensor<Lanes> G = (1.0 / (1.0 + change)) * cofactor_of_deformation(H);  // F^-T
  const Tensor<Lanes> inverse = transpose(G) * G;
  return add_diagonal((-2.0 * (1.0 + grown)) * (green_strain(H) * inverse), grown);
}

/// The branches at the points of a body. Branch b has the tensor A_b at each point, with
///
///   energy  mu_b/2 (A_b : C' - 3 - ln det A_b),   C' = J^(-2/3) C,
///   rate    dA_b/dt = (C'^-1 - A_b)/time_b.
///
/// A_b = I at first. Within a step C'^-1 is taken as linear in time, which gives A_b exactly. The
/// part of A_b from the end of the step is a multiple of C'^-1, whose stress is a pressure that the
/// isochoric projection removes. So the stress at the end is that of a hyperelastic law in which a
/// tensor M is known.
class MaxwellPoints final : public PointLaws {
 public:
  static constexpr std::size_t most_branches = 16;

  MaxwellPoints(std::vector<MaxwellBranch> branches, Index groups, const Division& division)
      : branches_(std::move(branches)), last_(groups, division) {
    for (const MaxwellBranch& branch : branches_) stiffness_ += branch.modulus;
    states_.assign(branches_.size(), PointTensors(groups, division));
  }

  /// How the state of a branch at the end of a step is composed: A - I = kept (A - I of the last
  /// step) + before (C'^-1 - I of the last step) + now (C'^-1 - I).
  struct Weights {
    Real kept, before, now;
  };
  using AllWeights = std::array<Weights, most_branches>;
  /// The weights of all branches for a step from the last accepted one to `time`.
  AllWeights weights(Real time) const;

  /// First Piola stress at H, with the weights of the present time.
  template <class T>
  [[gnu::always_inline]] Tensor<T> stress(Index group, const AllWeights& w,
                                          const Tensor<T>& H) const {
    Real m;
    const Tensor<Lanes> N = memory(group, w, m);
    const Tensor<T> of_memory = Tensor<T>::map([&](int i, int j) { return T(N(i, j)); });
    const T change = volume_change(H), J = 1.0 + change;
    const T shrunk = 1.0 + expm1((-2.0 / 3.0) * log1p(change));
    const Tensor<T> E = green_strain(H);
    const T strain = (2.0 / 3.0) * trace(E);
    // m (F - (1 + strain) F^-T), without a difference of large numbers near the reference state.
    const T a = m * (1.0 + strain) / J;
    const T diagonal = (m / J) * (higher_volume_change(H) - strain * (1.0 + trace(H)));
    const Tensor<T> isotropic = add_diagonal(T(m) * H + a * (transpose(H) - cofactor(H)), diagonal);
    const T contracted = (1.0 / 3.0) * (trace(of_memory) + 2.0 * contract(of_memory, E)) / J;
    return shrunk *
           (isotropic + of_memory + H * of_memory - contracted * cofactor_of_deformation(H));
  }
  /// The function of which stress() is the gradient, per reference volume; 0 at H = 0.
  Lanes potential_density(Index group, const AllWeights& w, const Tensor<Lanes>& H) const;
  /// Power that turns into heat, per reference volume:
  /// sum mu/(2 time) (A : C' + A^-1 : C'^-1 - 6).
  Lanes heat_density(Index group, const AllWeights& w, const Tensor<Lanes>& H) const;
  Lanes energy_density(Index group, const AllWeights& w, const Tensor<Lanes>& H) const;

  /// Accepts the step: the state of a group becomes that at H.
  void accept(Index group, const AllWeights& w, const Tensor<Lanes>& H);
  /// Ends the acceptance of all groups.
  void accept_time(Real time) { time_ = time; }
  Real time() const { return time_; }
  void archive(const Archive& a);

  std::unique_ptr<PointLaws> about(Real) const override {
    throw std::logic_error("branches do not depend on an enclosed volume");
  }
  Lanes energy_density(Index group, Real time, const Tensor<Lanes>& H) const override {
    return energy_density(group, weights(time), H);
  }
  Tensor<Lanes> stress(Index group, Real time, const Tensor<Lanes>& H) const override {
    return stress(group, weights(time), H);
  }
  StressChange tangent(Index group, Real time, const DualDeformation& x) const override {
    return {stress(group, weights(time), x.H), Dual<Lanes>(0.0)};
  }
  std::array<Tensor<Lanes>, 3> viscosity(Index, Real, const Tensor<Lanes>&) const override {
    return {Tensor<Lanes>::zero(), Tensor<Lanes>::zero(), Tensor<Lanes>::zero()};
  }
  Lanes stress_scale(Index group, const Tensor<Lanes>& H) const override;
  bool warns() const override { return false; }
  std::optional<std::string> warning(Index, Real, const Tensor<Real>&) const override { return {}; }
  /// The stress changes for ever.
  Real steady_after() const override { return std::numeric_limits<Real>::infinity(); }
  std::size_t bytes() const override { return (1 + states_.size()) * last_.bytes(); }

 private:
  /// A - I of a branch.
  Tensor<Lanes> state(std::size_t branch, Index group, const Weights& w,
                      const Tensor<Lanes>& relaxed) const;
  /// M = m I + N, the sum of mu (A - now C'^-1) over the branches. Returns N.
  [[gnu::always_inline]] Tensor<Lanes> memory(Index group, const AllWeights& w, Real& m) const {
    m = 0;
    Real of_last = 0;
    Tensor<Lanes> N = Tensor<Lanes>::zero();
    for (std::size_t b = 0; b < branches_.size(); ++b) {
      const Real mu = branches_[b].modulus;
      m += mu * (1 - w[b].now);
      of_last += mu * w[b].before;
      N = N + Lanes(mu * w[b].kept) * states_[b][group];
    }
    return N + Lanes(of_last) * last_[group];
  }

  std::vector<MaxwellBranch> branches_;
  Real stiffness_ = 0;                // sum of the moduli
  Real time_ = 0;                     // of the last accepted step
  PointTensors last_;                 // C'^-1 - I there
  std::vector<PointTensors> states_;  // [branch] A - I there
};

}  // namespace meniscus
