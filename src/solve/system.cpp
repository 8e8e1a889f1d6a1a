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
void System<D>::add_up(const Motion& motion, std::span<Lanes> force) {
  std::fill(force.begin(), force.end(), Lanes::zero());
  for (auto& term : terms) term->add_force(motion, force);
}

template <int D>
void System<D>::compute_forces(const Motion& motion, std::span<Lanes> force) {
  add_up(motion, force);
  for (const auto& term : terms)
    if (const auto failure = term->failure()) {
      const std::string message = fmt::format(
          "{}: {} ({})", place_of(*this, motion, failure->particle), failure->cause, term->name());
      if (failure->of_step) throw StepRejected(message);
      throw SolveError(message);
    }
  const Lanes total =
      parallel_sum(size(), Lanes::zero(), [&](Index A) { return at(force, A) * at(force, A); });
  if (std::isfinite(sum(total))) return;
  for (Index A = 0; A < size(); ++A)
    if (!std::isfinite(sum(at(force, A) * at(force, A))))
      throw SolveError(place_of(*this, motion, A) + ": the force is not a finite number");
}

template struct System<2>;
template struct System<3>;

}  // namespace meniscus
