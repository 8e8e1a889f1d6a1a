// SPDX-License-Identifier: BSD-3-Clause
// Vibrations of the free elastic unit cube by orthonormal polynomials, for which the mass matrix is
// 1.
#include "study/support/cube_modes.hpp"

#include "body/grid/gauss.hpp"
#include "study/support/eigenvalues.hpp"

namespace meniscus::study {
namespace {

/// Integrals of p_a p_b, p_a p_b' and p_a' p_b' over [0, 1] for orthonormal Legendre polynomials.
struct LegendreIntegrals {
  Eigen::MatrixXd integral[2][2];  ///< [derivative of a][derivative of b](a, b)

  explicit LegendreIntegrals(int degree) {
    const int n = degree + 1;
    for (auto& row : integral)
      for (auto& matrix : row) matrix = Eigen::MatrixXd::Zero(n, n);
    const GaussRule& rule = gauss_rule(degree + 1);
    for (std::size_t q = 0; q < rule.x.size(); ++q) {
      const Real x = rule.x[q];
      Eigen::VectorXd p[2] = {Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)};
      p[0][0] = 1;
      for (int a = 1; a < n; ++a) {
        p[0][a] = ((2 * a - 1) * x * p[0][a - 1] - (a > 1 ? (a - 1) * p[0][a - 2] : 0)) / a;
        p[1][a] = (a > 1 ? p[1][a - 2] : 0) + (2 * a - 1) * p[0][a - 1];
      }
      for (int a = 0; a < n; ++a) {
        p[0][a] *= std::sqrt(2 * a + 1.0);
        p[1][a] *= 2 * std::sqrt(2 * a + 1.0);  // dx/dX of X = (1 + x)/2
      }
      for (int da = 0; da < 2; ++da)
        for (int db = 0; db < 2; ++db)
          integral[da][db] += 0.5 * rule.w[q] * p[da] * p[db].transpose();
    }
  }
};

}  // namespace

std::vector<Real> cube_modes(Moduli moduli, int degree) {
  std::vector<std::array<int, 3>> basis;
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; i + j <= degree; ++j)
      for (int k = 0; i + j + k <= degree; ++k) basis.push_back({i, j, k});
  const LegendreIntegrals line(degree);
  const auto n = static_cast<Eigen::Index>(basis.size());
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  for (Eigen::Index a = 0; a < n; ++a)
    for (Eigen::Index b = 0; b < n; ++b) {
      Mat<3> I;  // integral of phi_a,i phi_b,j
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          I(i, j) = 1;
          for (int k = 0; k < 3; ++k)
            I(i, j) *= line.integral[i == k][j == k](at(at(basis, a), k), at(at(basis, b), k));
        }
      const Mat<3> block = moduli.lambda * I + moduli.mu * I.transpose() +
                           moduli.mu * I.trace() * Mat<3>::Identity();
      K.block<3, 3>(3 * a, 3 * b) = block;
    }
  const Eigen::VectorXd values = symmetric_eigenvalues(K);
  return {values.begin(), values.end()};
}

}  // namespace meniscus::study
