// SPDX-License-Identifier: BSD-3-Clause
// An interface of forces for Newton's method: the tangent as a matrix, and pressures (quasi-statics
// note 10).
#pragma once
#include "meniscus/physics/force_term.hpp"
#include "numbers/dual.hpp"
#include "physics/stiffness_matrix.hpp"

namespace meniscus {

/// An optional interface of a force term, for its part of the assembled tangent. All processes call
/// these functions.
///
/// The force may depend on pressures, and Newton's method can expect other pressures than the state
/// has: the numbers `off` are the pressures of a tangent less the pressures of the state. They are
/// in groups of up to four, one lane each.
class AssembledForce {
 public:
  virtual ~AssembledForce() = default;

  /// False if the tangent is not to be assembled. The next two functions are not called then.
  virtual bool has_stiffness() const { return true; }
  /// Announces the elements of the tangent. Called on the process that has the matrix.
  virtual void announce(StiffnessMatrix& K) = 0;
  /// Adds minus the tangent of the forces, with the pressures of the motion plus `off` (empty: 0).
  /// Unknowns other than displacements are to be eliminated (StiffnessMatrix::add_nodes()). Only
  /// one process has the matrix, and all rows (StiffnessMatrix::is_here()).
  virtual void add_stiffness(const Motion& motion, std::span<const Lanes> off,
                             StiffnessMatrix& K) = 0;

  /// The pressures, and their derivatives along a change. [group]
  virtual std::vector<Dual<Lanes>> pressures(const Motion&, const Motion&) { return {}; }
  /// force += the tangent of the forces of constant pressures `off`.
  virtual void add_pressure_tangent(const Motion&, const Motion&, std::span<const Lanes>, Forces) {}
  /// force -= the change of the forces of constant pressures `off` from a motion to motion +
  /// change.
  virtual void subtract_pressure_force(const Motion&, const Motion&, std::span<const Lanes>,
                                       Forces) {}
  /// The integral of |grad u|^2 over the reference volume of the body whose internal force this is.
  virtual Real squared_gradients(const Motion&) { return 0; }
};

}  // namespace meniscus
