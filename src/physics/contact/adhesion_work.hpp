// SPDX-License-Identifier: BSD-3-Clause
// External work of an adhesion that changes with time.
#pragma once
#include "physics/contact/adhesion.hpp"
#include "state/archive.hpp"

#include <optional>

namespace meniscus {

/// Work of a changing adhesion on areas in contact whose positions are fixed: `supplied` from the
/// middle of the last step to its end, `ahead` from there to the middle of the next step.
struct AdhesionSupply {
  Real supplied = 0, ahead = 0;

  friend AdhesionSupply operator+(const AdhesionSupply& a, const AdhesionSupply& b) {
    return {a.supplied + b.supplied, a.ahead + b.ahead};
  }
};

/// Sums the work of adhesion. Let e_n be the energy at unit adhesion at the time t_n of step n, and
/// m_n the time half a step later. A step adds
///
///   sum of e_n (W(t_n) - W(m_n-1)) and e_n-1 (W(m_n-1) - W(t_n-1)), kept from the last step.
///
/// So every change of W, including jumps, is counted for any step size (wetting note 3).
class AdhesionWork {
 public:
  /// Sets the start time; must be called at the beginning of a run.
  void begin(Real time) {
    if (!middle_) middle_ = committed_ = time;
  }
  /// Work on an area at position x with the energy e at unit adhesion; `now` is the adhesion at
  /// `time`.
  AdhesionSupply supply(const AdhesionPattern& W, const Eigen::Vector3d& x, Real now, Real e,
                        Real time) const {
    return {e * (now - W(x, middle_.value_or(time))), e * (W(x, middle_after(time)) - now)};
  }
  /// Work since the last accepted step.
  Real since_step(const AdhesionSupply& supply) const { return kept_ + supply.supplied; }
  /// Accepts the step that ends at `time` and has this supply.
  void commit(Real time, const AdhesionSupply& supply) {
    middle_ = middle_after(time);
    committed_ = time;
    kept_ = supply.ahead;
  }
  /// D: dimension of the scene, which determines the unit of energies.
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
