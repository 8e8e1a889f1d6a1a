// SPDX-License-Identifier: BSD-3-Clause
// Determinants, inverses and decompositions of small matrices. They call Eigen in one source file,
// since Eigen's take seconds to compile in each file that uses them.
#pragma once
#include "numbers/simd.hpp"
#include "numbers/types.hpp"

#include <array>
#include <vector>

namespace meniscus {

inline Eigen::Vector3d cross(const Eigen::Vector3d& x, const Eigen::Vector3d& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}

// Functions of D are compiled for D = 2 and 3.

template <int D>
Real determinant(const Mat<D>& A);
/// Determinants of four matrices A[i][j], one matrix per lane. Each has the same bits as
/// determinant() of its matrix.
template <std::size_t D>
Lanes determinant(const std::array<std::array<Lanes, D>, D>& A);

/// The inverse of A. The caller ensures that A is regular; this is not checked.
template <int D>
Mat<D> inverse(const Mat<D>& A);

/// Eigenvalues of a symmetric matrix in ascending order.
template <int D>
Vec<D> symmetric_eigenvalues(const Mat<D>& S);

/// Eigenvalues of a symmetric matrix in ascending order, and orthonormal eigenvectors as columns.
template <int D>
struct SymmetricAxes {
  Vec<D> values;
  Mat<D> axes;
};
template <int D>
SymmetricAxes<D> symmetric_axes(const Mat<D>& S);

/// The x with the greatest x.Ax / x.Mx and x.Mx = 1, in the first n = 2 or 3 rows of symmetric
/// matrices; M is positive definite. All other entries of x are zero.
Vec<3> greatest_quotient(const Mat<3>& A, const Mat<3>& M, int n);

/// D - 1 orthonormal columns, normal to the unit vector n.
template <int D>
Eigen::Matrix<Real, D, D - 1> tangents_to(const Vec<D>& n);

/// The symmetric root R of S with R R = S. S is symmetric and has no negative eigenvalues.
template <int D>
Mat<D> square_root(const Mat<D>& S);

/// The solution x of S x = b for a symmetric, semidefinite S of any size, by L D L^T with pivots.
/// Allocates memory.
Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& S, const Eigen::VectorXd& b);

/// The smallest eigenvalue of a symmetric tridiagonal matrix with n entries on the diagonal and the
/// n - 1 entries `beside` on either side of it.
Real least_eigenvalue(const std::vector<Real>& diagonal, const std::vector<Real>& beside);
/// Its eigenvector, of length 1.
Eigen::VectorXd least_eigenvector(const std::vector<Real>& diagonal,
                                  const std::vector<Real>& beside);

/// The rotation Q that brings the vectors Q A closest to the vectors B, with moment = sum w B A^T
/// (Kabsch 1976, by singular values).
Mat<3> best_rotation(const Mat<3>& moment);

}  // namespace meniscus
