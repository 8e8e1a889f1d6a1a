// SPDX-License-Identifier: BSD-3-Clause
// Sums the forces of all terms and checks that they are finite.
#include "solve/system.hpp"

#include "kernel/row_sums.hpp"
#include "parallel/nodal_algebra.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace meniscus {
template <int D>
std::size_t System<D>::add_field(const FieldSpec& spec, std::span<const Real> capacity) {
  std::size_t k = 0;
  while (k < fields.size() && fields[k].spec.name != spec.name) ++k;
  if (k == fields.size()) {
    const NodalVectors zero(mass.size(), Lanes::zero());
    fields.push_back({spec, std::vector<Real>(mass.size(), 0.0), zero, zero, zero});
  }
  Unknown& field = fields[k];
  if (!(field.spec == spec) || capacity.size() != field.capacity.size())
    throw std::logic_error("the field '" + spec.name + "' is described in two ways");
  for (std::size_t A = 0; A < capacity.size(); ++A) field.capacity[A] += capacity[A];
  return k;
}

template <int D>
void System<D>::hold(std::vector<std::unique_ptr<Constraint>> all, State& state) {
  constraints = std::make_unique<Constraints>(std::move(all), mass);
  state.reactions.force.assign(static_cast<std::size_t>(constraints->rows()), 0.0);
  state.reactions.work.assign(constraints->all().size(), 0.0);
}

template <int D>
Real System<D>::steady_after() const {
  Real last = constraints ? constraints->steady_after() : 0;
  for (const auto& term : terms) last = std::max(last, term->steady_after());
  return last;
}

/// Divides the particles between ranks. The reads of values at its own particles are added here for
/// each rank.
template <int D>
void System<D>::share_steps(StepReads reads) {
  halo.reset();
  if (ranks().alone()) return;
  without_halo = fields.empty() ? "" : "the field '" + fields.front().spec.name + "'";
  for (const auto& term : terms)
    if (without_halo.empty() && !term->tell_reads(reads)) without_halo = term->name();
  if (!without_halo.empty()) return;
  if (constraints) reads.particles(constraints->particles(), 0);
  std::vector<Index> first;
  std::vector<Division> division;
  for (const Body<D>& body : bodies) {
    first.push_back(body.first);
    division.push_back(body.division);
  }
  ParticleOwners owners(size(), std::move(first), std::move(division));
  for (const Body<D>& body : bodies) {
    const OwnItems own = body.division.own_rows(body.size());
    reads.particles(body.at_particles.of_rows(own.begin, own.end), body.first);
  }
  halo = reads.share(std::move(owners));
  if (!halo) without_halo = "forces that read all particles on every rank";
}

template <int D>
void System<D>::complete(State& state) {
  if (!in_halo()) return;
  halo->leave({&state.u, &state.v, &state.force});
  for (auto& term : terms) term->complete_history();
}

template <int D>
bool System<D>::reads_changed() const {
  return std::any_of(terms.begin(), terms.end(),
                     [](const auto& term) { return term->reads_changed(); });
}

template <int D>
bool System<D>::viscous() const {
  for (const auto& term : terms)
    if (term->viscous()) return true;
  return false;
}

template <int D>
std::size_t System<D>::bytes() const {
  std::size_t sum = constraints ? constraints->bytes() : 0;
  for (const auto& term : terms) sum += term->bytes();
  for (const auto& field : carried) sum += field->bytes();
  return sum;
}

template <int D>
const Body<D>& System<D>::body_of(Index particle) const {
  std::size_t b = bodies.size() - 1;
  while (b > 0 && bodies[b].first > particle) --b;
  return bodies[b];
}

template <int D>
StepFailure System<D>::located(const Failure& what, const Motion& motion) const {
  const Body<D>& body = body_of(what.particle);
  const Index A = what.particle - body.first;
  const Vec<D>& X = at(body.particles.X(), A);
  Lanes u = value_at(body.at_particles, A, motion.u.data() + body.first);
  ranks().hand_out(body.division.rank_of_row(body.size(), A), &u, sizeof u);
  std::string reference, current;
  for (int i = 0; i < D; ++i) {
    reference += fmt::format("{}{:.6g}", i ? ", " : "", X[i]);
    current += fmt::format("{}{:.6g}", i ? ", " : "", X[i] + u[i]);
  }
  StepFailure failure;
  failure.cause = what.cause;
  failure.term = what.term;
  failure.of_step = what.of_step;
  failure.body = body.name;
  failure.particle = what.particle;
  failure.place = fmt::format("({}), now ({})", reference, current);
  return failure;
}

template <int D>
Report System<D>::add_up(const Motion& motion, Forces force) {
  for_particles([&](Index begin, Index end) {
    std::fill(force.begin() + begin, force.begin() + end, Lanes::zero());
  });
  for (Unknown& field : force.fields) clear(field.f);
  force.leave_chunks = !ranks().alone();
  reports_.clear();
  for (auto& term : terms) reports_.push_back(term->add_force(motion, force));
  for (auto& field : carried) field->add_reaction(motion, force);
  spread(force);
  if (force.leave_chunks) complete_reports(motion, force);
  Report all;
  for (std::size_t k = 0; k < terms.size(); ++k) {
    Report& report = reports_[k];
    if (report.failure) report.failure->term = terms[k]->name();
    all += std::move(report);
  }
  return all;
}

/// Completes the reports of all terms with two exchanges: one for results per chunk, one for
/// results of single ranks.
template <int D>
void System<D>::complete_reports(const Motion& motion, Forces force) {
  left_.clear();
  for (const Report& report : reports_)
    if (report.chunks) left_.push_back(report.chunks);
  exchange_.complete(left_);
  for (std::size_t k = 0; k < terms.size(); ++k)
    if (reports_[k].chunks) terms[k]->add_chunks(motion, force, reports_[k]);
  of_ranks_.complete(reports_);
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
  if (report.failure) throw StepError(located(*report.failure, motion));
  const Lanes total =
      sum_over_particles(Lanes::zero(), [&](Index A) { return at(force, A) * at(force, A); });
  for (const Unknown& field : force.fields)
    for (Index A = 0; A < size(); ++A)
      if (!std::isfinite(sum(at(field.f, A) * at(field.f, A))))
        throw StepError(
            located({A, "the force on '" + field.spec.name + "' is not a finite number"}, motion));
  if (std::isfinite(sum(total))) return report;
  if (const Index A = first_not_finite(force); A < size())
    throw StepError(located({A, "the force is not a finite number"}, motion));
  return report;  // only the squares have overflowed
}

/// The first particle whose force is not finite; the number of particles if there is none.
template <int D>
Index System<D>::first_not_finite(std::span<const NodalVector> force) const {
  const auto first_in = [&](OwnItems part) {
    Index A = part.begin;
    while (A < part.end && std::isfinite(sum(at(force, A) * at(force, A)))) ++A;
    return A < part.end ? A : size();
  };
  if (!in_halo()) return first_in({0, size()});
  Index first = size();
  for (const OwnItems part : halo->owners().own()) first = std::min(first, first_in(part));
  return size() - static_cast<Index>(ranks().largest(size() - first));
}

template struct System<2>;
template struct System<3>;

}  // namespace meniscus
