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
namespace {

template <class Bodies>
std::vector<Division> divisions_of(const Bodies& bodies) {
  std::vector<Division> all;
  for (const auto& body : bodies) all.push_back(body.division);
  return all;
}

}  // namespace

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

/// The reads of values at its own particles are added here for each process.
template <int D>
void System<D>::share_steps(StepReads reads) {
  followed.follow_all({});
  if (ranks().alone()) return;
  std::string reason = fields.empty() ? "" : "the field '" + fields.front().spec.name + "'";
  for (const auto& term : terms)
    if (reason.empty() && !term->reads(reads)) reason = term->name();
  if (!reason.empty()) return followed.follow_all(reason);
  if (constraints) reads.particles(constraints->particles(), 0);
  for (const Body<D>& body : bodies) {
    const ItemRange own = body.own_particles();
    reads.particles(body.at_particles.of_rows(own.begin, own.end), body.first);
  }
  followed.follow(std::move(reads), particle_owners());
}

template <int D>
ParticleOwners System<D>::particle_owners() const {
  std::vector<Index> first;
  for (const Body<D>& body : bodies) first.push_back(body.first);
  return {size(), std::move(first), divisions_of(bodies)};
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
  StepFailure failure;
  failure.cause = what.cause;
  failure.term = what.term;
  failure.of_step = what.of_step;
  if (what.particle < 0) return failure;
  const Body<D>& body = body_of(what.particle);
  const Index A = what.particle - body.first;
  const Vec<D>& X = at(body.particles.X(), A);
  const Lanes u = body.value_at_particle(A, motion.u);
  std::string reference, current;
  for (int i = 0; i < D; ++i) {
    reference += fmt::format("{}{:.6g}", i ? ", " : "", X[i]);
    current += fmt::format("{}{:.6g}", i ? ", " : "", X[i] + u[i]);
  }
  failure.body = body.name;
  failure.particle = what.particle;
  failure.place = fmt::format("({}), now ({})", reference, current);
  return failure;
}

template <int D>
template <class F>
void System<D>::in_phases(const Motion& motion, Forces force, F&& work) {
  const bool in_part = followed.entered() != nullptr;
  if (in_part)
    everywhere_ = [this](const Motion& here) {
      all_u_.assign(here.u.begin(), here.u.end());
      all_v_.assign(here.v.begin(), here.v.end());
      followed.complete(all_u_);
      followed.complete(all_v_);
      return Motion{here.time, all_u_, all_v_, here.fields, here.reactions};
    };
  work(phases_.begin(motion, force, in_part ? &everywhere_ : nullptr));
  phases_.finish();
}

template <int D>
template <class F>
void System<D>::for_terms(const Motion& motion, Forces force, Wanted wanted, F&& add) {
  Report none;
  in_phases(motion, force, [&](const Forces& all) {
    for (auto& term : terms)
      if (wanted(*term))
        phases_.run(none, [&] {
          add(*term, all);
          return Report();
        });
  });
  spread(force);
}

template <int D>
void System<D>::spread(Forces force) {
  if (ranks().alone()) return;
  followed.set_owners(particle_owners());
  followed.spread(force);
  for (Unknown& field : force.fields) followed.spread(field.f);
}

template <int D>
Report System<D>::add_up_for(bool demand, const Motion& motion, Forces force) {
  for_particles([&](Index begin, Index end) {
    std::fill(force.begin() + begin, force.begin() + end, Lanes::zero());
  });
  for (Unknown& field : force.fields) clear(field.f);
  force.demand = demand;
  reports_.assign(terms.size(), Report());
  in_phases(motion, force, [&](const Forces& all) {
    for (std::size_t k = 0; k < terms.size(); ++k)
      phases_.run(reports_[k], [&] { return terms[k]->add_force(motion, all); });
  });
  for (auto& field : carried) field->add_reaction(motion, force);
  spread(force);
  share_failures();
  Report sum;
  for (std::size_t k = 0; k < terms.size(); ++k) {
    if (reports_[k].failure) reports_[k].failure->term = terms[k]->name();
    sum += std::move(reports_[k]);
  }
  return sum;
}

template <int D>
Report System<D>::add_up(const Motion& motion, Forces force) {
  return add_up_for(false, motion, force);
}

template <int D>
Report System<D>::add_force(ForceTerm& term, const Motion& motion, Forces force) {
  Report report;
  in_phases(motion, force, [&](const Forces& all) {
    phases_.run(report, [&] { return term.add_force(motion, all); });
  });
  spread(force);
  return report;
}

template <int D>
void System<D>::add_tangent(const Motion& motion, const Motion& change, Forces force,
                            Wanted wanted) {
  for_terms(motion, force, wanted,
            [&](ForceTerm& term, const Forces& all) { term.add_tangent(motion, change, all); });
}

template <int D>
void System<D>::add_by(const Motion& motion, Forces force,
                       const std::function<void(const Forces&)>& add) {
  in_phases(motion, force, add);
  spread(force);
}

template <int D>
void System<D>::add_viscous(const Motion& motion, Forces force) {
  for_terms(motion, force, viscous,
            [&](ForceTerm& term, const Forces& all) { term.add_viscous(motion, all); });
}

template <int D>
void System<D>::add_viscous_diagonal(std::span<NodalVector> diagonal) {
  for_terms({0, {}, {}}, diagonal, viscous,
            [](ForceTerm& term, const Forces& all) { term.add_viscous_diagonal(all); });
}

template <int D>
void System<D>::share_failures() {
  for (Report& report : reports_)
    if (report.failure) report.failure = shared(*report.failure);
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
  Report report = add_up_for(true, motion, force);
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
  const auto first_in = [&](const ItemRange& part) {
    Index A = part.begin;
    while (A < part.end && std::isfinite(sum(at(force, A) * at(force, A)))) ++A;
    return A < part.end ? A : size();
  };
  Index first = size();
  followed.for_own(size(), [&](const ItemRange& part) { first = std::min(first, first_in(part)); });
  return followed.entered() ? FollowedParticles::smallest(size(), first) : first;
}

template struct System<2>;
template struct System<3>;

}  // namespace meniscus
