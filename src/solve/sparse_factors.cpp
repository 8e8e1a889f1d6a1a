// SPDX-License-Identifier: BSD-3-Clause
// Sparse factors by Eigen.
#include "meniscus/solve/sparse_factors.hpp"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#include <cmath>

namespace meniscus {
namespace {

using Sparse = Eigen::SparseMatrix<Real>;

Sparse sum_of(Index n, const std::vector<Eigen::Triplet<Real>>& entries) {
  Sparse A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

}  // namespace

struct SparseCholesky::Factors {
  Eigen::SimplicialLDLT<Sparse> of_scaled;
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
  const Sparse A = sum_of(n, scaled);
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

struct SparseLU::Factors {
  Eigen::SparseLU<Sparse> of;
};

SparseLU::SparseLU(Index n, const std::vector<MatrixEntry>& entries)
    : factors_(std::make_unique<Factors>()) {
  std::vector<Eigen::Triplet<Real>> triplets;
  triplets.reserve(entries.size());
  for (const MatrixEntry& e : entries) triplets.emplace_back(e.row, e.column, e.value);
  factors_->of.compute(sum_of(n, triplets));
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
