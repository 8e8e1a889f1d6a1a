// SPDX-License-Identifier: BSD-3-Clause
// Sum of all force terms and the check that it makes sense.
#include "meniscus/solve/system.hpp"

#include "meniscus/approx/row_sums.hpp"

#include <fmt/format.h>

#include <cmath>

namespace meniscus {
namespace {

template <int D>
std::string place_of(const System<D>& system, const Motion& motion, Index particle) {
  const Body<D>& body = system.body_of(particle);
  const Index A = particle - body.first;
  const Vec<D>& X = at(body.particles.X(), A);
  const Lanes u = value_at(body.at_particles, A, motion.u.data() + body.first);
  std::string reference, current;
  for (int i = 0; i < D; ++i) {
    reference += fmt::format("{}{:.6g}", i ? ", " : "", X[i]);
    current += fmt::format("{}{:.6g}", i ? ", " : "", X[i] + u[i]);
  }
  return fmt::format("body '{}', particle {} at reference position ({}), now ({})", body.name,
                     particle, reference, current);
}

}  // namespace

void Books::begin(const Report& report, Real power_of_loads) {
  heat = report.heat;
  external_power = report.external_power;
  load_power = power_of_loads;
}

/// The heat is that of the half-step velocities: over a step the viscous force does the work
/// dt/2 (f_n + f_n+1).v_n+1/2, of which f_n+1.v_n+1/2 is the power computed last and f_n.v_n+1/2
/// lies half-way between the power before and that.
void Books::add(const Report& report, Real power_of_loads, Real dt) {
  dissipated += dt / 4 * heat;
  external_work += dt / 2 * (external_power + load_power);
  begin(report, power_of_loads);
  dissipated += 3 * dt / 4 * heat;
  external_work += dt / 2 * (external_power + load_power);
}

template <int D>
bool System<D>::viscous() const {
  for (const auto& term : terms)
    if (term->viscous()) return true;
  return false;
}

template <int D>
std::size_t System<D>::bytes() const {
  std::size_t sum = 0;
  for (const auto& term : terms) sum += term->bytes();
  return sum;
}

template <int D>
const Body<D>& System<D>::body_of(Index particle) const {
  std::size_t b = bodies.size() - 1;
  while (b > 0 && bodies[b].first > particle) --b;
  return bodies[b];
}

template <int D>
Report System<D>::add_up(const Motion& motion, Forces force) {
  std::fill(force.begin(), force.end(), Lanes::zero());
  Report all;
  for (auto& term : terms) {
    Report report = term->add_force(motion, force);
    if (report.failure) report.failure->cause += " (" + term->name() + ")";
    all += std::move(report);
  }
  return all;
}

template <int D>
Real System<D>::load_power(const Motion& motion) {
  Real power = 0;
  for (auto& term : terms) power += term->load_power(motion);
  return power;
}

template <int D>
void System<D>::commit(const Motion& motion) {
  for (auto& term : terms) term->commit(motion);
}

template <int D>
Report System<D>::compute_forces(const Motion& motion, Forces force) {
  Report report = add_up(motion, force);
  if (const auto& failure = report.failure) {
    const std::string message =
        fmt::format("{}: {}", place_of(*this, motion, failure->particle), failure->cause);
    if (failure->of_step) throw StepRejected(message);
    throw SolveError(message);
  }
  const Lanes total =
      parallel_sum(size(), Lanes::zero(), [&](Index A) { return at(force, A) * at(force, A); });
  if (std::isfinite(sum(total))) return report;
  for (Index A = 0; A < size(); ++A)
    if (!std::isfinite(sum(at(force, A) * at(force, A))))
      throw SolveError(place_of(*this, motion, A) + ": the force is not a finite number");
  return report;  // the squares overflowed
}

template struct System<2>;
template struct System<3>;

}  // namespace meniscus
