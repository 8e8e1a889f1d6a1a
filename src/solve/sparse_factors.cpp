// SPDX-License-Identifier: BSD-3-Clause
// Sparse factors by Eigen.
#include "meniscus/solve/sparse_factors.hpp"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#include <cmath>

namespace meniscus {
namespace {

using Sparse = Eigen::SparseMatrix<Real>;
using Permutation = Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>;

Sparse sum_of(Index n, const std::vector<Eigen::Triplet<Real>>& entries) {
  Sparse A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

/// order[new] = old
std::vector<Index> by_minimum_degree(const Sparse& A) {
  Permutation old_of_new;
  Eigen::AMDOrdering<int>()(A, old_of_new);
  return {old_of_new.indices().begin(), old_of_new.indices().end()};
}

}  // namespace

struct SparseCholesky::Factors {
  Eigen::SimplicialLDLT<Sparse, Eigen::Lower, Eigen::NaturalOrdering<int>> of_scaled;
  Eigen::VectorXd scale, permuted;
  NodalVectors permuted_vectors;
  std::vector<Index> row_at;  ///< row of the matrix that the factors have at a place
};

SparseCholesky::SparseCholesky(Index n, const std::vector<MatrixEntry>& entries,
                               std::vector<Index> order)
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
  if (order.empty()) order = by_minimum_degree(A);
  Permutation to_place(n);
  for (Index k = 0; k < n; ++k) to_place.indices()[at(order, k)] = k;
  Sparse permuted(n, n);
  permuted = A.twistedBy(to_place);
  factors_->row_at = std::move(order);
  factors_->of_scaled.compute(permuted);
  if (factors_->of_scaled.info() != Eigen::Success) {
    // A pivot that is exactly zero ends the factors; with a shift it shows as the smallest.
    factors_->of_scaled.setShift(1e-15);
    factors_->of_scaled.compute(permuted);
  }
  factors_->permuted.resize(n);
}

SparseCholesky::~SparseCholesky() = default;

SparseCholesky::Pivot SparseCholesky::smallest_pivot() const {
  Index place = 0;
  const Real value = factors_->of_scaled.vectorD().minCoeff(&place);
  return {value, at(factors_->row_at, place)};
}

void SparseCholesky::solve(std::vector<Real>& b) const {
  Eigen::VectorXd& x = factors_->permuted;
  const auto& of = factors_->of_scaled;
  const std::vector<Index>& row_at = factors_->row_at;
  for (Index k = 0; k < static_cast<Index>(x.size()); ++k)
    x[k] = at(b, at(row_at, k)) * factors_->scale[at(row_at, k)];
  of.matrixL().solveInPlace(x);
  x.array() /= of.vectorD().array();
  of.matrixU().solveInPlace(x);
  for (Index k = 0; k < static_cast<Index>(x.size()); ++k)
    at(b, at(row_at, k)) = x[k] * factors_->scale[at(row_at, k)];
}

void SparseCholesky::solve(std::span<NodalVector> b) const {
  NodalVectors& x = factors_->permuted_vectors;
  const std::vector<Index>& row_at = factors_->row_at;
  const Sparse& L = factors_->of_scaled.matrixL().nestedExpression();  // without its diagonal
  const auto& diagonal = factors_->of_scaled.vectorD();
  const auto n = static_cast<Index>(L.cols());
  x.resize(static_cast<std::size_t>(n));
  for (Index k = 0; k < n; ++k) at(x, k) = factors_->scale[at(row_at, k)] * at(b, at(row_at, k));
  for (Index k = 0; k < n; ++k) {
    const Lanes known = at(x, k);
    for (Sparse::InnerIterator e(L, k); e; ++e) at(x, e.row()) -= e.value() * known;
  }
  for (Index k = n - 1; k >= 0; --k) {
    Lanes sum = at(x, k) / diagonal[k];
    for (Sparse::InnerIterator e(L, k); e; ++e) sum -= e.value() * at(x, e.row());
    at(x, k) = sum;
  }
  for (Index k = 0; k < n; ++k) at(b, at(row_at, k)) = factors_->scale[at(row_at, k)] * at(x, k);
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
