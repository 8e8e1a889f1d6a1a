// SPDX-License-Identifier: BSD-3-Clause
// Determinants, inverses and decompositions of small matrices, compiled once: Eigen's, which take
// seconds to compile in every file that uses them.
#pragma once
#include "meniscus/core/simd.hpp"
#include "meniscus/core/types.hpp"

#include <array>
#include <vector>

namespace meniscus {

inline Eigen::Vector3d cross(const Eigen::Vector3d& x, const Eigen::Vector3d& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}

// D = 2, 3.

template <int D>
Real determinant(const Mat<D>& A);
/// Of four matrices A[i][j], one per lane: to the last bit that of each alone.
template <std::size_t D>
Lanes determinant(const std::array<std::array<Lanes, D>, D>& A);

/// Of a matrix that is not singular.
template <int D>
Mat<D> inverse(const Mat<D>& A);

/// Eigenvalues of a symmetric matrix in ascending order.
template <int D>
Vec<D> symmetric_eigenvalues(const Mat<D>& S);

/// Columns that are orthonormal, and to the unit vector n.
template <int D>
Eigen::Matrix<Real, D, D - 1> tangents_to(const Vec<D>& n);

/// Symmetric root R of a symmetric matrix without negative eigenvalues, R R = S.
template <int D>
Mat<D> square_root(const Mat<D>& S);

/// x of S x = b, S symmetric and not indefinite (L D L^T with pivots). Of any size, so that there
/// is one to compile; takes memory.
Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& S, const Eigen::VectorXd& b);

/// The least eigenvalue of a symmetric tridiagonal matrix; `beside` are the numbers beside the
/// diagonal, one less.
Real least_eigenvalue(const std::vector<Real>& diagonal, const std::vector<Real>& beside);

/// The rotation Q that brings Q A closest to B, from sum w B A^T (Kabsch 1976, by singular values).
Mat<3> best_rotation(const Mat<3>& moment);

}  // namespace meniscus
