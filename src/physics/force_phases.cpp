// SPDX-License-Identifier: BSD-3-Clause
// Rounds of exchanges between the phases of terms.
#include "physics/force_phases.hpp"

#include <utility>

namespace meniscus {

Forces ForcePhases::begin(const Motion& motion, Forces force, const Everywhere* everywhere) {
  sums_.forget();
  waiting_.clear();
  gathered_.clear();
  failure_ = nullptr;
  motion_ = motion;
  everywhere_ = everywhere;
  force.pending = &sums_;
  force.phases = this;
  return force_ = force;
}

void ForcePhases::fail() {
  if (ranks().alone()) throw;
  if (!failure_) failure_ = std::current_exception();
}

void ForcePhases::later(std::span<const Gathered> arrays, Forces::Then then) {
  gathered_.insert(gathered_.end(), arrays.begin(), arrays.end());
  waiting_.push_back({report_, std::move(then)});
}

Motion ForcePhases::everywhere() {
  if (!everywhere_) return motion_;
  motion_ = (*everywhere_)(motion_);
  everywhere_ = nullptr;
  return motion_;
}

Failure shared(Failure failure) {
  if (ranks().alone()) return failure;
  const int first = ranks().first_true(failure.particle >= 0);
  failure.cause = ranks().of_rank(first, std::move(failure.cause));
  ranks().hand_out(first, &failure.particle, sizeof failure.particle);
  ranks().hand_out(first, &failure.of_step, sizeof failure.of_step);
  return failure;
}

void ForcePhases::finish() {
  do {
    gather_(gathered_, failure_);
    gathered_.clear();
    now_.clear();
    std::swap(now_, waiting_);
    for (Waiting& next : now_) run(*next.report, [&] { return next.then(motion_, force_); });
  } while (!waiting_.empty());
  if (failure_) std::rethrow_exception(failure_);
  sums_.complete();
}

}  // namespace meniscus
