// SPDX-License-Identifier: BSD-3-Clause
// Estimates the cost of an equilibrium from counts.
#include "solve/expected_effort.hpp"

#include "parallel/nodal_algebra.hpp"
#include "parallel/parallel.hpp"
#include "solve/free_motions.hpp"
#include "solve/linear/held_preconditioner.hpp"
#include "solve/step/rest.hpp"

#include <chrono>
#include <cmath>
#include <numbers>

namespace meniscus {
namespace {

template <class F>
Real seconds_of(int times, F&& f) {
  const auto begin = std::chrono::steady_clock::now();
  for (int k = 0; k < times; ++k) f();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() / times;
}

/// Forces that excite the motion: the final loads on the initial state, with held faces at their
/// final positions. Without such loads, the inertia of the displacement of the held faces; without
/// held faces, random forces.
template <int D>
NodalVectors exciting_forces(System<D>& system, const HeldPreconditioner<D>& P, const State& state,
                             Real time) {
  NodalVectors u = state.u, f(state.u.size(), Lanes::zero());
  const NodalVectors still = f;
  P.meet(time, u);
  if (!system.add_up({time, u, still, state.fields}, f).failure) {
    if (system.constraints) {
      std::vector<Real> lambda(static_cast<std::size_t>(system.constraints->rows()));
      system.constraints->balance(f, lambda);
    }
    if (largest(f) > 0) return f;
  }
  for (Index A = 0; A < system.size(); ++A)
    at(f, A) = at(system.mass, A) * (at(u, A) - at(state.u, A));
  if (largest(f) > 0) return f;
  for (Index A = 0; A < system.size(); ++A)
    at(f, A) =
        Lanes(std::sin(12.9898 * A), std::sin(78.233 * A), D == 3 ? std::sin(37.719 * A) : 0.0, 0);
  return f;
}

/// About the lowest frequency that the forces excite, with linear elements and without rigid
/// motions. A few inverse iterations keep the symmetry of the loads, because modes that the loads
/// do not excite do not delay the equilibrium.
template <int D>
Real excited_frequency(const System<D>& system, const HeldPreconditioner<D>& P,
                       const FreeMotions<D>& free, NodalVectors r) {
  constexpr int iterations = 3;
  NodalVectors w = r;
  Real square = 0;
  for (int k = 0; k < iterations; ++k) {
    free.remove_from(r);
    const Real stiffness = P.apply(r, w);
    const Real inertia = parallel_sum(
        system.size(), 0.0, [&](Index A) { return at(system.mass, A) * sum(at(w, A) * at(w, A)); });
    square = stiffness / inertia;
    for (Index A = 0; A < system.size(); ++A)
      at(r, A) = (at(system.mass, A) / std::sqrt(inertia)) * at(w, A);
  }
  return std::sqrt(square);
}

}  // namespace

template <int D>
std::optional<ExpectedEffort> expected_effort(System<D>& system, const State& state,
                                              Real load_steps, Real steady_after, Real stable,
                                              const std::vector<bool>& fluid) {
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
    for (auto& term : system.terms) term->add_tangent(motion, {state.time, f, still}, z);
    if (euler) euler->add_change(f, z);
    P->apply(f, z);
  });
  effort.load_steps = load_steps;
  if (euler) {
    constexpr Real steps_to_rest = 10, clocks_to_rest = 5;
    effort.tangents_per_step = D == 3 ? 350 : 250;
    effort.load_steps += steps_to_rest;
    effort.relaxation_steps = (steady_after + clocks_to_rest * clock) / (0.9 * stable);
    return effort;
  }
  // Counts of four or five iterations of Newton's method.
  effort.tangents_per_step = D == 3 ? 150 : 50;
  const FreeMotions<D> free(system, motion, std::cbrt(system.bodies.front().cells.volume(0)));
  const Real period = 2 * std::numbers::pi /
                      excited_frequency(system, *P, free,
                                        exciting_forces(system, *P, state,
                                                        std::isfinite(steady_after)
                                                            ? std::max(steady_after, state.time)
                                                            : state.time));
  if (!std::isfinite(period)) return std::nullopt;
  effort.relaxation_steps = (steady_after + 2 * period) / (0.9 * stable);
  return effort;
}

template std::optional<ExpectedEffort> expected_effort(System<2>&, const State&, Real, Real, Real,
                                                       const std::vector<bool>&);
template std::optional<ExpectedEffort> expected_effort(System<3>&, const State&, Real, Real, Real,
                                                       const std::vector<bool>&);

}  // namespace meniscus
