// SPDX-License-Identifier: BSD-3-Clause
// Determinants, inverses and decompositions of small matrices.
#include "numbers/dense.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus {

template <int D>
Real determinant(const Mat<D>& A) {
  return A.determinant();
}

// Uses the same order of operations as Eigen.
template <std::size_t D>
Lanes determinant(const std::array<std::array<Lanes, D>, D>& A) {
  const auto a = [&](std::size_t i, std::size_t j) { return A[i][j].v; };
  if constexpr (D == 2)
    return a(0, 0) * a(1, 1) - a(1, 0) * a(0, 1);
  else
    return a(0, 0) * (a(1, 1) * a(2, 2) - a(1, 2) * a(2, 1)) -
           a(0, 1) * (a(1, 0) * a(2, 2) - a(1, 2) * a(2, 0)) +
           a(0, 2) * (a(1, 0) * a(2, 1) - a(1, 1) * a(2, 0));
}

template <int D>
Mat<D> inverse(const Mat<D>& A) {
  return A.inverse();
}

template <>
Vec<2> symmetric_eigenvalues(const Mat<2>& S) {
  const Real middle = 0.5 * (S(0, 0) + S(1, 1)),
             radius = std::hypot(0.5 * (S(0, 0) - S(1, 1)), S(1, 0));
  return {middle - radius, middle + radius};
}

template <>
Vec<3> symmetric_eigenvalues(const Mat<3>& S) {
  return Eigen::SelfAdjointEigenSolver<Mat<3>>(S, Eigen::EigenvaluesOnly).eigenvalues();
}

template <>
SymmetricAxes<3> symmetric_axes(const Mat<3>& S) {
  const Eigen::SelfAdjointEigenSolver<Mat<3>> eigen(S);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

template <>
SymmetricAxes<2> symmetric_axes(const Mat<2>& S) {
  const Real angle = 0.5 * std::atan2(2 * S(1, 0), S(0, 0) - S(1, 1));
  const Vec<2> greatest(std::cos(angle), std::sin(angle));
  SymmetricAxes<2> result{symmetric_eigenvalues<2>(S), Mat<2>()};
  result.axes.col(0) = Vec<2>(-greatest[1], greatest[0]);
  result.axes.col(1) = greatest;
  return result;
}

template <>
Mat<3> square_root(const Mat<3>& S) {
  return Eigen::SelfAdjointEigenSolver<Mat<3>>(S).operatorSqrt();
}

/// Uses the 3D function: compiling Eigen's solver for 2 x 2 matrices takes longer than the whole
/// file.
template <>
Mat<2> square_root(const Mat<2>& S) {
  Mat<3> in_space = Mat<3>::Zero();
  in_space.topLeftCorner<2, 2>() = S;
  return square_root<3>(in_space).topLeftCorner<2, 2>();
}

/// With M = L L^T, y = L^T x is the last eigenvector of L^-1 A L^-T.
Vec<3> greatest_quotient(const Mat<3>& A, const Mat<3>& M, int n) {
  Mat<3> L = Mat<3>::Identity();
  for (int i = 0; i < n; ++i)
    for (int j = 0; j <= i; ++j) {
      Real rest = M(i, j);
      for (int k = 0; k < j; ++k) rest -= L(i, k) * L(j, k);
      L(i, j) = i == j ? std::sqrt(rest) : rest / L(j, j);
    }
  const Mat<3> inverse_L = L.inverse(), C = inverse_L * A * inverse_L.transpose();
  Vec<3> y = Vec<3>::Zero();
  if (n == 2) {
    const Real angle = 0.5 * std::atan2(2 * C(1, 0), C(0, 0) - C(1, 1));
    y.head<2>() = Vec<2>(std::cos(angle), std::sin(angle));
  } else {
    y = Eigen::SelfAdjointEigenSolver<Mat<3>>(C).eigenvectors().col(2);
  }
  return inverse_L.transpose() * y;
}

template <>
Eigen::Matrix<Real, 2, 1> tangents_to(const Vec<2>& n) {
  return Vec<2>(-n[1], n[0]);
}

template <>
Eigen::Matrix<Real, 3, 2> tangents_to(const Vec<3>& n) {
  Eigen::Matrix<Real, 3, 2> t;
  t.col(0) = n.unitOrthogonal();
  t.col(1) = n.cross(Vec<3>(t.col(0)));
  return t;
}

Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& S, const Eigen::VectorXd& b) {
  return S.ldlt().solve(b);
}

/// The least eigenvalue of a symmetric tridiagonal matrix, by bisection: the signs of the pivots of
/// A - x I give the number of eigenvalues below x (Sturm).
Real least_eigenvalue(const std::vector<Real>& diagonal, const std::vector<Real>& beside) {
  const auto any_below = [&](Real x) {
    Real pivot = 1;
    for (std::size_t k = 0; k < diagonal.size(); ++k) {
      pivot = diagonal[k] - x - (k > 0 ? beside[k - 1] * beside[k - 1] / pivot : 0);
      if (pivot < 0) return true;
      if (pivot == 0) pivot = std::numeric_limits<Real>::min();
    }
    return false;
  };
  Real low = diagonal.front(), high = low;  // bounds by Gershgorin's circles
  for (std::size_t k = 0; k < diagonal.size(); ++k) {
    const Real radius =
        (k > 0 ? std::abs(beside[k - 1]) : 0) + (k + 1 < diagonal.size() ? std::abs(beside[k]) : 0);
    low = std::min(low, diagonal[k] - radius);
    high = std::min(high, diagonal[k]);  // the smallest eigenvalue is not above this
  }
  for (int halvings = 0; halvings < 60; ++halvings) {
    const Real middle = 0.5 * (low + high);
    (any_below(middle) ? high : low) = middle;
  }
  return low;
}

Eigen::VectorXd least_eigenvector(const std::vector<Real>& diagonal,
                                  const std::vector<Real>& beside) {
  const auto n = static_cast<Eigen::Index>(diagonal.size());
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(Eigen::VectorXd::Map(diagonal.data(), n),
                                Eigen::VectorXd::Map(beside.data(), n - 1));
  return solver.eigenvectors().col(0);
}

Mat<3> best_rotation(const Mat<3>& moment) {
  const Eigen::JacobiSVD<Mat<3>> svd(moment, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Mat<3> sign = Mat<3>::Identity();
  sign(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant();
  return svd.matrixU() * sign * svd.matrixV().transpose();
}

template Real determinant(const Mat<2>&);
template Real determinant(const Mat<3>&);
template Lanes determinant(const std::array<std::array<Lanes, 2>, 2>&);
template Lanes determinant(const std::array<std::array<Lanes, 3>, 3>&);
template Mat<1> inverse(const Mat<1>&);
template Mat<2> inverse(const Mat<2>&);
template Mat<3> inverse(const Mat<3>&);

}  // namespace meniscus
