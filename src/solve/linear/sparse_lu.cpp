// SPDX-License-Identifier: BSD-3-Clause
// Factors of a square sparse matrix by Eigen.
#include "solve/linear/sparse_factors.hpp"

#include <Eigen/SparseLU>

namespace meniscus {

struct SparseLU::Factors {
  Eigen::SparseLU<Eigen::SparseMatrix<Real>> of;
};

SparseLU::SparseLU(Index n, const std::vector<MatrixEntry>& entries)
    : factors_(std::make_unique<Factors>()) {
  std::vector<Eigen::Triplet<Real>> triplets;
  triplets.reserve(entries.size());
  for (const MatrixEntry& e : entries) triplets.emplace_back(e.row, e.column, e.value);
  Eigen::SparseMatrix<Real> A(n, n);
  A.setFromTriplets(triplets.begin(), triplets.end());
  factors_->of.compute(A);
}

SparseLU::~SparseLU() = default;

bool SparseLU::exists() const {
  return factors_->of.info() == Eigen::Success;
}

void SparseLU::solve(Eigen::VectorXd& b) const {
  b = factors_->of.solve(b).eval();
}

void SparseLU::solve_transposed(Eigen::VectorXd& b) const {
  b = factors_->of.transpose().solve(b).eval();
}

}  // namespace meniscus
