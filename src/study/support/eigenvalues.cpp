// SPDX-License-Identifier: BSD-3-Clause
// Eigenvalues of dense matrices by Eigen.
#include "study/support/eigenvalues.hpp"

#include <Eigen/Eigenvalues>

namespace meniscus::study {

Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& K) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K, Eigen::EigenvaluesOnly).eigenvalues();
}

Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(K, M, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

}  // namespace meniscus::study
