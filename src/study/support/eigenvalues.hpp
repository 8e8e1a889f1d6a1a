// SPDX-License-Identifier: BSD-3-Clause
// Eigenvalues of dense matrices. They are in one source file, since Eigen's solvers take seconds to
// compile.
#pragma once
#include "numbers/types.hpp"

namespace meniscus::study {

/// Eigenvalues of a symmetric matrix K, ascending.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& K);
/// Eigenvalues x of K w = x M w, ascending; K and M are symmetric, M is positive definite.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M);

}  // namespace meniscus::study
