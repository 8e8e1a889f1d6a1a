// SPDX-License-Identifier: BSD-3-Clause
// Factors of sparse matrices.
#pragma once
#include "parallel/aligned.hpp"

#include <memory>
#include <span>
#include <vector>

namespace meniscus {

struct MatrixEntry {
  Index row, column;
  Real value;
};

/// L D L^T of a symmetric positive matrix, with the same bits for any number of threads.
class SparseCholesky {
 public:
  /// Of the n x n matrix with the sums of `entries`, both triangles given. Its diagonal is scaled
  /// to one first. Rows are eliminated in `order` (order[new] = old), but for rows that do not
  /// depend on each other; by minimum degree if empty.
  SparseCholesky(Index n, std::span<const MatrixEntry> entries, std::vector<Index> order = {});
  ~SparseCholesky();

  /// The smallest pivot of the scaled matrix and its row: about round-off if that row depends on
  /// others, then solve() means nothing.
  struct Pivot {
    Real value;
    Index row;
  };
  Pivot smallest_pivot() const;
  /// b becomes the solution x of A x = b.
  void solve(std::vector<Real>& b) const;
  /// The same for all components of n vectors at once.
  void solve(std::span<NodalVector> b) const;
  std::size_t bytes() const;

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

/// L U of a square matrix.
class SparseLU {
 public:
  /// Of the n x n matrix with the sums of `entries`.
  SparseLU(Index n, const std::vector<MatrixEntry>& entries);
  ~SparseLU();

  /// Whether the matrix has an inverse.
  bool exists() const;
  /// b becomes the solution of A x = b, or of A^t x = b.
  void solve(Eigen::VectorXd& b) const;
  void solve_transposed(Eigen::VectorXd& b) const;

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace meniscus
