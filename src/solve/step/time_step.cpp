// SPDX-License-Identifier: BSD-3-Clause
// Estimates the stable step of central differences from trial changes of the state.
#include "solve/step/time_step.hpp"

#include "meniscus/error.hpp"
#include "parallel/followed_particles.hpp"
#include "parallel/nodal_algebra.hpp"
#include "solve/least_spacing.hpp"
#include "solve/stiffest_term.hpp"

#include <algorithm>
#include <cmath>

namespace meniscus {
namespace {

constexpr int most_iterations = 300;
/// Largest difference of two responses that count as equal, anywhere and relative to M p. It
/// corresponds to about three times this share of the largest rates.
constexpr Real same_response = 5e-3;
/// Sizes of trial displacements, in units of the spacing. They are so small that differences are
/// derivatives. Where forces jump, larger sizes are tried.
constexpr Real smallest_trial = 1e-6, widest_trial = 1e-2, wider = 100;

/// Extrapolates the limit, which falls from iteration to iteration and finally like a geometric
/// series: the remaining fall is subtracted.
struct FallingLimit {
  Real dt = 0, last_fall = 0;
  Real scale = 1;  ///< limit / extrapolated limit
  int settled = 0;

  static constexpr Real tolerance = 2e-3;

  void add(Real limit) {
    const Real fall = dt - limit, slope = last_fall - fall;
    const Real left =
        fall > 0 && slope > 0 ? std::min(fall * fall / slope, 0.1 * limit) : std::abs(fall);
    settled = left < tolerance * limit ? settled + 1 : 0;
    last_fall = fall;
    dt = limit;
    scale = limit / (limit - std::min(left, 0.1 * limit));
  }
  bool found() const { return settled >= 4; }
};

/// A start vector with all wavelengths, the same on every machine; only followed particles are set.
void make_rough(const FollowedParticles& particles, std::span<NodalVector> mode, int components) {
  std::uint64_t bits = 0x9e3779b97f4a7c15;
  for (Index A = 0; A < static_cast<Index>(mode.size()); ++A) {
    NodalVector w = Lanes::zero();
    for (int i = 0; i < components; ++i) {
      bits ^= bits << 13;
      bits ^= bits >> 7;
      bits ^= bits << 17;
      w.set(i, static_cast<Real>(bits >> 11) * 0x1p-52 - 1);
    }
    if (particles.follows(A)) at(mode, A) = w;
  }
}

NodalVectors rough_mode(Index n, int components) {
  NodalVectors mode(static_cast<std::size_t>(n));
  make_rough({}, mode, components);
  return mode;
}

}  // namespace

void StableStep::archive(const Archive& a) {
  a("dt", dt, dimension::time);
  a("stiffness", stiffness, dimension::rate);
  a("viscosity", viscosity, dimension::rate);
  a("of_fields", of_fields, dimension::time);
  const Real limit = ModeRates{stiffness * stiffness, viscosity}.longest_step();
  require_saved(stiffness >= 0 && viscosity >= 0 && of_fields > 0 && dt > 0 &&
                    dt <= std::min(limit * (1 + 1e-9), of_fields),
                a, "stable/dt");
}

template <int D>
StableStepEstimator<D>::StableStepEstimator(System<D>& system, bool viscous)
    : system_(system),
      viscous_counts_(viscous),
      may_jump_(std::any_of(
          system.terms.begin(), system.terms.end(),
          [](const std::unique_ptr<ForceTerm>& term) { return term->may_reject_steps(); })),
      spacing_(least_spacing(system.bodies)),
      trial_size_(smallest_trial),
      critical_(system.mass, system.followed),
      mode_(rough_mode(system.size(), D)),
      trial_force_(mode_.size()),
      known_response_(mode_.size(), Lanes::zero()),
      response_(mode_.size()) {
  for (const Unknown& field : system.fields)
    field_modes_.push_back(rough_mode(system.size(), field.spec.components));
}

template <int D>
void StableStepEstimator<D>::list_reads(StepReads& reads) {
  reads.keeps(mode_);
  reads.keeps(known_response_);
}

template <int D>
Real StableStepEstimator<D>::largest(std::span<const NodalVector> w) const {
  return system_.followed.largest(w);
}

template <int D>
void StableStepEstimator<D>::archive(const Archive& a) {
  a("mode", mode_, D);
  a("mode_limit", mode_limit_, dimension::time);
  a("response_step", response_step_, dimension::time);
  a("response", known_response_, D);
  require_saved(mode_limit_ >= 0 && response_step_ >= 0, a, "response_step");
  for (std::size_t k = 0; k < field_modes_.size(); ++k)
    a.in("field_modes")(system_.fields[k].spec.name, field_modes_[k],
                        system_.fields[k].spec.components);
}

/// Computes K w from a displacement of at most `size` spacings.
template <int D>
void StableStepEstimator<D>::find_stiff_forces(const State& state, Real size, TrialMode& trial) {
  const Real du = size * spacing_ / largest(trial.w);
  trial.Kw.resize(trial.w.size());
  force_change(state, trial.w, du, 0, du, trial.Kw);
}

/// Computes C w from a velocity whose displacement in the time 1 / `rate` is equally large. If
/// `rate` is 0, the time is 1.
template <int D>
void StableStepEstimator<D>::find_viscous_forces(const State& state, Real rate, TrialMode& trial) {
  const Real dv = smallest_trial * spacing_ / largest(trial.w) * (rate > 0 ? rate : 1);
  trial.Cw.resize(trial.w.size());
  force_change(state, trial.w, 0, dv, dv, trial.Cw);
}

/// Computes result = - (f(u + du w, v + dv w) - f(u, v)) / size.
template <int D>
void StableStepEstimator<D>::force_change(const State& state, std::span<const NodalVector> w,
                                          Real du, Real dv, Real size,
                                          std::span<NodalVector> result) {
  u_.resize(w.size());
  v_.resize(w.size());
  system_.for_particles([&](Index begin, Index end) {
    for (Index A = begin; A < end; ++A) {
      at(u_, A) = at(state.u, A) + du * at(w, A);
      at(v_, A) = viscous_counts_ ? at(state.v, A) + dv * at(w, A) : Lanes::zero();
    }
  });
  std::span<const Unknown> fields = state.fields;
  if (!system_.carried.empty()) {
    carry_trial(state);
    fields = trial_;
  }
  system_.add_up({state.time, u_, v_, fields}, {result, trial_});
  system_.for_particles([&](Index begin, Index end) {
    for (Index A = begin; A < end; ++A) at(result, A) = (1 / size) * (at(base_, A) - at(result, A));
  });
}

/// Transports carried fields to the trial positions. With fields that stay behind, limits would be
/// several times too long.
template <int D>
void StableStepEstimator<D>::carry_trial(const State& state) {
  for (const auto& carried : system_.carried) {
    NodalVectors& x = at(trial_, carried->number()).x;
    const auto own = carried->part(std::span(x));
    const auto now = carried->part(std::span(at(state.fields, carried->number()).x));
    std::copy(now.begin(), now.end(), own.begin());
    carried->carry(carried->part(std::span(state.u)).data(), carried->part(std::span(u_)).data(),
                   own);
  }
}

/// Limit of the motion without other fields. The iteration starts from the last mode found.
template <int D>
StableStep StableStepEstimator<D>::limit_of_motion(const State& state) {
  const bool viscous = viscous_counts_ && system_.viscous();
  critical_.begin(mode_);
  StableStep best{0, 0, 0, 1};
  FallingLimit falling;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    TrialMode& trial = critical_.trial;
    const Real size = largest(trial.w);
    if (!(size > 0) || !std::isfinite(size)) break;
    find_stiff_forces(state, trial_size_, trial);
    if (viscous)
      find_viscous_forces(state, std::sqrt(std::abs(critical_.rates(trial).stiffness)), trial);
    best.evaluations += viscous ? 2 : 1;
    critical_.include_trial(falling.dt);

    const ModeRates found = critical_.rates(critical_.mode);
    const Real k = std::abs(found.stiffness), c = std::max(0.0, found.viscosity);
    const Real limit = ModeRates{k, c}.longest_step();
    if (!std::isfinite(limit)) break;
    if (iteration == 0 && std::abs(limit - mode_limit_) < FallingLimit::tolerance * limit) {
      // The mode may have changed elsewhere in the bodies.
      start_where_it_changed();
      continue;
    }
    falling.add(limit);
    mode_limit_ = limit;
    best = {limit / falling.scale, falling.scale * std::sqrt(k), falling.scale * c,
            best.evaluations};
    if (falling.found()) break;
    critical_.propose_trial(limit);
    if (system_.constraints) system_.constraints->project(critical_.trial.w);
  }
  if (!critical_.mode.w.empty()) system_.followed.copy(critical_.mode.w, mode_);
  return best;
}

