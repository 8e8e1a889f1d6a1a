// SPDX-License-Identifier: BSD-3-Clause
// Estimates the cost of an equilibrium from counts.
#include "solve/expected_effort.hpp"

#include "solve/newton/tangent_factors.hpp"
#include "solve/step/rest.hpp"
#include "solve/step/way_to_rest.hpp"

#include <chrono>

namespace meniscus {
namespace {

template <class F>
Real seconds_of(int times, F&& f) {
  const auto begin = std::chrono::steady_clock::now();
  for (int k = 0; k < times; ++k) f();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() / times;
}

}  // namespace

template <int D>
std::optional<ExpectedEffort> expected_effort(System<D>& system, const State& state,
                                              Real load_steps, Real steady_after, Real dt,
                                              const std::vector<bool>& fluid,
                                              const typename Relaxation<D>::Tolerances& tolerances,
                                              int fewest_steps) {
  constexpr Index most_particles = D == 3 ? 4000 : 20000;
  if (system.size() > most_particles || !system.fields.empty()) return std::nullopt;
  for (auto& term : system.terms)
    if (!term->potential(state.motion())) return std::nullopt;
  const NodalVectors still(state.u.size(), Lanes::zero());
  const Motion motion{state.time, state.u, still};
  NodalVectors f = still, z = still;
  ExpectedEffort effort;
  const FluidRest<D> fluids(system, fluid);
  Real stored = 0;
  for (auto& term : system.terms) stored += std::abs(term->stored_energy(motion).value_or(0));
  const Real clock = fluids.any() ? fluids.clock_of(stored) : 0;
  if (clock == unbounded) return std::nullopt;
  std::optional<ImplicitEuler<D>> euler;
  if (fluids.any()) euler.emplace(system).begin(state.time, state.u, clock);
  std::optional<HeldPreconditioner<D>> P;
  effort.set_up_seconds = seconds_of(1, [&] { P.emplace(system, euler ? &*euler : nullptr); });
  constexpr int times = 3;
  effort.seconds_per_step = seconds_of(times, [&] { system.add_up(motion, f); });
  effort.seconds_per_tangent = seconds_of(times, [&] {
    system.add_tangent(motion, {state.time, f, still}, z);
    if (euler) euler->add_change(f, z);
    P->apply(f, z);
  });
  effort.load_steps = load_steps;
  if (!euler && TangentFactors<D>::suit(system) &&
      !TangentFactors<D>::others_resist(system, motion)) {
    // Five iterations and the first guess (quasi-statics note 10).
    constexpr Real iterations = 6, tangents = D == 3 ? 15 : 5;
    std::optional<TangentFactors<D>> K;
    effort.set_up_seconds = seconds_of(1, [&] { K.emplace(system); });
    effort.by_factors = true;
    effort.tangents_per_step = iterations;
    effort.seconds_per_tangent = tangents * effort.seconds_per_tangent + seconds_of(1, [&] {
                                   K->assemble(state.time, state.u, {}, {});
                                   K->factor(K->small_shift());
                                 });
  }
  if (euler) {
    constexpr Real steps_to_rest = 10, clocks_to_rest = 5;
    effort.tangents_per_step = D == 3 ? 350 : 250;
    effort.load_steps += steps_to_rest;
    effort.relaxation_steps = (steady_after + clocks_to_rest * clock) / dt;
    effort.uncertainty = 5;
    return effort;
  }
  // Counts of four or five iterations of Newton's method.
  if (!effort.by_factors) effort.tangents_per_step = D == 3 ? 150 : 50;
  const auto time = WayToRest<D>(system, *P, state, std::max(steady_after, state.time))
                        .time(tolerances, dt, fewest_steps);
  if (!time) return std::nullopt;
  effort.relaxation_steps = (*time - state.time) / dt;
  // The stiffness of a contact that closes on the way is not that of the start.
  for (const auto& term : system.terms)
    if (term->may_reject_steps()) effort.uncertainty = 5;
  return effort;
}

#define MENISCUS_INSTANTIATE(D)                                             \
  template std::optional<ExpectedEffort> expected_effort(                   \
      System<D>&, const State&, Real, Real, Real, const std::vector<bool>&, \
      const typename Relaxation<D>::Tolerances&, int);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
