// SPDX-License-Identifier: BSD-3-Clause
// Resultant: net force and net moment of the forces that act on the bodies from outside.
#pragma once
#include "numbers/types.hpp"

namespace meniscus {

/// Net force and net moment about the origin (2D: its third component). Forces between particles
/// add nothing to either.
struct Resultant {
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
  /// Sums of |force| and |moment| over what was added up, before they cancel.
  Real force_size = 0, moment_size = 0;

  Resultant() = default;
  Resultant(const Eigen::Vector3d& net_force, const Eigen::Vector3d& net_moment)
      : force(net_force),
        moment(net_moment),
        force_size(net_force.norm()),
        moment_size(net_moment.norm()) {}

  Resultant& operator+=(const Resultant& other) {
    force += other.force;
    moment += other.moment;
    force_size += other.force_size;
    moment_size += other.moment_size;
    return *this;
  }
  friend Resultant operator+(Resultant a, const Resultant& b) { return a += b; }
};

}  // namespace meniscus