/// Limit of the motion. A limit below `doubtful` that is caused by a jump of the force is searched
/// again with larger trial displacements.
template <int D>
StableStep StableStepEstimator<D>::limit_without_jumps(const State& state, Real doubtful) {
  if (!may_jump_) return limit_of_motion(state);
  start_ = mode_;
  StableStep best = limit_of_motion(state);
  while (best.dt < doubtful && trial_size_ < widest_trial && !is_smooth(state, best)) {
    trial_size_ *= wider;
    mode_ = start_;
    mode_limit_ = 0;
    const int spent = best.evaluations;
    best = limit_of_motion(state);
    best.evaluations += spent;
  }
  trial_size_ = smallest_trial;
  return best;
}

/// True if the last mode has about the same stiffness for a larger trial displacement.
template <int D>
bool StableStepEstimator<D>::is_smooth(const State& state, StableStep& found) {
  constexpr Real about = 1.5;
  TrialMode& trial = critical_.trial;
  system_.followed.copy(mode_, trial.w);
  if (!(largest(trial.w) > 0)) return true;
  find_stiff_forces(state, wider * trial_size_, trial);
  ++found.evaluations;
  const Real k = std::abs(critical_.rates(trial).stiffness);
  return !(ModeRates{k, found.viscosity}.longest_step() > about * found.dt);
}

