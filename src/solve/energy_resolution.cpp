// SPDX-License-Identifier: BSD-3-Clause
// The step that resolves the exchange of energy.
#include "meniscus/solve/energy_resolution.hpp"

#include "meniscus/core/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace meniscus {
namespace {

/// Bounds what is left of the error of the balance, of the energy in motion: no hard case of a
/// default scene then exceeds 1e-2 (study hard).
constexpr Real eta = 5e-3;

/// Kinetic energy, and S = sum f^2/m.
struct Sums {
  Real kinetic = 0, S = 0;
  friend Sums operator+(const Sums& a, const Sums& b) { return {a.kinetic + b.kinetic, a.S + b.S}; }
};

Sums sums(const NodalVectors& v, const NodalVectors& f, const std::vector<Real>& mass) {
  return parallel_sum(static_cast<Index>(v.size()), Sums{}, [&](Index A) {
    const Real m = at(mass, A);
    return Sums{m / 2 * sum(at(v, A) * at(v, A)), sum(at(f, A) * at(f, A)) / m};
  });
}

}  // namespace

template <int D>
Real EnergyResolution<D>::longest_step(const System<D>& system, const State& state) {
  Sums all = sums(state.v, state.force, system.mass);
  for (const Unknown& field : state.fields)
    if (field.spec.evolution == Evolution::inertial)
      all = all + sums(field.rate, field.f, field.capacity);
  energy_ =
      std::max(energy_, all.kinetic + state.books.dissipated + std::abs(state.books.external_work));
  hold(all.S > 0 ? std::sqrt(8 * eta * energy_ / all.S) : unbounded, state.step);
  return held_;
}

/// Every change of step disturbs the balance a little, and following each oscillation would make it
/// drift. So a shorter step is taken with a margin, and one that is considerably longer at the end
/// of a window in which it would have been allowed throughout; windows grow with the run.
template <int D>
void EnergyResolution<D>::hold(Real allowed, std::int64_t step) {
  constexpr Real margin = 0.8, considerable = 1.3;
  constexpr std::int64_t shortest_window = 5, share_of_run = 4;
  least_ = std::min(least_, allowed);
  if (allowed < held_) held_ = margin * allowed;
  if (step < window_end_) return;
  if (margin * least_ > considerable * held_) held_ = margin * least_;
  least_ = unbounded;
  window_end_ = step + std::max(shortest_window, step / share_of_run);
}

template <int D>
void EnergyResolution<D>::archive(const Archive& a) {
  a("energy", energy_, of_sum(dimension::energy, D));
  a("held", held_, dimension::time);
  a("least", least_, dimension::time);
  a("window_end", window_end_);
  require_saved(energy_ >= 0 && held_ >= 0 && least_ >= 0 && window_end_ >= 0, a,
                "energy_resolution");
}

template class EnergyResolution<2>;
template class EnergyResolution<3>;

}  // namespace meniscus
