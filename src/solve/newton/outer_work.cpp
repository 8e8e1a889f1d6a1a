// SPDX-License-Identifier: BSD-3-Clause
// External work between two states: the mean of the forces, and a correction for their curvature.
#include "solve/newton/outer_work.hpp"

#include "parallel/nodal_algebra.hpp"

#include <numeric>

namespace meniscus {
namespace {

/// Books the work of each held face, and in the last entry of `work` the work of everything else.
void book(State& state, const std::vector<Real>& work) {
  for (std::size_t k = 0; k < work.size(); ++k) {
    state.books.external_work += work[k];
    if (k + 1 < work.size()) state.reactions.work[k] += work[k];
  }
}

}  // namespace

template <int D>
OuterWork<D>::OuterWork(System<D>& system) : system_(system) {
  way_.assign(static_cast<std::size_t>(system.size()), Lanes::zero());
  last_.du = way_;
  last_.work.resize(1);
  if (!system.constraints) return;
  way_of_rows_.resize(static_cast<std::size_t>(system.constraints->rows()));
  last_.lambda = way_of_rows_;
  last_.work.resize(system.constraints->all().size() + 1);
}

template <int D>
typename OuterWork<D>::Exchange OuterWork<D>::move(State& state, Real time, const NodalVectors& u) {
  const Real stored = stored_energy(system_, state.motion()), begin = state.time;
  const NodalVectors from = state.u;
  moved_.dt = time - begin;
  moved_.du = u;
  add(moved_.du, -1, from);
  moved_.lambda = state.reactions.force;
  state.u = u;
  state.time = time;
  const Report report = system_.compute_forces(state.motion(), state.forces());
  state.demand = report.demand;
  if (system_.constraints) system_.constraints->balance(state.force, state.reactions.force);
  moved_.work = work_between({begin, from, moved_.lambda}, {time, state.u, state.reactions.force});
  book(state, moved_.work);
  state.books.dissipated += report.lost;
  return {std::accumulate(moved_.work.begin(), moved_.work.end(), 0.0),
          stored_energy(system_, state.motion()) - stored, report.lost};
}

template <int D>
std::vector<Real> OuterWork<D>::work_between(const End& before, const End& after) {
  for (Index A = 0; A < system_.size(); ++A) at(way_, A) = at(after.u, A) - at(before.u, A);
  const Motion from{before.time, before.u, way_}, to{after.time, after.u, way_};
  std::vector<Real> work;
  if (system_.constraints) {
    system_.constraints->apply(way_, way_of_rows_);
    for (const auto& one : system_.constraints->all()) {
      work.push_back(0);
      for (Index r = one->first; r < one->first + one->rows.size(); ++r)
        work.back() += 0.5 * (at(before.lambda, r) + at(after.lambda, r)) * at(way_of_rows_, r);
    }
  }
  work.push_back(0.5 * (system_.load_power(from) + system_.load_power(to)));
  for (const auto& term : system_.terms)
    if (after.time > before.time && term->steady_after() > before.time)
      work.back() += term->work_between(from, to);
  return work;
}

/// Books the correction to the mean of forces over the last two pieces: the difference to the mean
/// over both pieces together. Half of it is booked, because the curvature over a piece is estimated
/// again with its neighbour on the other side. A path back cancels what the path forth has booked.
template <int D>
void OuterWork<D>::book_bend(const State& before, State& state) {
  if (last_.dt <= 0) return;
  NodalVectors first = before.u;
  add(first, -1, last_.du);
  std::vector<Real> bend = work_between({before.time - last_.dt, first, last_.lambda},
                                        {state.time, state.u, state.reactions.force});
  const Real part = last_.dt / (last_.dt + state.time - before.time), rest = 1 - part;
  const Real half = 0.5 * (part * part * part + rest * rest * rest);
  for (std::size_t k = 0; k < bend.size(); ++k)
    bend[k] = half * (last_.work[k] + moved_.work[k] - bend[k]) / (3 * part * rest);
  book(state, bend);
}

template <int D>
void OuterWork<D>::go_on(bool jump) {
  last_ = moved_;
  if (jump) forget();
}

template <int D>
void OuterWork<D>::archive(const Archive& a) {
  a("last_change", last_.du, D, dimension::length);
  a("last_time", last_.dt, dimension::time);
  a("last_work", last_.work, of_sum(dimension::energy, D));
  if (!last_.lambda.empty()) a("last_reactions", last_.lambda, of_sum(dimension::force, D));
  require_saved(last_.dt >= 0, a, "last_time");
}

template <int D>
Real stored_energy(const System<D>& system, const Motion& motion) {
  Real sum = 0;
  for (const auto& term : system.terms) sum += term->stored_energy(motion).value_or(0);
  return sum;
}

template class OuterWork<2>;
template class OuterWork<3>;
template Real stored_energy(const System<2>&, const Motion&);
template Real stored_energy(const System<3>&, const Motion&);

}  // namespace meniscus