/// Starts from the last mode plus the change of the responses, scaled to the same length.
template <int D>
void StableStepEstimator<D>::start_where_it_changed() {
  NodalScratch& change = trial_force_;
  system_.for_particles([&](Index begin, Index end) {
    for (Index A = begin; A < end; ++A)
      at(change, A) = (1 / at(system_.mass, A)) * (at(known_response_, A) - at(response_, A));
  });
  const Real scale =
      std::sqrt(system_.followed.dot(mode_, mode_) / system_.followed.dot(change, change));
  system_.for_particles([&](Index begin, Index end) {
    for (Index A = begin; A < end; ++A) at(mode_, A) += scale * at(change, A);
  });
  if (system_.constraints) system_.constraints->project(mode_);
  critical_.begin(mode_);
}

template <int D>
void StableStepEstimator<D>::find_response(const State& state, std::span<NodalVector> response) {
  NodalScratch& rough = trial_force_;
  make_rough(system_.followed, rough, D);
  if (system_.constraints) system_.constraints->project(rough);
  const Real dt = response_step_, size = smallest_trial * spacing_ / largest(rough) / (dt * dt / 4);
  const bool viscous = viscous_counts_ && system_.viscous();
  force_change(state, rough, size * dt * dt / 4, viscous ? size * dt / 2 : 0, size, response);
}

template <int D>
void StableStepEstimator<D>::know_response(const State& state, Real dt) {
  response_step_ = dt;
  find_response(state, known_response_);
}

template <int D>
bool StableStepEstimator<D>::responds_as_before(Real tolerated) const {
  const Index others = system_.sum_over_particles(Index{0}, [&](Index A) {
    const Lanes change = (1 / at(system_.mass, A)) * (at(response_, A) - at(known_response_, A));
    return Index{!(sum(change * change) < tolerated * tolerated)};  // true for NaN, too
  });
  return others == 0;
}

/// Computes the forces at the given state, from which changes are measured.
template <int D>
void StableStepEstimator<D>::find_base_forces(const State& state) {
  base_.resize(mode_.size());
  trial_ = state.fields;
  v_.resize(mode_.size());
  system_.for_particles([&](Index begin, Index end) {
    for (Index A = begin; A < end; ++A)
      at(v_, A) = viscous_counts_ ? at(state.v, A) : Lanes::zero();
  });
  system_.add_up({state.time, state.u, v_, state.fields}, {base_, trial_});
  base_fields_.resize(trial_.size());
  for (std::size_t k = 0; k < trial_.size(); ++k) base_fields_[k] = trial_[k].f;
}

template <int D>
StableStep StableStepEstimator<D>::estimate(const State& state) {
  find_base_forces(state);
  mode_limit_ = 0;
  const StableStep found = limit_from_base(state, unbounded);
  if (state.fields.empty()) know_response(state, found.dt);
  return found;
}

template <int D>
StableStep StableStepEstimator<D>::estimate_again(const State& state, const StableStep& before) {
  if (response_step_ == 0) return estimate(state);
  if (system_.viscous() || system_.constraints) {
    // The force of the state belongs to another velocity or contains reactions.
    find_base_forces(state);
  } else {
    base_.resize(mode_.size());
    system_.followed.copy(state.force, base_);
  }
  find_response(state, response_);
  if (responds_as_before(same_response)) {
    StableStep same = before;
    same.evaluations = 1;
    same.steady = responds_as_before(0.1 * same_response);
    return same;
  }
  system_.for_particles([&](Index begin, Index end) {
    std::swap_ranges(known_response_.begin() + begin, known_response_.begin() + end,
                     response_.begin() + begin);
  });
  constexpr Real collapsed = 0.5;  // between two estimates
  const StableStep found = limit_from_base(state, collapsed * before.dt);
  if (std::abs(found.dt - response_step_) > 0.1 * response_step_) know_response(state, found.dt);
  return found;
}

