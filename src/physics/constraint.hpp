// SPDX-License-Identifier: BSD-3-Clause
// Constraints: linear conditions on displacements, prescribed as functions of time, e.g. held
// faces.
#pragma once
#include "numbers/types.hpp"
#include "state/archive.hpp"

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace meniscus {

/// Rows of C in C u = g(t). Row r is
///   direction_r . sum_A weight_kA u_A = g_r(t),   k = place_r.
/// Rows for several components share the weights of their place. The weights of a place sum to one,
/// so lambda_r direction_r is the force of row r on its body. With `differences`, each place is the
/// difference of two places of the body instead: the weights sum to zero, X is the difference of
/// the two reference places, and a row gives two opposite forces.
struct ConstraintRows {
  struct Row {
    Index place;
    Eigen::Vector3d direction;  ///< of unit length
  };
  bool differences = false;
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
  /// `called` is the name in messages, "held face 'grip'". `stands` is the place of its table in
  /// the scene, with which messages begin.
  Constraint(std::string called, std::string stands, ConstraintRows its_rows)
      : rows(std::move(its_rows)), name(std::move(called)), place(std::move(stands)) {}
  virtual ~Constraint() = default;

  /// Called with the first displacements of a run. After a remap it is called again, when archive()
  /// has restored the values of the first call; after a restart it is not called.
  virtual void begin(std::span<const NodalVector>) {}
  virtual void archive(const Archive&) {}

  /// Sets g(t), one number per row. Returns the same bits for the same time.
  virtual void targets(Real time, std::span<Real> g) = 0;
  /// The time after which g is constant; infinite if g never becomes constant.
  virtual Real steady_after() const = 0;
  /// A time over which g changes little. It is the step of differences of g when no time step is
  /// known.
  virtual Real moment() const = 0;

  const ConstraintRows rows;
  const std::string name, place;
  /// Number of the first row among all rows of the system, and number of the constraint.
  Index first = 0, number = 0;
};

/// Forces and work of the constraints, as part of the state.
struct Reactions {
  std::vector<Real> force;  ///< lambda on the bodies, [row of all constraints]
  std::vector<Real> work;   ///< done on the bodies so far, [constraint]
};

}  // namespace meniscus
