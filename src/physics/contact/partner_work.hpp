// SPDX-License-Identifier: BSD-3-Clause
// The work of what moves a rigid partner.
#pragma once
#include "meniscus/core/archive.hpp"

namespace meniscus {

/// Between steps that stand: the mean of the forces at both times the way of the partner. A run
/// begins with no step that stands, and the force at the end of its first step counts for all of
/// it. Of second order in the step, also where a partner sets off or stops and its power jumps.
class PartnerWork {
 public:
  /// A run begins where the partner is.
  void begin(const Eigen::Vector3d& shift) {
    if (!begun_) shift_ = shift;
    begun_ = true;
  }
  /// Since the last step that stands, of a partner that is shifted by now and moved by this force.
  Real since_step(const Eigen::Vector3d& shift, const Eigen::Vector3d& force) const {
    return (stands_ ? (0.5 * (force_ + force)).eval() : force).dot(shift - shift_);
  }
  /// The step stands.
  void commit(const Eigen::Vector3d& shift, const Eigen::Vector3d& force) {
    shift_ = shift;
    force_ = force;
    stands_ = true;
  }
  /// Forces are those of D dimensions.
  void archive(const Archive& a, int D) {
    a("partner_begun", begun_);
    a("partner_stands", stands_);
    a("partner_shift", shift_, dimension::length);
    a("partner_force", force_, of_sum(dimension::force, D));
  }

 private:
  bool begun_ = false, stands_ = false;
  // At the last step that stands.
  Eigen::Vector3d shift_ = Eigen::Vector3d::Zero(), force_ = Eigen::Vector3d::Zero();
};

}  // namespace meniscus