template <int D>
StableStep StableStepEstimator<D>::limit_from_base(const State& state, Real doubtful) {
  // Normalise the mode: each iteration makes it a little longer, so that it would overflow in a
  // long run.
  const Real length = std::sqrt(system_.followed.dot(mode_, mode_));
  system_.for_particles([&](Index begin, Index end) {
    for (Index A = begin; A < end; ++A) at(mode_, A) /= length;
  });
  if (system_.constraints) system_.constraints->project(mode_);
  StableStep best = limit_without_jumps(state, doubtful);
  if (!system_.carried.empty())
    for (std::size_t k = 0; k < trial_.size(); ++k) trial_[k].x = state.fields[k].x;
  for (std::size_t k = 0; k < field_modes_.size(); ++k)
    if (at(state.fields, k).spec.evolution == Evolution::carried)
      set_stages(state, k);
    else
      best.of_fields = std::min(best.of_fields, field_limit(state, k));
  best.dt = std::min(best.dt, best.of_fields);
  if (!(best.dt > 0) || !std::isfinite(best.dt)) {
    // Throws a failure with the place if a cell is folded.
    system_.compute_forces(state.motion(), {base_, trial_});
    throw failure(
        "no stable time step can be found: the forces at the current state do not make "
        "sense (are all moduli positive and all cells unfolded?)",
        state);
  }
  return best;
}

template <int D>
StepError StableStepEstimator<D>::failure(std::string cause, const State& state) const {
  struct Stiffest {
    Real square;
    Index particle;
    Stiffest operator+(const Stiffest& b) const { return b.square > square ? b : *this; }
  };
  const Stiffest all = system_.sum_over_particles(Stiffest{-1, 0}, [&](Index A) {
    return Stiffest{sum(at(mode_, A) * at(mode_, A)), A};
  });
  if (const Real size = largest(mode_); size > 0 && std::isfinite(size))
    cause += describe_stiffest_term(system_, state, mode_, smallest_trial * spacing_ / size);
  return StepError(system_.located({all.particle, std::move(cause)}, state.motion()));
}

/// Sets the number of stages of a carried field from the limit of its relaxation. The field itself
/// does not limit the step.
template <int D>
void StableStepEstimator<D>::set_stages(const State& state, std::size_t number) {
  const auto forces = [&](Unknown& field) {
    for (const auto& carried : system_.carried) {
      if (carried->number() != number) continue;
      carried->held_force(carried->part(std::span(field.x)).data(),
                          carried->part(std::span(field.f)));
    }
  };
  for (const auto& carried : system_.carried)
    if (carried->number() == number) carried->hold_places(carried->part(std::span(state.u)).data());
  forces(trial_[number]);
  base_fields_[number] = trial_[number].f;
  const Real limit = field_limit(state, number, forces);
  for (const auto& carried : system_.carried)
    if (carried->number() == number) carried->set_limit(limit);
}

template <int D>
Real StableStepEstimator<D>::field_limit(const State& state, std::size_t number) {
  return field_limit(state, number, [&](Unknown&) {
    system_.add_up({state.time, state.u, state.v, trial_}, {trial_force_, trial_});
  });
}

/// Limit of a field: 2 / the largest rate of c x' = f, or 2 / the largest frequency of c x'' = f.
/// `forces` computes f of a trial field.
template <int D>
Real StableStepEstimator<D>::field_limit(const State& state, std::size_t number,
                                         const std::function<void(Unknown&)>& forces) {
  NodalVectors& mode = field_modes_[number];
  const Unknown& field = state.fields[number];
  Unknown& trial = trial_[number];
  FallingLimit falling;
  for (int iteration = 0; iteration < most_iterations && !falling.found(); ++iteration) {
    const Real length = std::sqrt(dot(mode, mode));
    for (NodalVector& w : mode) w /= length;
    const Real h = 1e-6 * field.spec.scale / largest(mode);
    for (Index A = 0; A < system_.size(); ++A) at(trial.x, A) = at(field.x, A) + h * at(mode, A);
    forces(trial);
    Real restoring = 0, weight = 0;
    for (Index A = 0; A < system_.size(); ++A) {
      const Lanes change = at(base_fields_[number], A) - at(trial.f, A);
      restoring += sum(at(mode, A) * change) / h;
      weight += at(field.capacity, A) * sum(at(mode, A) * at(mode, A));
      // Particles of bodies without the field have zero capacity and zero force.
      const Real c = at(field.capacity, A);
      at(mode, A) = c > 0 ? change / (h * c) : Lanes::zero();
    }
    const Real k = std::abs(restoring) / weight;
    if (!(k > 0)) break;  // no restoring force, hence no limit
    falling.add(field.spec.evolution == Evolution::inertial ? 2 / std::sqrt(k) : 2 / k);
  }
  trial.x = field.x;
  return falling.dt > 0 ? falling.dt / falling.scale : std::numeric_limits<Real>::max();
}

template class StableStepEstimator<2>;
template class StableStepEstimator<3>;

}  // namespace meniscus
