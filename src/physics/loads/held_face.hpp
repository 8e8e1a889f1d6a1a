// SPDX-License-Identifier: BSD-3-Clause
// The constraints of a face that is held or moved (held-faces note): the mean displacement over
// each of its face cells is prescribed, or all face cells move as one.
#pragma once
#include "body/surface/face_means.hpp"
#include "input/ramp.hpp"
#include "meniscus/physics/force_term.hpp"
#include "physics/constraint.hpp"

#include <string>
#include <vector>

namespace meniscus {

/// The prescribed displacement of reference positions: a rotation about an axis and a translation,
/// both multiplied by the fraction of a ramp.
template <int D>
struct Grip {
  std::vector<Expression> displacement;  ///< empty if there is none
  Expression angle;
  Eigen::Vector3d axis, centre;  ///< axis: of unit length
  Ramp ramp;

  bool turns() const { return !angle.constant() || angle({0, 0, 0}) != 0; }
  /// Displacement R X - X of a place X by the rotation R about the centre.
  Eigen::Vector3d turned(const Eigen::Vector3d& X, Real time) const;
};

/// Rows of the face cells of a face, with the number of the face cell of each place.
struct FaceRows {
  ConstraintRows rows;
  std::vector<Index> cell;
};

/// Constraint that prescribes the mean displacement of each face cell. With `from_start`, it is
/// counted from the first displacements of the run.
template <int D>
class HeldFace final : public Constraint {
 public:
  HeldFace(std::string called, std::string stands, FaceRows its_rows, const FaceCells<D>& cells,
           Grip<D> grip, bool from_start, Real moment);

  /// Keeps the first mean displacements, from which others are counted.
  void begin(std::span<const NodalVector> u) override;
  void archive(const Archive& a) override;
  void targets(Real time, std::span<Real> g) override;
  Real steady_after() const override;
  Real moment() const override { return moment_; }

 private:
  std::vector<Index> cell_;
  Grip<D> grip_;
  FaceMeans<D> displacement_;
  bool from_start_, begun_ = false;
  std::vector<Real> first_;  // [place][3] zero without `from_start`
  Real moment_;
};

/// Constraint by which all places of a face have the same displacement along some components. Its
/// rows are the differences of places with successive numbers.
class FaceAsOne final : public Constraint {
 public:
  FaceAsOne(std::string called, std::string stands, const ConstraintRows& face);
  void targets(Real, std::span<Real> g) override;
  Real steady_after() const override { return 0; }
  Real moment() const override { return unbounded; }
};

/// Mean displacement of the places of a constraint, weighted by their areas.
Eigen::Vector3d mean_displacement(const ConstraintRows& rows, const std::vector<Real>& area,
                                  std::span<const NodalVector> u);

/// Sums of the reactions of a constraint. `about`: the point to which torques refer.
struct ReactionSums {
  const Constraint* of;
  Eigen::Vector3d about;

  Eigen::Vector3d force(const Motion& motion) const;
  Eigen::Vector3d torque(const Motion& motion) const;
  Real work(const Motion& motion) const;
};

}  // namespace meniscus
