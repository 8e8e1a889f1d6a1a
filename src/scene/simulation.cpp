// SPDX-License-Identifier: BSD-3-Clause
// Beginning, advancing, saving and restoring a run.
#include "meniscus/scene/simulation.hpp"

#include "meniscus/core/error.hpp"
#include "meniscus/solve/central_difference.hpp"
#include "meniscus/solve/drop_measures.hpp"

#include <fmt/format.h>

namespace meniscus {
namespace {

template <int D>
void unpack(const Snapshot& snapshot, const char* name, NodalVectors& field) {
  std::vector<Real> values(field.size() * D);
  snapshot.copy_to(name, values);
  for (std::size_t A = 0; A < field.size(); ++A) {
    field[A] = Lanes::zero();
    for (int i = 0; i < D; ++i) field[A].set(i, values[A * D + static_cast<std::size_t>(i)]);
  }
}

std::span<const Real> three(const Eigen::Vector3d& x) {
  return {x.data(), 3};
}

}  // namespace

template <int D>
std::vector<Real> packed(const NodalVectors& field) {
  std::vector<Real> values;
  values.reserve(field.size() * D);
  for (const Lanes& x : field)
    for (int i = 0; i < D; ++i) values.push_back(x[i]);
  return values;
}

template <int D>
Simulation<D>::Simulation(Scene<D>& scene)
    : scene_(scene),
      state_(scene.initial),
      controller_(scene.system, {scene.time.step, scene.time.safety, scene.time.check_every,
                                 scene.time.step_place}) {
  if (scene.time.solver != "relax") return;
  relaxation_.emplace(scene.system, typename Relaxation<D>::Tolerances{scene.time.force_tolerance,
                                                                       scene.time.shape_tolerance});
  for (const auto& term : scene.system.terms)
    if (term->steady_after() >= scene.time.end)
      throw InputError(
          fmt::format("[time] solver = \"relax\": {} changes until t = {:.6g}, not before the end "
                      "{:.6g} of the "
                      "scene; there is no rest to be reached",
                      term->name(), term->steady_after(), scene.time.end));
}

template <int D>
void Simulation<D>::begin() {
  start(scene_.system, state_);
  controller_.begin(state_);
  audit_.begin(take_ledger(scene_.system, state_));
  if (relaxation_) relaxation_->begin(state_);
}

template <int D>
bool Simulation<D>::finished() const {
  return state_.time >= scene_.time.end || (relaxation_ && relaxation_->at_rest());
}

/// A step of dt or, if that is rejected, of a half of it, and so on.
template <int D>
void Simulation<D>::step(Real dt) {
  constexpr int most_halvings = 6;
  before_ = state_;
  for (int halvings = 0;; ++halvings) {
    last_step_ = dt;
    try {
      meniscus::advance(scene_.system, state_, dt);
      if (halvings > 0) controller_.shorten(dt);
      return;
    } catch (const StepRejected& e) {
      if (halvings == most_halvings)
        throw SolveError(fmt::format("{}; the step was halved {} times", e.what(), halvings));
      state_ = before_;
      dt /= 2;
    }
  }
}

template <int D>
void Simulation<D>::advance() {
  try {
    last_step_ = controller_.next(state_, scene_.time.end);
    if (scene_.steps_may_be_rejected)
      step(last_step_);
    else
      meniscus::advance(scene_.system, state_, last_step_);
    if (relaxation_) relaxation_->damp(state_, last_step_);
  } catch (const SolveError& e) {
    // The step left its broken forces; those of the places it was taken back to can be shown.
    scene_.system.add_up(state_.motion(), state_.force);
    throw SolveError(fmt::format("step {}, t = {:.9g}, dt = {:.4g}: {}", state_.step + 1,
                                 state_.time + last_step_, last_step_, e.what()));
  }
}

/// A surface smaller than that of the ball (2D: disk) of the same volume cannot be: its quadrature
/// has lost the shape.
template <int D>
void Simulation<D>::refuse_impossible_surfaces() const {
  constexpr Real bearable = 1e-3;
  for (const Drop<D>& drop : scene_.drops) {
    const Real area = drop.area(state_.motion()), volume = drop.volume(state_.motion());
    const Real ratio = isoperimetric_ratio<D>(area, volume);
    if (drop.inscribed || ratio >= 1 - bearable) continue;
    throw SolveError(fmt::format(
        "step {}, t = {:.9g}: body '{}' has the isoperimetric ratio {:.6f}: the {} {:.6g} of its "
        "surface tension is below the least possible {:.6g} for its {}. The surface is no longer "
        "resolved; use form = \"balanced\", finer particles, or a reference shape nearer to the "
        "present one",
        state_.step, state_.time, drop.body->name, ratio, D == 3 ? "area" : "circumference", area,
        area / ratio, D == 3 ? "volume" : "area"));
  }
}

template <int D>
Ledger Simulation<D>::audit_now() {
  refuse_impossible_surfaces();
  const Ledger ledger = take_ledger(scene_.system, state_);
  audit_.follow(scene_.system, state_, ledger);
  return ledger;
}

template <int D>
Snapshot Simulation<D>::snapshot() const {
  Snapshot s;
  s.add_reals("displacement", packed<D>(state_.u), scene_.units.symbol(dimension::length));
  s.add_reals("velocity", packed<D>(state_.v), scene_.units.symbol(dimension::velocity));
  s.add_reals("force", packed<D>(state_.force), scene_.symbol_of_sum(dimension::force));
  const Real numbers[] = {
      state_.time,
      state_.books.dissipated,
      state_.books.external_work,
      state_.books.heat,
      state_.books.external_power,
      last_step_,
      state_.demand.stiffness,
      state_.demand.longest,
      state_.books.load_power};
  s.add_reals("numbers", numbers);
  const std::int64_t step[] = {state_.step};
  s.add_integers("step", step);
  controller_.save(s);
  if (relaxation_) relaxation_->save(s);

  const Real scales[] = {audit_.initial_balance, audit_.energy_scale, audit_.momentum_scale,
                         audit_.angular_momentum_scale};
  s.add_reals("audit/scales", scales);
  s.add_reals("audit/momentum", three(audit_.initial_momentum));
  s.add_reals("audit/angular_momentum", three(audit_.initial_angular_momentum));
  for (const auto& [kind, energy] : audit_.initial_stored)
    s.add_reals("audit/stored/" + kind, {&energy, 1});
  return s;
}

template <int D>
void Simulation<D>::restore(const Snapshot& s) {
  unpack<D>(s, "displacement", state_.u);
  unpack<D>(s, "velocity", state_.v);
  unpack<D>(s, "force", state_.force);
  Real numbers[9];
  s.copy_to("numbers", numbers);
  state_.time = numbers[0];
  state_.books.dissipated = numbers[1];
  state_.books.external_work = numbers[2];
  state_.books.heat = numbers[3];
  state_.books.external_power = numbers[4];
  last_step_ = numbers[5];
  state_.demand = {numbers[6], numbers[7]};
  state_.books.load_power = numbers[8];
  state_.step = s.integer("step");
  controller_.restore(s);
  if (relaxation_) relaxation_->restore(s, state_);

  Real scales[4];
  s.copy_to("audit/scales", scales);
  audit_.initial_balance = scales[0];
  audit_.energy_scale = scales[1];
  audit_.momentum_scale = scales[2];
  audit_.angular_momentum_scale = scales[3];
  s.copy_to("audit/momentum", {audit_.initial_momentum.data(), 3});
  s.copy_to("audit/angular_momentum", {audit_.initial_angular_momentum.data(), 3});
  audit_.initial_stored.clear();
  for (const auto& [kind, energy] : take_ledger(scene_.system, state_).stored)
    audit_.initial_stored[kind] = s.real("audit/stored/" + kind);
}

template std::vector<Real> packed<2>(const NodalVectors&);
template std::vector<Real> packed<3>(const NodalVectors&);
template class Simulation<2>;
template class Simulation<3>;

}  // namespace meniscus
