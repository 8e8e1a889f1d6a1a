// SPDX-License-Identifier: BSD-3-Clause
// Dynamic relaxation, and the test whether a state is at rest.
//
// Reasons for this damping: a cell that is deflated over 15 us (red blood cell note 9) has the
// force residual 8e-5 at 18 us and 2.6e-5 at 36 us. FIRE, whose mixing fades and hardly damps stiff
// vibrations, leaves 3e-4 and 1.2e-4. A bent plate of 756 particles starts with the energy 0.06. It
// still has 2e-4 after 2500 steps with zeta = 0.6, 3000 with zeta = 1, and 1500 with FIRE. Kinetic
// damping stops at every vibration of the stiffest modes and hardly flattens the plate in 5000
// steps.
//
// Reasons for intervals, time intervals in which the remaining motion is estimated: with 3464
// particles, the cell ends after 1246 steps. It ends after 2541 steps if its shape must not change
// over two quarter periods; the thickness ratio differs by 2e-4 only. Soft modes of the
// coefficients, which hardly move positions, need not come to rest.
#include "solve/step/relaxation.hpp"

#include "kernel/row_sums.hpp"
#include "numbers/box.hpp"
#include "parallel/nodal_algebra.hpp"
#include "parallel/parallel.hpp"
#include "solve/newton/newton_method.hpp"
#include "solve/step/central_difference.hpp"
#include "solve/step/pseudo_time.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meniscus {
template <int D>
Real kinetic_energy(const System<D>& system, const State& state) {
  return system.sum_over_particles(0.0, [&](Index A) {
    return 0.5 * at(system.mass, A) * sum(at(state.v, A) * at(state.v, A));
  });
}

template <int D>
Relaxation<D>::Relaxation(System<D>& system, const Tolerances& tolerances,
                          const std::vector<bool>& fluid)
    : system_(system), tolerances_(tolerances), fluids_(system, fluid) {
  const auto n = static_cast<std::size_t>(system.size());
  for (NodalVectors* field : {&last_u_, &last_force_, &interval_u_, &interval_force_, &du_, &df_})
    field->resize(n);
  for (const Body<D>& body : system.bodies)
    extents_.push_back(box_around<D>(body.particles.X()).extent().maxCoeff());
}

template <int D>
void Relaxation<D>::begin(const State& state) {
  settled_intervals_ = pulled_intervals_ = 0;
  shape_change_ = 1;
  open_interval(state, 0);
}

template <int D>
Real Relaxation<D>::steady_after() const {
  return system_.steady_after();
}

template <int D>
Real Relaxation<D>::energy_of_motion(const State& state) const {
  return kinetic_energy(system_, state);
}

template <int D>
void Relaxation<D>::step(State& state, Real dt) {
  system_.for_particles([&](Index begin, Index end) {
    std::copy(state.u.begin() + begin, state.u.begin() + end, last_u_.begin() + begin);
    std::copy(state.force.begin() + begin, state.force.begin() + end, last_force_.begin() + begin);
  });
  move(state, dt);
  damp(state, dt);
}

template <int D>
void Relaxation<D>::move(State& state, Real dt) {
  advance(system_, state, dt);
}

template <int D>
void Relaxation<D>::damp(State& state, Real dt) {
  const Real omega = change_of(sums_of_step(state)).omega;
  const Real factor = std::exp(-2 * damping_ratio * omega * dt);
  state.books.dissipated += (1 - factor * factor) * energy_of_motion(state);
  state.books.scale_momenta(factor);
  system_.for_particles([&](Index begin, Index end) {
    for (Index A = begin; A < end; ++A) at(state.v, A) *= factor;
  });
  follow_brake(state, factor, omega * dt);
  // Prescribed velocities are not damped.
  if (system_.constraints && state.time < system_.constraints->steady_after())
    system_.constraints->restore_velocities(state);
  // The power of loads is proportional to the velocity, the power of viscous forces to its square.
  state.books.load_power = system_.load_power(state.motion());
  state.books.heat *= factor * factor;
  judge(state, dt);
}

template <int D>
void Relaxation<D>::open_interval(const State& state, Real length) {
  interval_u_ = state.u;
  interval_force_ = state.force;
  begin_interval();
  interval_begin_ = state.time;
  interval_length_ = length;
}

