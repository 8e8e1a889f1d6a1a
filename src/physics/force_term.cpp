// SPDX-License-Identifier: BSD-3-Clause
// Default functions of force terms: tangents by differences, reports summed over chunks.
#include "meniscus/physics/force_term.hpp"

#include "physics/force_phases.hpp"

#include <utility>

namespace meniscus {
namespace {

/// x + h dx
NodalVectors moved(std::span<const NodalVector> x, Real h, std::span<const NodalVector> dx) {
  NodalVectors sum(x.begin(), x.end());
  for (std::size_t A = 0; A < sum.size(); ++A) sum[A] += h * dx[A];
  return sum;
}

/// Forces of a term at motion + h change.
struct Trial {
  NodalVectors force;
  std::vector<Unknown> fields;

  Trial(ForceTerm& term, const Motion& motion, Real h, const Motion& change)
      : force(motion.u.size(), Lanes::zero()), fields(motion.fields.begin(), motion.fields.end()) {
    for (std::size_t k = 0; k < fields.size(); ++k) {
      fields[k].x = moved(fields[k].x, h, change.fields[k].x);
      fields[k].rate = moved(fields[k].rate, h, change.fields[k].rate);
      fields[k].f.assign(fields[k].x.size(), Lanes::zero());
    }
    const NodalVectors u = moved(motion.u, h, change.u), v = moved(motion.v, h, change.v);
    term.add_force({motion.time, u, v, fields}, {force, fields});
  }
};

}  // namespace

void ForceTerm::add_tangent(const Motion& motion, const Motion& change, Forces force) {
  constexpr Real h = 1e-6;
  const auto add = [](const NodalVectors& plus, const NodalVectors& minus,
                      std::span<NodalVector> sum) {
    for (std::size_t A = 0; A < plus.size(); ++A) sum[A] += (plus[A] - minus[A]) / (2 * h);
  };
  const Trial plus(*this, motion, h, change), minus(*this, motion, -h, change);
  add(plus.force, minus.force, force);
  for (std::size_t k = 0; k < force.fields.size(); ++k)
    add(plus.fields[k].f, minus.fields[k].f, force.fields[k].f);
}

Report Forces::gather(std::span<const Gathered> arrays, const Motion& motion, Then then) const {
  if (phases) {
    phases->later(arrays, std::move(then));
    return {};
  }
  GatherTogether()(arrays);
  return then(motion, *this);
}

Report Forces::gather(std::initializer_list<Gathered> arrays, const Motion& motion,
                      Then then) const {
  return gather(std::span(arrays.begin(), arrays.size()), motion, std::move(then));
}

Motion Forces::everywhere(const Motion& motion) const {
  return phases ? phases->everywhere() : motion;
}

Report ForceTerm::sum_of(const ChunkReports& of_chunks, const Motion& motion, Forces force) const {
  Report report;
  Real stored = 0;
  Index failed = ChunkReport::nowhere;
  for (const ChunkReport& chunk : of_chunks) {
    report.heat += chunk.heat;
    report.external_power += chunk.external_power;
    stored += chunk.energy;
    failed = std::min(failed, chunk.failed);
  }
  if (force.energies && !energy_kind().empty()) force.energies->push_back({this, stored});
  if (failed != ChunkReport::nowhere)
    report.failure = failure_of(failed, motion).value_or(Failure());
  return report;
}

Report ForceTerm::report_of(ChunkReports& of_chunks, const Motion& motion, Forces force) const {
  return force.gather({of_chunks.gathered()}, motion,
                      [this, &of_chunks](const Motion& at_motion, const Forces& all) {
                        return sum_of(of_chunks, at_motion, all);
                      });
}

Real ForceTerm::work_between(const Motion& before, const Motion& after) const {
  const auto energy = [&](Real time, const Motion& at) {
    return stored_energy({time, at.u, at.v, at.fields}).value_or(0);
  };
  Real work = 0;
  for (const Motion* at : {&before, &after})
    work += 0.5 * (energy(after.time, *at) - energy(before.time, *at));
  return work;
}

void ForceTerm::add_viscous(const Motion& motion, Forces force) {
  const NodalVectors still(motion.v.size(), Lanes::zero());
  NodalVectors elastic = still, all = still;
  std::vector<Unknown> fields(motion.fields.begin(), motion.fields.end());
  add_force({motion.time, motion.u, still, motion.fields}, {elastic, fields});
  add_force(motion, {all, fields});
  for (std::size_t A = 0; A < all.size(); ++A) force[A] += all[A] - elastic[A];
}

}  // namespace meniscus
