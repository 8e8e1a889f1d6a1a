// SPDX-License-Identifier: BSD-3-Clause
// Constraints: linear conditions on the displacements of particles, prescribed in time, such as
// held faces.
#pragma once
#include "numbers/types.hpp"

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace meniscus {

/// Rows of C in C u = g(t): row r says
///   direction_r . sum_A weight_kA u_A = g_r(t),   k = place_r.
/// Rows of several components share the weights of their place. The weights of a place sum to one,
/// so that lambda_r direction_r is the force of row r on its body.
struct ConstraintRows {
  struct Row {
    Index place;
    Eigen::Vector3d direction;  ///< of unit length
  };
  std::vector<Row> rows;
  std::vector<Eigen::Vector3d> X;  ///< [place] reference place
  std::vector<Offset> start{0};    ///< entries of a place: [start[k], start[k + 1])
  std::vector<Index> particle;     ///< [entry] number in the arrays of all bodies
  std::vector<Real> weight;        ///< [entry]

  Index size() const { return static_cast<Index>(rows.size()); }
  Index places() const { return static_cast<Index>(X.size()); }
};

/// One table of a scene that prescribes displacements.
class Constraint {
 public:
  /// What is called "held face 'grip'" in messages, and where its table stands, to begin them with.
  Constraint(std::string called, std::string stands, ConstraintRows its_rows)
      : rows(std::move(its_rows)), name(std::move(called)), place(std::move(stands)) {}
  virtual ~Constraint() = default;

  /// g(t), a number per row. The same bits whenever it is asked.
  virtual void targets(Real time, std::span<Real> g) = 0;
  /// From when on g is constant; infinite for one that never ceases to change.
  virtual Real steady_after() const = 0;
  /// A time in which g changes little, for its derivatives where no step is known.
  virtual Real moment() const = 0;

  const ConstraintRows rows;
  const std::string name, place;
  /// Number of the first row, and of the constraint, among those of the system.
  Index first = 0, number = 0;
};

/// What constraints do to the bodies, as part of the state.
struct Reactions {
  std::vector<Real> force;  ///< lambda, per row of all constraints: on the bodies
  std::vector<Real> work;   ///< on the bodies so far, per constraint
};

}  // namespace meniscus