template <int D>
void Relaxation<D>::judge(State& state, Real dt) {
  const Real elapsed = state.time - interval_begin_;
  const bool ramps_ended = interval_begin_ < steady_after() && state.time >= steady_after();
  if (!ramps_ended && elapsed < std::max(interval_length_, fewest_steps() * dt) * (1 - 1e-9))
    return;
  system_.complete(state);
  const Change change = judged_interval(state);
  const Real quarter = change.omega > 0 ? std::numbers::pi / (2 * change.omega) : 2 * elapsed;
  // An interval much shorter than the period of the observed mode gives no information.
  const bool shaped = interval_begin_ >= steady_after() && elapsed >= 0.25 * quarter &&
                      shape_change_ <= tolerances_.shape;
  const bool settled = shaped && force_residual(state) <= tolerances_.force;
  settled_intervals_ = settled ? settled_intervals_ + 1 : 0;
  pulled_intervals_ = shaped && !settled && pulled(state) ? pulled_intervals_ + 1 : 0;
  open_interval(state, ramps_ended ? 0 : std::min(0.5 * quarter, 2 * elapsed));
}

/// True if a net force pulls a body and no term can stop its drift.
template <int D>
bool Relaxation<D>::pulled(const State& state) const {
  return std::none_of(system_.terms.begin(), system_.terms.end(),
                      [](const auto& term) { return term->stops_drift(); }) &&
         !net_forces(system_, state).empty();
}

/// Least eigenvalue of the stiffness at rest. Relaxation of a symmetric scene never excites modes
/// that break the symmetry, and comes to rest at a symmetric state even if that is unstable. Empty
/// for fluids, for directors, for a term without potential, and for many particles.
template <int D>
std::optional<Real> Relaxation<D>::stability(const State& state) const {
  constexpr Index most_particles = D == 3 ? 1000 : 5000;  // their factors take a second
  const bool has_potential =
      std::all_of(system_.terms.begin(), system_.terms.end(),
                  [&](const auto& term) { return term->potential(state.motion()).has_value(); });
  if (!has_potential || fluids_.any() || !system_.fields.empty() || system_.size() > most_particles)
    return {};
  return NewtonMethod<D>(system_, nullptr, 1).find_stability(state.time, state.u);
}

template <int D>
typename Relaxation<D>::Change Relaxation<D>::judged_interval(const State& state) {
  for (Index A = 0; A < system_.size(); ++A) {
    at(du_, A) = at(state.u, A) - at(interval_u_, A);
    at(df_, A) = at(state.force, A) - at(interval_force_, A);
  }
  remove_free_drift(system_, state, df_, du_);
  for (Index A = 0; A < system_.size(); ++A)
    if (fluids_.holds(A)) at(du_, A) = at(df_, A) = Lanes::zero();
  Change change = change_of(sums_of_interval(state));
  shape_change_ = change.left * largest_change();
  if (!fluids_.any()) return change;

  const Real clock = fluids_.clock(uncancelled_force(state)),
             elapsed = state.time - interval_begin_;
  const Real flow = fluids_.change(interval_u_, state.u) / elapsed;
  // An oscillating fluid stays near a turning point for less than its time scale.
  const bool long_enough = elapsed >= clock * (1 - 1e-9);
  shape_change_ = std::max(shape_change_, long_enough ? flow * clock : 1.0);
  const Real slowest = std::numbers::pi / (4 * clock);  // gives intervals of the length `clock`
  change.omega = change.omega > 0 ? std::min(change.omega, slowest) : slowest;
  return change;
}

template <int D>
typename Relaxation<D>::ModeSums Relaxation<D>::sums_of_step(const State& state) const {
  return system_.sum_over_particles(Lanes::zero(), [&](Index A) {
    const Lanes du = at(state.u, A) - at(last_u_, A);
    const Lanes df = at(state.force, A) - at(last_force_, A);
    const Real mass = at(system_.mass, A);
    return Lanes(-sum(du * df), mass * sum(du * du), sum(du * at(state.force, A)),
                 mass * sum(du * at(state.v, A)));
  });
}

template <int D>
typename Relaxation<D>::ModeSums Relaxation<D>::sums_of_interval(const State& state) const {
  return system_.sum_over_particles(Lanes::zero(), [&](Index A) {
    const Lanes &du = at(du_, A), &df = at(df_, A);
    const Real mass = at(system_.mass, A);
    return Lanes(-sum(du * df), mass * sum(du * du), sum(du * at(state.force, A)),
                 mass * sum(du * at(state.v, A)));
  });
}

/// Change over an interval. The mode w = du has the stiffness k = - du.df and the mass m = du.M du
/// in the energy. The present force vanishes after a further motion of f.du/k times w, and the
/// velocity moves it by v.M du/sqrt(k m).
template <int D>
typename Relaxation<D>::Change Relaxation<D>::change_of(const ModeSums& sums) const {
  const Real k = sums[0], m = sums[1];
  if (m == 0) return {0, 0};
  if (k <= 0 || m < 0) return {0, 1 / tolerances_.shape};  // no restoring force
  return {std::sqrt(k / m), std::hypot(sums[2] / k, sums[3] / std::sqrt(k * m))};
}

