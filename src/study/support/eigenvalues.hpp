// SPDX-License-Identifier: BSD-3-Clause
// Eigenvalues of dense matrices: Eigen's, which take seconds to compile, in one file.
#pragma once
#include "meniscus/core/types.hpp"

namespace meniscus::study {

/// Of a symmetric matrix K, ascending.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& K);
/// x of K w = x M w, ascending; K and M are symmetric, M is positive definite.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M);

}  // namespace meniscus::study
