// SPDX-License-Identifier: BSD-3-Clause
// The work that moves a rigid partner.
#pragma once
#include "state/archive.hpp"

namespace meniscus {

/// Work between accepted steps: the mean force of both times dot the displacement of the partner.
/// In the first step of a run only the force at its end is known and is used for the whole step.
/// The work is of second order in the step, also if a partner starts or stops and its power jumps.
class PartnerWork {
 public:
  /// Has to be called at the begin of a run, with the shift of the partner.
  void begin(const Eigen::Vector3d& shift) {
    if (!begun_) shift_ = shift;
    begun_ = true;
  }
  /// Work since the last accepted step, for the current shift of the partner and force on it.
  Real since_step(const Eigen::Vector3d& shift, const Eigen::Vector3d& force) const {
    return (stands_ ? (0.5 * (force_ + force)).eval() : force).dot(shift - shift_);
  }
  /// Accepts the step.
  void commit(const Eigen::Vector3d& shift, const Eigen::Vector3d& force) {
    shift_ = shift;
    force_ = force;
    stands_ = true;
  }
  /// D: dimension of the scene, which sets the unit of forces.
  void archive(const Archive& a, int D) {
    a("partner_begun", begun_);
    a("partner_stands", stands_);
    a("partner_shift", shift_, dimension::length);
    a("partner_force", force_, of_sum(dimension::force, D));
  }

 private:
  bool begun_ = false, stands_ = false;
  // At the last accepted step.
  Eigen::Vector3d shift_ = Eigen::Vector3d::Zero(), force_ = Eigen::Vector3d::Zero();
};

}  // namespace meniscus
