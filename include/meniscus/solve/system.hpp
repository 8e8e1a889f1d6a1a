// SPDX-License-Identifier: BSD-3-Clause
// System: bodies, force terms, and the state that changes in time.
#pragma once
#include "meniscus/body/body.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/physics/force_term.hpp"

#include <deque>
#include <memory>

namespace meniscus {

/// A step ended where forces make no sense but those of a shorter step may.
struct StepRejected : SolveError {
  using SolveError::SolveError;
};

/// Heat and work so far, and the powers of now that go on into the next step.
struct Books {
  Real dissipated = 0;     ///< heat so far
  Real external_work = 0;  ///< work of the outside world so far
  Real heat = 0;           ///< power turned into heat
  Real external_power = 0, load_power = 0;  ///< of Report and ForceTerm

  /// The powers at the beginning of a run.
  void begin(const Report& report, Real load_power);
  /// A step of dt ended with these powers.
  void add(const Report& report, Real load_power, Real dt);
};

/// What changes from step to step. A run continues bit for bit from a copy of it.
struct State {
  Real time = 0;
  std::int64_t step = 0;
  NodalVectors u, v;   ///< displacement and velocity coefficients at `time`
  NodalVectors force;  ///< at u and the velocity of the last half step
  Books books;
  StepDemand demand;  ///< of all terms on the next step

  Motion motion() const { return {time, u, v}; }
};

template <int D>
struct System {
  std::deque<Body<D>> bodies;
  std::vector<std::unique_ptr<ForceTerm>> terms;
  std::vector<Real> mass;  ///< of all particles, bodies one after the other

  Index size() const { return static_cast<Index>(mass.size()); }
  bool viscous() const;
  std::size_t bytes() const;  ///< held by the terms

  /// Forces of all terms. Throws SolveError naming body, particle, place and cause where a term
  /// cannot compute one (J <= 0) or a force is not a number, StepRejected if a shorter step may
  /// help; `force` is then not to be used.
  Report compute_forces(const Motion& motion, Forces force);

  /// Same, without the checks: for trial motions of the time-step estimate.
  Report add_up(const Motion& motion, Forces force);

  /// Of all terms.
  Real load_power(const Motion& motion);
  void commit(const Motion& motion);

  /// The body that holds a particle.
  const Body<D>& body_of(Index particle) const;
};

}  // namespace meniscus
