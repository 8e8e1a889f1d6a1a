// SPDX-License-Identifier: BSD-3-Clause
// Sparse L D L^T factors of a symmetric positive matrix: Eigen's, which take seconds to compile, in
// one file.
#pragma once
#include "meniscus/core/types.hpp"

#include <memory>
#include <vector>

namespace meniscus {

struct MatrixEntry {
  Index row, column;
  Real value;
};

class SparseCholesky {
 public:
  /// Of the n x n matrix with the sums of `entries`, both triangles given. Its diagonal is scaled
  /// to one first.
  SparseCholesky(Index n, const std::vector<MatrixEntry>& entries);
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
  std::size_t bytes() const;

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace meniscus
