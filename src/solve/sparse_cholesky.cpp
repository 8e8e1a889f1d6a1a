// SPDX-License-Identifier: BSD-3-Clause
// Sparse factors by Eigen.
#include "meniscus/solve/sparse_cholesky.hpp"

#include <Eigen/SparseCholesky>
#include <cmath>

namespace meniscus {

struct SparseCholesky::Factors {
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<Real>> of_scaled;
  Eigen::VectorXd scale, permuted;
};

SparseCholesky::SparseCholesky(Index n, const std::vector<MatrixEntry>& entries)
    : factors_(std::make_unique<Factors>()) {
  Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(n);
  for (const MatrixEntry& e : entries)
    if (e.row == e.column) diagonal[e.row] += e.value;
  factors_->scale = diagonal.cwiseSqrt().cwiseInverse();
  std::vector<Eigen::Triplet<Real>> scaled;
  scaled.reserve(entries.size());
  for (const MatrixEntry& e : entries)
    scaled.emplace_back(e.row, e.column,
                        e.value * factors_->scale[e.row] * factors_->scale[e.column]);
  Eigen::SparseMatrix<Real> A(n, n);
  A.setFromTriplets(scaled.begin(), scaled.end());
  factors_->of_scaled.compute(A);
  if (factors_->of_scaled.info() != Eigen::Success) {
    // A pivot that is exactly zero ends the factors; with a shift it shows as the smallest.
    factors_->of_scaled.setShift(1e-15);
    factors_->of_scaled.compute(A);
  }
  factors_->permuted.resize(n);
}

SparseCholesky::~SparseCholesky() = default;

SparseCholesky::Pivot SparseCholesky::smallest_pivot() const {
  const auto& of = factors_->of_scaled;
  Index at = 0;
  const Real value = of.vectorD().minCoeff(&at);
  const auto& permuted = of.permutationP().indices();
  Index row = 0;
  for (Index i = 0; i < static_cast<Index>(permuted.size()); ++i)
    if (permuted[i] == at) row = i;
  return {value, row};
}

void SparseCholesky::solve(std::vector<Real>& b) const {
  Eigen::VectorXd& x = factors_->permuted;
  const auto& of = factors_->of_scaled;
  const auto& permuted = of.permutationP().indices();
  for (Index i = 0; i < static_cast<Index>(x.size()); ++i)
    x[permuted[i]] = at(b, i) * factors_->scale[i];
  of.matrixL().solveInPlace(x);
  x.array() /= of.vectorD().array();
  of.matrixU().solveInPlace(x);
  for (Index i = 0; i < static_cast<Index>(x.size()); ++i)
    at(b, i) = x[permuted[i]] * factors_->scale[i];
}

std::size_t SparseCholesky::bytes() const {
  const auto entries = factors_->of_scaled.matrixL().nestedExpression().nonZeros();
  return static_cast<std::size_t>(entries) * (sizeof(Real) + sizeof(int));
}

}  // namespace meniscus
