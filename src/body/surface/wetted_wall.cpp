// SPDX-License-Identifier: BSD-3-Clause
// Finds the wall on which the points of a face lie.
#include "body/surface/wetted_wall.hpp"

#include "numbers/dense.hpp"

#include <algorithm>

namespace meniscus {
namespace {

/// Largest distance of points from a wall.
template <int D>
Real farthest(const WettedWall<D>& wall, const std::vector<Vec<D>>& points) {
  Real most = 0;
  for (const Vec<D>& X : points) {
    std::array<Real, D> y;
    for (int i = 0; i < D; ++i) at(y, i) = X[i];
    const Real distance = std::abs(wall.template foot<Real>(y).distance);
    if (!(distance <= most)) most = distance;  // also for NaN
  }
  return most;
}

}  // namespace

/// With positions y from the mean, a sphere is |y|^2 = 2 c . y + b: a linear least-squares problem
/// for c and b = R^2 - |c|^2.
template <int D>
std::optional<WettedWall<D>> wall_through(const std::vector<Vec<D>>& points,
                                          const std::optional<Vec<D>>& axis) {
  constexpr Real near = 1e-6;
  if (points.empty()) return std::nullopt;
  Vec<D> mean = Vec<D>::Zero();
  for (const Vec<D>& X : points) mean += X;
  mean /= static_cast<Real>(points.size());
  Mat<D> square = Mat<D>::Zero();
  Real extent = 0;
  for (const Vec<D>& X : points) {
    const Vec<D> y = X - mean;
    square += y * y.transpose();
    extent = std::max(extent, y.norm());
  }
  if (!axis) {
    const auto plane = WettedWall<D>::plane(mean, symmetric_axes<D>(square).axes.col(0));
    if (farthest(plane, points) <= near * extent) return plane;
  }
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(D + 1, D + 1);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(D + 1);
  for (const Vec<D>& X : points) {
    Vec<D> y = X - mean;
    if (axis) y -= *axis * axis->dot(y);
    Eigen::VectorXd row(D + 1);
    row << 2 * y, 1;
    S += row * row.transpose();
    right += y.squaredNorm() * row;
  }
  // The centre of a circle about the axis is taken in the plane through the mean.
  if (axis)
    S.topLeftCorner(D, D) +=
        4 * static_cast<Real>(points.size()) * extent * extent * (*axis * axis->transpose());
  const Eigen::VectorXd found = solve_symmetric(S, right);
  const Vec<D> centre = found.head<D>();
  const Real squared_radius = found[D] + centre.squaredNorm();
  if (!(squared_radius > 0)) return std::nullopt;
  const Real radius = std::sqrt(squared_radius);
  const auto round = axis ? WettedWall<D>::cylinder(mean + centre, *axis, radius)
                          : WettedWall<D>::ball(mean + centre, radius);
  if (!(farthest(round, points) <= near * extent)) return std::nullopt;
  return round;
}

template std::optional<WettedWall<2>> wall_through(const std::vector<Vec<2>>&,
                                                   const std::optional<Vec<2>>&);
template std::optional<WettedWall<3>> wall_through(const std::vector<Vec<3>>&,
                                                   const std::optional<Vec<3>>&);

}  // namespace meniscus
