// SPDX-License-Identifier: BSD-3-Clause
// The work that adhesion supplies from outside where it changes with time.
#pragma once
#include "meniscus/core/archive.hpp"
#include "meniscus/physics/adhesion.hpp"

#include <optional>

namespace meniscus {

/// Of areas in contact: while places are held, since the middle of the step and until that of the
/// next one.
struct AdhesionSupply {
  Real supplied = 0, ahead = 0;

  friend AdhesionSupply operator+(const AdhesionSupply& a, const AdhesionSupply& b) {
    return {a.supplied + b.supplied, a.ahead + b.ahead};
  }
};

/// With the energies e of unit adhesion at the times t_n of steps and a time m_n half a step after
/// each,
///   sum of e_n (W(t_n) - W(m_n-1)), this step, and e_n-1 (W(m_n-1) - W(t_n-1)), kept since the
/// last one: all changes of W add up, also jumps, whatever the steps are (wetting note 3).
class AdhesionWork {
 public:
  /// A run begins.
  void begin(Real time) {
    if (!middle_) middle_ = committed_ = time;
  }
  /// Of an area at x, where the adhesion is `now` at `time`.
  AdhesionSupply supply(const AdhesionPattern& W, const Eigen::Vector3d& x, Real now, Real e,
                        Real time) const {
    return {e * (now - W(x, middle_.value_or(time))), e * (W(x, middle_after(time)) - now)};
  }
  /// Since the last step that stands.
  Real since_step(const AdhesionSupply& supply) const { return kept_ + supply.supplied; }
  /// The step to `time`, with this supply, stands.
  void commit(Real time, const AdhesionSupply& supply) {
    middle_ = middle_after(time);
    committed_ = time;
    kept_ = supply.ahead;
  }
  /// Energies are those of D dimensions.
  void archive(const Archive& a, int D) {
    a("committed", committed_, dimension::time);
    a("middle", middle_, dimension::time);
    a("kept_work", kept_, of_sum(dimension::energy, D));
  }

 private:
  /// Half a step, as long as that to `time`, after it.
  Real middle_after(Real time) const { return time + (time - committed_.value_or(time)) / 2; }

  std::optional<Real> committed_;  // time of the last step that stands
  std::optional<Real> middle_;     // half a step after that
  Real kept_ = 0;                  // work between both
};

}  // namespace meniscus
