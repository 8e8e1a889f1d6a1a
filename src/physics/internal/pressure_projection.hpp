// SPDX-License-Identifier: BSD-3-Clause
// The pressures that a body of nodal cells can carry without locking: free in inner cells, linear
// at the boundary (locking note 2).
#pragma once
#include "body/body.hpp"
#include "numbers/dual.hpp"

#include <Eigen/SparseCore>
#include <span>
#include <tuple>
#include <vector>

namespace meniscus {

/// Projects values of nodal cells on fields that are free in inner cells and are extended linearly
/// to cells at the boundary:
///
///   Pi = Phi M^-1 Phi^T W,  M = Phi^T W Phi,  W volumes of the cells.
///
/// The rows of Phi give the values of cells for the values of inner cells (locking note 2). The
/// inverse is a fixed polynomial of M, so that Pi is not an exact projection; it is linear, W Pi is
/// symmetric, and constant and linear fields keep their values. Inner cells that no cell at the
/// boundary depends on keep their values, too. They do not take part.
template <int D>
class PressureProjection {
 public:
  explicit PressureProjection(const Body<D>& body);

  /// The cells that take part, in ascending order.
  std::span<const Index> cells() const { return cells_; }
  /// Position of a cell in cells(), or -1 if it does not take part.
  Index number(Index cell) const { return at(number_, cell); }
  /// Number of columns of Phi; calls f(column, value) for the entries of a row.
  Index unknowns() const { return static_cast<Index>(extension_.cols()); }
  template <class F>
  void for_extension(Index number, F&& f) const {
    for (typename Rows::InnerIterator entry(extension_, number); entry; ++entry)
      f(static_cast<Index>(entry.col()), entry.value());
  }
  /// Replaces the values of cells(). T is Real or Dual<Real>. The result has the same bits for any
  /// number of threads.
  template <class T>
  void apply(std::span<T> values) const;
  std::size_t bytes() const;

 private:
  using Rows = Eigen::SparseMatrix<Real, Eigen::RowMajor, Index>;
  /// Room for apply().
  template <class T>
  struct Room {
    std::vector<T> x, residual, direction, next;
  };

  void set_linear_fields(const Body<D>& body);
  void bound_eigenvalues();
  Real greatest_eigenvalue(Real shift, Real sign) const;
  template <class T>
  std::array<T, D + 1> take_linear_part(std::span<T> values) const;

  std::vector<Index> cells_, number_;
  std::vector<Real> volume_;          // W, [number]
  Rows extension_, weighted_, gram_;  // Phi, Phi^T W, M; columns of Phi are scaled so that M_ii = 1
  std::vector<std::array<Real, D + 1>> linear_;  // orthonormal in W, [number]
  Real least_ = 1, most_ = 1;                    // bounds of the eigenvalues of M
  int degree_ = 0;
  mutable std::tuple<Room<Real>, Room<Dual<Real>>> room_;
};

}  // namespace meniscus