template <int D>
Real Relaxation<D>::largest_change() const {
  Real largest = 0;
  for (std::size_t b = 0; b < system_.bodies.size(); ++b) {
    const Body<D>& body = system_.bodies[b];
    const ItemRange own = body.own_particles();
    Real square = 0;
    for (Index A = own.begin; A < own.end; ++A) {
      const Lanes moved = value_at(body.at_particles, A, du_.data() + body.first);
      square = std::max(square, sum(moved * moved));
    }
    largest = std::max(largest, std::sqrt(ranks().largest_size(square)) / extents_[b]);
  }
  return largest;
}

template <int D>
Real Relaxation<D>::uncancelled_force(const State& state) const {
  Real sum = 0;
  for (const auto& term : system_.terms) sum += term->uncancelled_force(state.motion());
  return sum;
}

template <int D>
Real Relaxation<D>::force_residual(const State& state) const {
  const Real uncancelled = uncancelled_force(state);
  if (!(uncancelled > 0)) return 0;
  Real left = parallel_sum(system_.size(), 0.0, [&](Index A) {
    if (fluids_.holds(A)) return 0.0;
    return std::sqrt(sum(at(state.force, A) * at(state.force, A)));
  });
  if (fluids_.any())
    left +=
        fluids_.force_of_power(state, fluids_.clock(uncancelled)) + fluids_.unbalanced_force(state);
  return left / uncancelled;
}

template <int D>
void Relaxation<D>::archive(const Archive& a, const State& state) {
  if (a.is_reading()) begin(state);  // sets the sizes
  a("window_displacement", interval_u_, D, dimension::length);
  a("window_force", interval_force_, D, of_sum(dimension::force, D));
  a("window_begin", interval_begin_, dimension::time);
  a("window_length", interval_length_, dimension::time);
  a("shape_change", shape_change_);
  a("settled_windows", settled_intervals_);
  a("pulled_windows", pulled_intervals_);
  require_saved(settled_intervals_ >= 0 && pulled_intervals_ >= 0, a, "settled_windows");
}

template <int D>
std::vector<Residual> Relaxation<D>::residuals(const State& state) const {
  return {{"force residual", force_residual(state), tolerances_.force},
          {"change of shape that is left", shape_change_, tolerances_.shape}};
}

namespace {

/// Refuses a scene in which `what` changes up to the time `until`, at or after its end.
[[noreturn]] void refuse_change(const StepperChoice& choice, const std::string& what, Real until) {
  const std::string how_long =
      std::isfinite(until) ? fmt::format("until t = {:.6g}, not before the end {:.6g} of the scene",
                                         until, choice.end)
                           : std::string("as long as the scene lasts");
  const std::string remedy =
      std::isfinite(until)
          ? "end its ramp earlier, or raise time.end"
          : "write its formulas without t, and give its table a ramp if it is to come slowly (a "
            "partner stops by a displacement such as \"-0.1*min(t, 1)\")";
  throw InputError(fmt::format(
      "{}: {} changes {}; there is no rest that \"relax\" could reach; {}, or use solver = "
      "\"dynamics\"",
      choice.place, what, how_long, remedy));
}

template <int D>
std::unique_ptr<Stepper<D>> make(System<D>& system, const StepperChoice& choice) {
  for (const auto& term : system.terms)
    if (term->steady_after() >= choice.end)
      refuse_change(choice, term->name(), term->steady_after());
  if (system.constraints && system.constraints->steady_after() >= choice.end)
    refuse_change(choice, "a displacement of [[held]]", system.constraints->steady_after());
  const typename Relaxation<D>::Tolerances tolerances{choice.force_tolerance,
                                                      choice.shape_tolerance};
  // A given step refers to the real masses, so no artificial inertia is used.
  if (!choice.step && is_thin_and_elastic(system, choice.fluid))
    return std::make_unique<PseudoTime<D>>(system, tolerances, choice.safety);
  return std::make_unique<Relaxation<D>>(system, tolerances, choice.fluid);
}

const bool registered =
    register_entry(StepperEntry{"relax", {"force_residual", "shape_change"}, make<2>, make<3>});

}  // namespace

template Real kinetic_energy(const System<2>&, const State&);
template Real kinetic_energy(const System<3>&, const State&);
template class Relaxation<2>;
template class Relaxation<3>;

}  // namespace meniscus
