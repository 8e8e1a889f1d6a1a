// SPDX-License-Identifier: BSD-3-Clause
// Constraints (held faces) in steps of central differences.
#include "solve/constraints.hpp"

#include "meniscus/error.hpp"
#include "numbers/dense.hpp"
#include "parallel/parallel.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <map>

namespace meniscus {
namespace {

/// Loops over n items. Small faces use one thread, since synchronising threads would take longer.
template <class F>
void for_each_of(Index n, F&& f) {
  constexpr Index worth_threads = 1000;
  if (n >= worth_threads)
    parallel_for(n, f);
  else
    for (Index i = 0; i < n; ++i) f(i);
}

}  // namespace

Constraints::Constraints(std::vector<std::unique_ptr<Constraint>> all, std::span<const Real> mass)
    : all_(std::move(all)),
      mass_(mass.begin(), mass.end()),
      factors_((list_rows(), alike_ = count_alike(), factors())) {
  require_independent();
  for (auto* scratch :
       {&a_, &b_, &before_, &after_, &g_, &rate_, &acceleration_, &ahead_, &behind_})
    scratch->assign(row_.size(), 0.0);
  at_place_.assign(start_.size() - 1, Lanes::zero());
}

void Constraints::list_rows() {
  std::map<Index, std::vector<std::pair<Index, Real>>> by_particle;
  for (std::size_t number = 0; number < all_.size(); ++number) {
    Constraint& one = *all_[number];
    one.first = rows();
    one.number = static_cast<Index>(number);
    const auto first_place = static_cast<Index>(start_.size()) - 1;
    for (const auto& row : one.rows.rows)
      row_.push_back({first_place + row.place,
                      Lanes(row.direction[0], row.direction[1], row.direction[2], 0)});
    for (Index k = 0; k < one.rows.places(); ++k) {
      const Eigen::Vector3d& X = at(one.rows.X, k);
      X_.push_back(Lanes(X[0], X[1], X[2], 0));
      for (Offset e = at(one.rows.start, k); e < at(one.rows.start, k + 1); ++e) {
        particle_.push_back(at(one.rows.particle, e));
        weight_.push_back(at(one.rows.weight, e));
        by_particle[particle_.back()].emplace_back(first_place + k, weight_.back());
      }
      start_.push_back(static_cast<Offset>(particle_.size()));
    }
  }
  for (const auto& [particle, places] : by_particle) {
    touched_.push_back(particle);
    for (const auto& [place, weight] : places) {
      touched_place_.push_back(place);
      touched_weight_.push_back(weight);
    }
    touched_start_.push_back(static_cast<Offset>(touched_place_.size()));
  }
}

/// Number of rows per face cell if all cells have the same mutually orthogonal directions;
/// otherwise 1. S then consists of equal blocks, one per direction, which are not coupled.
Index Constraints::count_alike() const {
  const Index places = static_cast<Index>(start_.size()) - 1, n = rows() / places;
  if (n * places != rows() || n > Lanes::width) return 1;
  for (Index r = 0; r < rows(); ++r) {
    const Row& row = at(row_, r);
    if (row.place != r / n) return 1;
    for (Index s = 0; s < n; ++s) {
      const Lanes other = at(row_, s).direction, change = row.direction - other;
      if ((s == r % n ? sum(change * change) : sum(row.direction * other)) != 0) return 1;
    }
  }
  return n;
}

/// Factors of S. Two face cells with common particles are coupled by sum_A weight weight / m_A,
/// times the cosine of the angle between the directions of their rows.
SparseCholesky Constraints::factors() const {
  std::map<std::pair<Index, Index>, Real> of_places;
  for (Index t = 0; t < static_cast<Index>(touched_.size()); ++t)
    for (Offset i = at(touched_start_, t); i < at(touched_start_, t + 1); ++i)
      for (Offset j = at(touched_start_, t); j < at(touched_start_, t + 1); ++j)
        of_places[{at(touched_place_, i), at(touched_place_, j)}] +=
            at(touched_weight_, i) * at(touched_weight_, j) / at(mass_, at(touched_, t));
  if (alike_ > 1) {
    std::vector<MatrixEntry> of_one;
    for (const auto& [places, value] : of_places)
      of_one.push_back({places.first, places.second, value});
    return {rows() / alike_, of_one};
  }
  std::vector<std::vector<Index>> rows_of(start_.size() - 1);
  for (Index r = 0; r < rows(); ++r) at(rows_of, at(row_, r).place).push_back(r);
  std::vector<MatrixEntry> entries;
  for (const auto& [places, value] : of_places)
    for (const Index r : at(rows_of, places.first))
      for (const Index s : at(rows_of, places.second)) {
        const Real cosine = sum(at(row_, r).direction * at(row_, s).direction);
        if (cosine != 0) entries.push_back({r, s, cosine * value});
      }
  return {rows(), entries};
}

void Constraints::require_independent() const {
  constexpr Real round_off = 1e-12;
  auto least = factors_.smallest_pivot();
  if (least.value > round_off) return;
  least.row *= alike_;
  const Constraint* of = nullptr;
  for (const auto& one : all_)
    if (one->first <= least.row) of = one.get();
  const auto& row = at(of->rows.rows, least.row - of->first);
  const Eigen::Vector3d& X = at(of->rows.X, row.place);
  throw InputError(fmt::format(
      "{}: {} asks for more than the particles can follow: at ({:.4g}, {:.4g}, {:.4g}) the "
      "displacement along ({:.3g}, {:.3g}, {:.3g}) is prescribed by the other held faces already; "
      "hold fewer faces or components there, or use more particles",
      of->place, of->name, X[0], X[1], X[2], row.direction[0], row.direction[1], row.direction[2]));
}

Real Constraints::steady_after() const {
  Real last = 0;
  for (const auto& one : all_) last = std::max(last, one->steady_after());
  return last;
}

void Constraints::targets(Real time, std::vector<Real>& g) const {
  for (const auto& one : all_)
    one->targets(time, std::span(g).subspan(static_cast<std::size_t>(one->first),
                                            static_cast<std::size_t>(one->rows.size())));
}

template <bool over_mass>
void Constraints::gather(std::span<const NodalVector> w, std::vector<Real>& Cw) const {
  for_each_of(static_cast<Index>(start_.size()) - 1, [&](Index k) {
    Lanes sum = Lanes::zero();
    for (Offset e = at(start_, k); e < at(start_, k + 1); ++e) {
      const Index A = at(particle_, e);
      sum += (over_mass ? at(weight_, e) / at(mass_, A) : at(weight_, e)) * at(w, A);
    }
    at(at_place_, k) = sum;
  });
  for (Index r = 0; r < rows(); ++r)
    at(Cw, r) = sum(at(row_, r).direction * at(at_place_, at(row_, r).place));
}

template <bool over_mass>
void Constraints::scatter(const std::vector<Real>& lambda, Real factor,
                          std::span<NodalVector> w) const {
  std::fill(at_place_.begin(), at_place_.end(), Lanes::zero());
  for (Index r = 0; r < rows(); ++r)
    at(at_place_, at(row_, r).place) += at(lambda, r) * at(row_, r).direction;
  for_each_of(static_cast<Index>(touched_.size()), [&](Index t) {
    Lanes sum = Lanes::zero();
    for (Offset e = at(touched_start_, t); e < at(touched_start_, t + 1); ++e)
      sum += at(touched_weight_, e) * at(at_place_, at(touched_place_, e));
    const Index A = at(touched_, t);
    at(w, A) += (over_mass ? factor / at(mass_, A) : factor) * sum;
  });
}

void Constraints::apply(std::span<const NodalVector> w, std::vector<Real>& Cw) const {
  gather<false>(w, Cw);
}
void Constraints::apply_over_mass(std::span<const NodalVector> f, std::vector<Real>& CMf) const {
  gather<true>(f, CMf);
}
void Constraints::add_transposed(const std::vector<Real>& lambda, Real factor,
                                 std::span<NodalVector> f) const {
  scatter<false>(lambda, factor, f);
}
void Constraints::add_over_mass(const std::vector<Real>& lambda, Real factor,
                                std::span<NodalVector> w) const {
  scatter<true>(lambda, factor, w);
}

void Constraints::solve(std::vector<Real>& b) const {
  if (alike_ == 1) return factors_.solve(b);
  std::fill(at_place_.begin(), at_place_.end(), Lanes::zero());
  for (Index r = 0; r < rows(); ++r) at(at_place_, r / alike_).set(r % alike_, at(b, r));
  factors_.solve(std::span(at_place_));
  for (Index r = 0; r < rows(); ++r) at(b, r) = at(at_place_, r / alike_)[r % alike_];
}

void Constraints::project(std::span<NodalVector> w) {
  apply(w, a_);
  solve(a_);
  add_over_mass(a_, -1, w);
}

void Constraints::balance(std::span<NodalVector> force, std::vector<Real>& lambda) const {
  apply_over_mass(force, lambda);
  for (Real& x : lambda) x = -x;
  solve(lambda);
  add_transposed(lambda, 1, force);
}

void Constraints::rates(Real time, Real h, bool begins) {
  targets(time, g_);
  targets(time + h, ahead_);
  targets(begins ? time + 2 * h : time - h, behind_);
  for (std::size_t r = 0; r < g_.size(); ++r) {
    rate_[r] = begins ? (4 * ahead_[r] - 3 * g_[r] - behind_[r]) / (2 * h)
                      : (ahead_[r] - behind_[r]) / (2 * h);
    acceleration_[r] =
        (begins ? behind_[r] - 2 * ahead_[r] + g_[r] : ahead_[r] - 2 * g_[r] + behind_[r]) /
        (h * h);
  }
}

void Constraints::make_consistent(State& state) {
  for (const auto& one : all_) one->begin(state.u);
  Real h = unbounded;
  for (const auto& one : all_) h = std::min(h, one->moment());
  rates(state.time, h, true);
  for (const auto& [wanted, field] : {std::pair(&g_, &state.u), std::pair(&rate_, &state.v)}) {
    apply(*field, a_);
    for (std::size_t r = 0; r < a_.size(); ++r) a_[r] = (*wanted)[r] - a_[r];
    solve(a_);
    add_over_mass(a_, 1, *field);
  }
}

void Constraints::begin(State& state) {
  apply_over_mass(state.force, a_);
  std::vector<Real>& lambda = state.reactions.force;
  for (std::size_t r = 0; r < lambda.size(); ++r) lambda[r] = acceleration_[r] - a_[r];
  solve(lambda);
  add_transposed(lambda, 1, state.force);
}

void Constraints::find_places(const State& state, Real back) const {
  for_each_of(static_cast<Index>(start_.size()) - 1, [&](Index k) {
    Lanes x = at(X_, k);
    for (Offset e = at(start_, k); e < at(start_, k + 1); ++e) {
      const Index A = at(particle_, e);
      x += at(weight_, e) * (at(state.u, A) - back * at(state.v, A));
    }
    at(at_place_, k) = x;
  });
}

/// Books the work of impulses: an impulse p per row changes the kinetic energy by p . (C v before +
/// C v after) / 2.
void Constraints::book(State& state, const std::vector<Real>& impulse,
                       const std::vector<Real>& before, const std::vector<Real>& after) const {
  for (const auto& one : all_) {
    Real work = 0;
    Eigen::Vector3d all = Eigen::Vector3d::Zero(), turn = all;
    for (Index r = one->first; r < one->first + one->rows.size(); ++r) {
      work += at(impulse, r) * (at(before, r) + at(after, r)) / 2;
      const Eigen::Vector3d of_row = spatial(at(impulse, r) * at(row_, r).direction);
      if (!one->rows.differences) all += of_row;
      turn += cross(spatial(at(at_place_, at(row_, r).place)), of_row);
    }
    at(state.reactions.work, one->number) += work;
    state.books.external_work += work;
    state.books.push({all, turn}, 1);
  }
}

void Constraints::constrain(State& state, Real dt) {
  targets(state.time, g_);
  apply(state.u, a_);
  for (std::size_t r = 0; r < a_.size(); ++r) a_[r] = (g_[r] - a_[r]) / (dt * dt);
  apply(state.v, after_);
  apply_over_mass(state.force, before_);
  for (std::size_t r = 0; r < a_.size(); ++r) {
    before_[r] = after_[r] - dt / 2 * before_[r];  // C v before the half kick
    after_[r] += dt * a_[r];
  }
  solve(a_);
  add_over_mass(a_, dt, state.v);
  add_over_mass(a_, dt * dt, state.u);
  for (std::size_t r = 0; r < a_.size(); ++r) a_[r] = dt * (state.reactions.force[r] / 2 + a_[r]);
  find_places(state, dt);  // positions at the beginning of the step
  book(state, a_, before_, after_);
}

void Constraints::react(State& state, Real dt) {
  rates(state.time, dt, false);
  apply(state.v, before_);
  apply_over_mass(state.force, a_);
  std::vector<Real>& lambda = state.reactions.force;
  for (std::size_t r = 0; r < a_.size(); ++r) {
    lambda[r] = acceleration_[r] - a_[r];
    after_[r] = before_[r] + dt / 2 * acceleration_[r];
  }
  solve(lambda);
  add_transposed(lambda, 1, state.force);
  for (std::size_t r = 0; r < a_.size(); ++r) a_[r] = dt / 2 * lambda[r];
  find_places(state, 0);
  book(state, a_, before_, after_);
}

void Constraints::prescribe(std::span<const NodalVector> half, Real time, Real dt,
                            std::span<NodalVector> v) {
  rates(time, dt, false);
  apply(half, before_);
  apply(v, a_);
  for (std::size_t r = 0; r < a_.size(); ++r)
    a_[r] = before_[r] + dt / 2 * acceleration_[r] - a_[r];
  solve(a_);
  add_over_mass(a_, 1, v);
}

bool Constraints::hold_any(Index first, Index count) const {
  const auto next = std::lower_bound(touched_.begin(), touched_.end(), first);
  return next != touched_.end() && *next < first + count;
}

void Constraints::restore_velocities(State& state) {
  apply(state.v, before_);
  for (std::size_t r = 0; r < a_.size(); ++r) a_[r] = rate_[r] - before_[r];
  solve(a_);
  add_over_mass(a_, 1, state.v);
  find_places(state, 0);
  book(state, a_, before_, rate_);
}

std::size_t Constraints::bytes() const {
  return factors_.bytes() +
         (weight_.size() + touched_weight_.size()) * (sizeof(Real) + sizeof(Index));
}

}  // namespace meniscus
