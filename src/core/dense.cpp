// SPDX-License-Identifier: BSD-3-Clause
// Determinants, inverses and decompositions of small matrices.
#include "meniscus/core/dense.hpp"

#include <Eigen/Dense>

namespace meniscus {

template <int D>
Real determinant(const Mat<D>& A) {
  return A.determinant();
}

template <int D>
Mat<D> inverse(const Mat<D>& A) {
  return A.inverse();
}

template <int D>
Vec<D> symmetric_eigenvalues(const Mat<D>& S) {
  return Eigen::SelfAdjointEigenSolver<Mat<D>>(S, Eigen::EigenvaluesOnly).eigenvalues();
}

template <int D>
Mat<D> square_root(const Mat<D>& S) {
  return Eigen::SelfAdjointEigenSolver<Mat<D>>(S).operatorSqrt();
}

template <int n>
Vec<n> solve_symmetric(const Mat<n>& S, const Vec<n>& b) {
  return S.ldlt().solve(b);
}

Mat<3> best_rotation(const Mat<3>& moment) {
  const Eigen::JacobiSVD<Mat<3>> svd(moment, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Mat<3> sign = Mat<3>::Identity();
  sign(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant();
  return svd.matrixU() * sign * svd.matrixV().transpose();
}

#define MENISCUS_INSTANTIATE(D)                            \
  template Real determinant<D>(const Mat<D>&);             \
  template Mat<D> inverse<D>(const Mat<D>&);               \
  template Vec<D> symmetric_eigenvalues<D>(const Mat<D>&); \
  template Mat<D> square_root<D>(const Mat<D>&);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE
template Vec<2> solve_symmetric<2>(const Mat<2>&, const Vec<2>&);
template Vec<3> solve_symmetric<3>(const Mat<3>&, const Vec<3>&);
template Vec<4> solve_symmetric<4>(const Mat<4>&, const Vec<4>&);
template Vec<5> solve_symmetric<5>(const Mat<5>&, const Vec<5>&);

}  // namespace meniscus
