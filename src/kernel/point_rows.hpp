// SPDX-License-Identifier: BSD-3-Clause
// Shape functions at evaluation points, stored as compressed rows. A row belongs to a point and has
// an entry for each particle whose support reaches it. Only requested derivatives are stored.
#pragma once
#include "kernel/particle_set.hpp"
#include "parallel/aligned.hpp"
#include "parallel/parallel.hpp"

#include <span>
#include <string>
#include <vector>

namespace meniscus {

/// The quantities that a row stores. Second derivatives are packed as in hessian_index().
struct RowContent {
  bool value = false, gradient = false, hessian = false;
};

/// Values, gradients and Hessians of shape functions in compressed rows.
///
/// Rows of a mirrored cloud are "folded" (axisymmetry note 2): an image A' adds N_A' to the entry
/// of its particle for components along the axis, which are even in x, and -N_A' for the component
/// 0 across it, which is odd. The arrays of the odd component are empty in other clouds.
template <int D>
struct PointRows {
  std::vector<Offset> start{0};  ///< [point + 1]
  UnsetVector<Index> particle;   ///< [entry], ascending within a row
  UnsetVector<Real> value;       ///< [entry]
  UnsetVector<Real> gradient;    ///< [entry][i]
  UnsetVector<Real> hessian;     ///< [entry][ij]
  bool folded = false;
  std::vector<Real> radius;  ///< [point] of folded rows: the distance of the point from the axis
  UnsetVector<Real> odd_value, odd_gradient, odd_hessian;

  Index size() const { return static_cast<Index>(start.size()) - 1; }
  Offset entries() const { return start.back(); }
  /// The particles of the entries of rows begin, ..., end - 1.
  std::span<const Index> of_rows(Index begin, Index end) const {
    return std::span(particle).subspan(static_cast<std::size_t>(at(start, begin)),
                                       static_cast<std::size_t>(at(start, end) - at(start, begin)));
  }
  /// Bytes of all arrays.
  std::size_t bytes() const;
};

/// Builds the rows at `points`. Points that follow each other should be near each other, since
/// groups of them share one search. Throws SolveError naming `body` and the point if the moment
/// matrix is unusable.
template <int D, int Degree = 2>
PointRows<D> build_point_rows(const ParticleSet<D>& particles, std::span<const Vec<D>> points,
                              RowContent content, const std::string& body);
/// Builds the rows of the points in the range `some`, with the same bits as if all were built. The
/// rows of all other points are empty.
template <int D>
PointRows<D> build_point_rows(const ParticleSet<D>& particles, std::span<const Vec<D>> points,
                              RowContent content, const std::string& body, ItemRange some);

}  // namespace meniscus
