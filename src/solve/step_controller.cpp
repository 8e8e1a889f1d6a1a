// SPDX-License-Identifier: BSD-3-Clause
// The time step as the body deforms.
#include "meniscus/solve/step_controller.hpp"

#include <fmt/format.h>

#include "meniscus/core/error.hpp"

namespace meniscus {

template <int D>
void StepController<D>::begin(const State& state) {
  stable_ = estimator_.estimate(state);
  first_limit_ = stable_.dt;
  next_check_ = state.step + choice_.check_every;
  if (choice_.fixed && *choice_.fixed > stable_.dt)
    throw InputError(fmt::format(
        "time.step = {:.6g} is above the stable step {:.6g} of the discretised system; use at most "
        "{:.3g}, or leave the key out to have it chosen",
        *choice_.fixed, stable_.dt, 0.9 * stable_.dt));
  step_ = choice_.fixed.value_or(choice_.safety * stable_.dt);
}

template <int D>
void StepController<D>::reconsider(const State& state) {
  stable_ = estimator_.estimate(state);
  next_check_ = state.step + choice_.check_every;
  if (stable_.dt < 1e-6 * first_limit_)
    throw SolveError(fmt::format("the stable time step has collapsed from {:.3g} to {:.3g}",
                                 first_limit_, stable_.dt));
  if (choice_.fixed) {
    if (!warned_ && step_ > 0.98 * stable_.dt) {
      warning_ = fmt::format("step {}: time.step = {:.4g} has reached the stable step {:.4g}",
                             state.step, step_, stable_.dt);
      warned_ = true;
    }
    return;
  }
  // Small changes are left alone: every change of step disturbs the energy balance a little.
  const Real wanted = choice_.safety * stable_.dt;
  if (step_ > 1.02 * wanted || step_ < 0.9 * wanted) step_ = wanted;
}

template <int D>
Real StepController<D>::next(const State& state, Real end) {
  if (state.step >= next_check_) reconsider(state);
  const Real left = end - state.time;
  if (left <= step_ * (1 + 1e-9)) return left;
  if (left < 2 * step_) return left / 2;
  return step_;
}

template <int D>
void StepController<D>::save(Snapshot& snapshot) const {
  const NodalVectors& mode = estimator_.mode();
  snapshot.add_reals("step_control/mode", {reinterpret_cast<const Real*>(mode.data()), 4 * mode.size()});
  const Real numbers[] = {step_, first_limit_, stable_.dt, stable_.stiffness, stable_.viscosity};
  snapshot.add_reals("step_control/numbers", numbers);
  const std::int64_t counts[] = {next_check_, warned_};
  snapshot.add_integers("step_control/counts", counts);
}

template <int D>
void StepController<D>::restore(const Snapshot& snapshot) {
  NodalVectors mode(estimator_.mode().size());
  snapshot.copy_to("step_control/mode", {reinterpret_cast<Real*>(mode.data()), 4 * mode.size()});
  estimator_.set_mode(std::move(mode));
  Real numbers[5];
  snapshot.copy_to("step_control/numbers", numbers);
  step_ = numbers[0];
  first_limit_ = numbers[1];
  stable_ = {numbers[2], numbers[3], numbers[4], 0};
  const auto& counts = snapshot.integers("step_control/counts");
  next_check_ = counts.at(0);
  warned_ = counts.at(1) != 0;
}

template class StepController<2>;
template class StepController<3>;

}  // namespace meniscus
