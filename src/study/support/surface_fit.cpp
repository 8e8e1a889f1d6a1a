// SPDX-License-Identifier: BSD-3-Clause
// Weights of local quadratic fits along a surface.
#include "study/support/surface_fit.hpp"

#include "numbers/dense.hpp"
#include "parallel/parallel.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace meniscus::study {
namespace {

Real weight_at(Real z) {
  const Real t = 1 - z;
  return z < 0.5 ? 2.0 / 3 - 4 * z * z * t : 4.0 / 3 * t * t * t;
}

/// The directions of largest extent of a cloud around x, which approximate the tangents of a
/// surface.
template <int D>
Eigen::Matrix<Real, D, D - 1> tangents(std::span<const Vec<D>> points,
                                       const std::vector<Index>& near, const Vec<D>& x) {
  Mat<D> covariance = Mat<D>::Zero();
  for (const Index q : near) covariance += (at(points, q) - x) * (at(points, q) - x).transpose();
  if constexpr (D == 3) {
    return Eigen::SelfAdjointEigenSolver<Mat<3>>(covariance).eigenvectors().rightCols<2>();
  } else {
    const Real angle = 0.5 * std::atan2(2 * covariance(0, 1), covariance(0, 0) - covariance(1, 1));
    return Vec<2>(std::cos(angle), std::sin(angle));
  }
}

template <int D>
Eigen::RowVectorXd quadratic(const Vec<D - 1>& s) {
  Eigen::RowVectorXd p(1 + (D - 1) + D * (D - 1) / 2);
  if constexpr (D == 3)
    p << 1, s[0], s[1], s[0] * s[0], s[0] * s[1], s[1] * s[1];
  else
    p << 1, s[0], s[0] * s[0];
  return p;
}

}  // namespace

template <int D>
SurfaceFit<D>::SurfaceFit(std::span<const Vec<D>> points) {
  const NeighborSearch<D> search(points);
  std::vector<Index> near;
  for (const Vec<D>& x : points) {
    const Real radius = 1.2 * search.distance_of_nearest(x, D == 3 ? 25 : 13);
    search.within(x, radius, near);
    const auto t = tangents<D>(points, near, x);
    const auto n = static_cast<Eigen::Index>(near.size());
    Eigen::MatrixXd P(n, 1 + (D - 1) + D * (D - 1) / 2);
    Eigen::VectorXd w(n);
    for (Eigen::Index k = 0; k < n; ++k) {
      const Vec<D> r = at(points, at(near, k)) - x;
      P.row(k) = quadratic<D>(Vec<D - 1>(t.transpose() * r / radius));
      w[k] = weight_at(r.norm() / radius);
    }
    // Value at s = 0: e_0 (P^T W P)^-1 P^T W.
    const Eigen::MatrixXd M = P.transpose() * w.asDiagonal() * P;
    const Eigen::VectorXd c = solve_symmetric(M, Eigen::VectorXd::Unit(M.rows(), 0));
    const Eigen::VectorXd weight = w.asDiagonal() * (P * c);
    point_.insert(point_.end(), near.begin(), near.end());
    weight_.insert(weight_.end(), weight.data(), weight.data() + n);
    start_.push_back(static_cast<Offset>(point_.size()));
  }
}

template <int D>
void SurfaceFit<D>::apply(std::vector<Real>& values) const {
  const std::vector<Real> raw = values;
  parallel_for(static_cast<Index>(values.size()), [&](Index q) {
    Real sum = 0;
    for (Offset e = at(start_, q); e < at(start_, q + 1); ++e)
      sum += at(weight_, e) * at(raw, at(point_, e));
    at(values, q) = sum;
  });
}

template <int D>
std::size_t SurfaceFit<D>::bytes() const {
  return start_.size() * sizeof(Offset) + point_.size() * (sizeof(Index) + sizeof(Real));
}

template class SurfaceFit<2>;
template class SurfaceFit<3>;

}  // namespace meniscus::study
