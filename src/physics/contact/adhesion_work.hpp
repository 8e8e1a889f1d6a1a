// SPDX-License-Identifier: BSD-3-Clause
// Work supplied from outside by adhesion that changes with time.
#pragma once
#include "physics/contact/adhesion.hpp"
#include "state/archive.hpp"

#include <optional>

namespace meniscus {

/// Work on areas in contact whose positions are held: from the middle of the step to its end, and
/// from its end to the middle of the next step.
struct AdhesionSupply {
  Real supplied = 0, ahead = 0;

  friend AdhesionSupply operator+(const AdhesionSupply& a, const AdhesionSupply& b) {
    return {a.supplied + b.supplied, a.ahead + b.ahead};
  }
};

/// Sums the work of adhesion. With the energies e of unit adhesion at the times t_n of steps, and
/// times m_n half a step after each, a step adds
///
///   sum of e_n (W(t_n) - W(m_n-1)) and e_n-1 (W(m_n-1) - W(t_n-1)), kept from the last step.
///
/// So all changes of W are counted, jumps included, for any step size (wetting note 3).
class AdhesionWork {
 public:
  /// Has to be called at the begin of a run.
  void begin(Real time) {
    if (!middle_) middle_ = committed_ = time;
  }
  /// The work on an area at x with the energy e of unit adhesion; `now` is the adhesion at `time`.
  AdhesionSupply supply(const AdhesionPattern& W, const Eigen::Vector3d& x, Real now, Real e,
                        Real time) const {
    return {e * (now - W(x, middle_.value_or(time))), e * (W(x, middle_after(time)) - now)};
  }
  /// Work since the last accepted step.
  Real since_step(const AdhesionSupply& supply) const { return kept_ + supply.supplied; }
  /// Accepts the step to `time`, which has this supply.
  void commit(Real time, const AdhesionSupply& supply) {
    middle_ = middle_after(time);
    committed_ = time;
    kept_ = supply.ahead;
  }
  /// D: dimension of the scene, which sets the unit of energies.
  void archive(const Archive& a, int D) {
    a("committed", committed_, dimension::time);
    a("middle", middle_, dimension::time);
    a("kept_work", kept_, of_sum(dimension::energy, D));
  }

 private:
  /// The time half a step after `time`, for steps as long as the one to `time`.
  Real middle_after(Real time) const { return time + (time - committed_.value_or(time)) / 2; }

  std::optional<Real> committed_;  // time of the last accepted step
  std::optional<Real> middle_;     // half a step after it
  Real kept_ = 0;                  // work between both times
};

}  // namespace meniscus
