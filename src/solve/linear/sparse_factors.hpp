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

/// Factors L D L^T of a symmetric matrix, without pivoting: the matrix should be positive, or
/// quasidefinite (positive and negative definite blocks on the diagonal). The bits do not depend on
/// the number of threads.
class SparseCholesky {
 public:
  /// Factorises the n x n matrix with the sums of `entries`; both triangles must be given. The
  /// diagonal is first scaled to one. Rows are eliminated in `order` (order[new] = old);
  /// independent rows may be exchanged. If `order` is empty, minimum degree is used.
  SparseCholesky(Index n, std::span<const MatrixEntry> entries, std::vector<Index> order = {});
  /// Plans the factors of a matrix with these entries, column by column, both triangles, with
  /// ascending rows. Nothing may be called before factor().
  SparseCholesky(std::span<const Index> start, std::span<const Index> row,
                 std::vector<Index> order);
  ~SparseCholesky();

  /// Factorises the planned matrix with these values, which must have no zero on the diagonal.
  void factor(std::span<const Real> value);
  /// Number of negative eigenvalues (Sylvester's law of inertia).
  Index negative_eigenvalues() const;

  /// The smallest pivot of the scaled matrix, and its row. A pivot near round-off means that the
  /// row depends on others; solve() is then meaningless.
  struct Pivot {
    Real value;
    Index row;
  };
  Pivot smallest_pivot() const;
  /// Replaces b by the solution x of A x = b.
  void solve(std::vector<Real>& b) const;
  /// Solves for each component of the n vectors b.
  void solve(std::span<NodalVector> b) const;
  std::size_t bytes() const;

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

/// Factors L U of a square matrix.
class SparseLU {
 public:
  /// Factorises the n x n matrix with the sums of `entries`.
  SparseLU(Index n, const std::vector<MatrixEntry>& entries);
  ~SparseLU();

  /// True if the matrix has an inverse.
  bool exists() const;
  /// Replace b by the solution of A x = b, or of A^t x = b.
  void solve(Eigen::VectorXd& b) const;
  void solve_transposed(Eigen::VectorXd& b) const;

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace meniscus
