// SPDX-License-Identifier: BSD-3-Clause
// State, energy and heat of branches of Maxwell.
#include "physics/internal/maxwell_branches.hpp"

#include <fmt/core.h>

namespace meniscus {
namespace {

/// tr C' - 3 for H = F - I, without its parts of first order, which cancel (as in yeoh.cpp).
Lanes isochoric_stretch(const Tensor<Lanes>& H) {
  const Lanes change = volume_change(H), x = (-2.0 / 3.0) * log1p(change);
  return 2.0 * (0.5 * contract(H, H) - higher_volume_change(H) - log1p_remainder(change)) +
         3.0 * exp_remainder(x) + 2.0 * trace(green_strain(H)) * expm1(x);
}

/// C' - I for H = F - I.
Tensor<Lanes> isochoric_strain(const Tensor<Lanes>& H) {
  const Lanes s = expm1((-2.0 / 3.0) * log1p(volume_change(H)));
  return add_diagonal((2.0 * (1.0 + s)) * green_strain(H), s);
}

}  // namespace

MaxwellPoints::AllWeights MaxwellPoints::weights(Real time) const {
  AllWeights all{};
  for (std::size_t b = 0; b < branches_.size(); ++b) {
    const Real x = std::max(time - time_, 0.0) / branches_[b].time;
    const Real kept = std::exp(-x), mean = x > 0 ? -std::expm1(-x) / x : 1;
    all[b] = {kept, mean - kept, 1 - mean};
  }
  return all;
}

Tensor<Lanes> MaxwellPoints::state(std::size_t branch, Index group, const Weights& w,
                                   const Tensor<Lanes>& relaxed) const {
  return Lanes(w.kept) * states_[branch][group] + Lanes(w.before) * last_[group] +
         Lanes(w.now) * relaxed;
}

Lanes MaxwellPoints::potential_density(Index group, const AllWeights& w,
                                       const Tensor<Lanes>& H) const {
  Real m;
  const Tensor<Lanes> N = memory(group, w, m);
  return 0.5 * (m * isochoric_stretch(H) + contract(N, isochoric_strain(H)));
}

Lanes MaxwellPoints::energy_density(Index group, const AllWeights& w,
                                    const Tensor<Lanes>& H) const {
  const Tensor<Lanes> relaxed = relaxed_state(H), strain = isochoric_strain(H);
  const Lanes stretch = isochoric_stretch(H);
  Lanes sum = Lanes::zero();
  for (std::size_t b = 0; b < branches_.size(); ++b) {
    const Tensor<Lanes> a = state(b, group, w[b], relaxed);
    // tr a - ln det A, whose parts of first order cancel each other
    const Lanes rest = -higher_volume_change(a) - log1p_remainder(volume_change(a));
    sum += (0.5 * branches_[b].modulus) * (stretch + contract(a, strain) + rest);
  }
  return sum;
}

Lanes MaxwellPoints::heat_density(Index group, const AllWeights& w, const Tensor<Lanes>& H) const {
  const Tensor<Lanes> relaxed = relaxed_state(H), strain = isochoric_strain(H);
  Lanes sum = Lanes::zero();
  for (std::size_t b = 0; b < branches_.size(); ++b) {
    // With D = A - C'^-1, A : C' + A^-1 : C'^-1 - 6 = tr (D C' D A^-1), which is quadratic in D.
    const Tensor<Lanes> a = state(b, group, w[b], relaxed), D = a - relaxed;
    const Tensor<Lanes> inverse = (1.0 / (1.0 + volume_change(a))) * cofactor_of_deformation(a);
    sum += (0.5 * branches_[b].modulus / branches_[b].time) *
           contract(D + D * strain, transpose(D * inverse));
  }
  return sum;
}

Lanes MaxwellPoints::stress_scale(Index group, const Tensor<Lanes>& H) const {
  const Tensor<Lanes> P = stress(group, weights(time_), H);
  return max(sqrt(contract(P, P)), Lanes(1e-9 * stiffness_));
}

void MaxwellPoints::accept(Index group, const AllWeights& w, const Tensor<Lanes>& H) {
  const Tensor<Lanes> relaxed = relaxed_state(H);
  for (std::size_t b = 0; b < branches_.size(); ++b)
    states_[b].set(group, state(b, group, w[b], relaxed));
  last_.set(group, relaxed);
}

void MaxwellPoints::archive(const Archive& a) {
  a("time", time_, dimension::time);
  last_.archive(a, "relaxed");
  for (std::size_t b = 0; b < states_.size(); ++b)
    states_[b].archive(a, fmt::format("branch {}", b));
}

}  // namespace meniscus
