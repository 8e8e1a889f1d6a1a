// SPDX-License-Identifier: BSD-3-Clause
#include "physics/loads/held_face.hpp"

#include "numbers/dense.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace meniscus {
namespace {

/// Mean displacement at a place of a constraint.
Eigen::Vector3d displacement_of(const ConstraintRows& rows, Index place,
                                std::span<const NodalVector> u) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (Offset e = at(rows.start, place); e < at(rows.start, place + 1); ++e) {
    const Lanes moved = at(rows.weight, e) * at(u, at(rows.particle, e));
    sum += Eigen::Vector3d(moved[0], moved[1], moved[2]);
  }
  return sum;
}

/// The differences of places with successive numbers: as one, they have the same displacement.
ConstraintRows differences_of(const ConstraintRows& face) {
  ConstraintRows rows;
  rows.differences = true;
  const auto directions = static_cast<std::size_t>(face.size() / face.places());
  for (Index k = 0; k + 1 < face.places(); ++k) {
    std::map<Index, Real> weights;
    for (const auto& [place, sign] : {std::pair(k, 1), std::pair(k + 1, -1)})
      for (Offset e = at(face.start, place); e < at(face.start, place + 1); ++e)
        weights[at(face.particle, e)] += sign * at(face.weight, e);
    for (const auto& [particle, weight] : weights) {
      rows.particle.push_back(particle);
      rows.weight.push_back(weight);
    }
    rows.start.push_back(static_cast<Offset>(rows.particle.size()));
    rows.X.push_back(at(face.X, k) - at(face.X, k + 1));
    for (std::size_t i = 0; i < directions; ++i) rows.rows.push_back({k, face.rows[i].direction});
  }
  return rows;
}

/// The force of row r. Trial motions have no reactions.
Eigen::Vector3d row_force(const Constraint& of, const Motion& motion, Index r) {
  const Real lambda = motion.reactions ? at(motion.reactions->force, of.first + r) : 0;
  return lambda * at(of.rows.rows, r).direction;
}

}  // namespace

template <int D>
Eigen::Vector3d Grip<D>::turned(const Eigen::Vector3d& X, Real time) const {
  // Rodrigues' formula
  const Real by = ramp.fraction(time) * angle({0, 0, 0}, time);
  const Eigen::Vector3d arm = X - centre, across = cross(axis, arm);
  const Real half = std::sin(by / 2);
  return std::sin(by) * across + 2 * half * half * cross(axis, across);
}

template <int D>
HeldFace<D>::HeldFace(std::string called, std::string stands, FaceRows its_rows,
                      const FaceCells<D>& cells, Grip<D> grip, bool from_start, Real moment)
    : Constraint(std::move(called), std::move(stands), std::move(its_rows.rows)),
      cell_(std::move(its_rows.cell)),
      grip_(std::move(grip)),
      displacement_(cells, grip_.displacement),
      from_start_(from_start),
      first_(3 * static_cast<std::size_t>(rows.places()), 0.0),
      moment_(moment) {}

template <int D>
void HeldFace<D>::begin(std::span<const NodalVector> u) {
  if (!from_start_ || begun_) return;
  begun_ = true;
  for (Index k = 0; k < rows.places(); ++k)
    Eigen::Vector3d::Map(first_.data() + std::ptrdiff_t{3} * k) = displacement_of(rows, k, u);
}

template <int D>
void HeldFace<D>::archive(const Archive& a) {
  if (!from_start_) return;
  a("begun", begun_);
  a("first", first_, dimension::length);
}

template <int D>
void HeldFace<D>::targets(Real time, std::span<Real> g) {
  const std::vector<Real>& mean = displacement_.at(time);
  const Real fraction = grip_.ramp.fraction(time);
  const bool turns = grip_.turns();
  for (std::size_t r = 0; r < rows.rows.size(); ++r) {
    const auto& row = rows.rows[r];
    Eigen::Vector3d u = Eigen::Vector3d::Map(first_.data() + std::ptrdiff_t{3} * row.place);
    const Eigen::Vector3d from = at(rows.X, row.place) + u;
    if (!grip_.displacement.empty())
      for (int i = 0; i < D; ++i) u[i] += fraction * at(mean, at(cell_, row.place) * D + i);
    // A rotation is affine, so its mean over a cell is its value at the mean position.
    if (turns) u += grip_.turned(from, time);
    g[r] = row.direction.dot(u);
  }
}

template <int D>
Real HeldFace<D>::steady_after() const {
  return std::max({displacement_.steady_after(), grip_.angle.steady_after(), grip_.ramp.end});
}

template struct Grip<2>;
template struct Grip<3>;
template class HeldFace<2>;
template class HeldFace<3>;

FaceAsOne::FaceAsOne(std::string called, std::string stands, const ConstraintRows& face)
    : Constraint(std::move(called), std::move(stands), differences_of(face)) {}

void FaceAsOne::targets(Real, std::span<Real> g) {
  std::fill(g.begin(), g.end(), 0.0);
}

Eigen::Vector3d mean_displacement(const ConstraintRows& rows, const std::vector<Real>& area,
                                  std::span<const NodalVector> u) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Real total = 0;
  for (Index k = 0; k < rows.places(); ++k) {
    sum += at(area, k) * displacement_of(rows, k, u);
    total += at(area, k);
  }
  return sum / total;
}

Eigen::Vector3d ReactionSums::force(const Motion& motion) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (Index r = 0; r < of->rows.size(); ++r) sum += row_force(*of, motion, r);
  return sum;
}

Eigen::Vector3d ReactionSums::torque(const Motion& motion) const {
  std::vector<Eigen::Vector3d> x = of->rows.X;
  for (Index k = 0; k < of->rows.places(); ++k) at(x, k) += displacement_of(of->rows, k, motion.u);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (Index r = 0; r < of->rows.size(); ++r)
    sum += cross(at(x, at(of->rows.rows, r).place) - about, row_force(*of, motion, r));
  return sum;
}

Real ReactionSums::work(const Motion& motion) const {
  return motion.reactions ? at(motion.reactions->work, of->number) : 0;
}

}  // namespace meniscus
