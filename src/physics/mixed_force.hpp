// SPDX-License-Identifier: BSD-3-Clause
// An interface of internal forces for Newton's method: the tangent as a matrix, and the pressures
// (quasi-statics note 10).
#pragma once
#include "meniscus/physics/force_term.hpp"
#include "numbers/dual.hpp"
#include "physics/stiffness_matrix.hpp"

namespace meniscus {

/// An optional interface of a force term. Stress points are in groups of up to four, one lane each,
/// with the pressure p = P : F / (3 J) (positive in tension). The numbers `off` are the pressures
/// of a tangent less the pressures of the state. All processes call these functions, except
/// announce() and the elements of add_stiffness(), for which the process must have all groups.
class MixedForce {
 public:
  virtual ~MixedForce() = default;

  /// False if the tangent couples all particles, so that the other functions are not called.
  virtual bool has_stiffness() const = 0;
  /// The pressures, and their derivatives along a change. [group]
  virtual std::vector<Dual<Lanes>> pressures(const Motion& motion, const Motion& change) const = 0;
  /// force += the tangent of the forces of constant pressures `off`.
  virtual void add_pressure_tangent(const Motion& motion, const Motion& change,
                                    std::span<const Lanes> off, Forces force) = 0;
  /// force -= the change of the forces of constant pressures `off` from a motion to motion +
  /// change.
  virtual void subtract_pressure_force(const Motion& motion, const Motion& change,
                                       std::span<const Lanes> off, Forces force) = 0;
  /// The integral of |grad u|^2 over the reference volume.
  virtual Real squared_gradients(const Motion& motion) const = 0;

  /// Announces the elements of the tangent.
  virtual void announce(StiffnessMatrix& K) = 0;
  /// Adds minus the tangent of the forces, with the pressures of the motion plus `off` (empty: 0).
  /// Unknowns other than displacements are to be eliminated; the matrix has one negative eigenvalue
  /// for each of them.
  virtual void add_stiffness(const Motion& motion, std::span<const Lanes> off,
                             StiffnessMatrix& K) const = 0;
};

}  // namespace meniscus
