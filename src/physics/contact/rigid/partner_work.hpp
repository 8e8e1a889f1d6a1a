// SPDX-License-Identifier: BSD-3-Clause
// The work needed to move a rigid partner.
#pragma once
#include "state/archive.hpp"

namespace meniscus {

/// Work between accepted steps: the mean of the forces before and after the step, times the
/// displacement of the partner. In the first step of a run only the force at its end is known,
/// which is then used for the whole step. The work is second-order accurate in the step, also if a
/// partner starts or stops and its power jumps.
class PartnerWork {
 public:
  /// Sets the displacement of the partner; must be called at the beginning of a run.
  void begin(const Eigen::Vector3d& shift) {
    if (!begun_) shift_ = shift;
    begun_ = true;
  }
  /// Work since the last accepted step, for the present displacement of the partner and the force
  /// on it.
  Real since_step(const Eigen::Vector3d& shift, const Eigen::Vector3d& force) const {
    return (stands_ ? (0.5 * (force_ + force)).eval() : force).dot(shift - shift_);
  }
  /// Accepts the step.
  void commit(const Eigen::Vector3d& shift, const Eigen::Vector3d& force) {
    shift_ = shift;
    force_ = force;
    stands_ = true;
  }
  /// D: dimension of the scene, which determines the unit of forces.
  void archive(const Archive& a, int D) {
    a("partner_begun", begun_);
    a("partner_stands", stands_);
    a("partner_shift", shift_, dimension::length);
    a("partner_force", force_, of_sum(dimension::force, D));
  }

 private:
  bool begun_ = false, stands_ = false;
  // Values at the last accepted step.
  Eigen::Vector3d shift_ = Eigen::Vector3d::Zero(), force_ = Eigen::Vector3d::Zero();
};

}  // namespace meniscus
