// SPDX-License-Identifier: BSD-3-Clause
// Shape functions at evaluation points, stored as compressed rows: a row per point, an entry per
// particle that reaches it. Only the derivative orders asked for exist.
#pragma once
#include "meniscus/approx/particle_set.hpp"
#include "meniscus/core/aligned.hpp"
#include "meniscus/core/parallel.hpp"

#include <span>
#include <string>
#include <vector>

namespace meniscus {

/// What a row stores. Second derivatives are packed as in hessian_index().
struct RowContent {
  bool value = false, gradient = false, hessian = false;
};

/// Values, gradients and Hessians of shape functions in compressed rows.
template <int D>
struct PointRows {
  std::vector<Offset> start{0};  ///< [point + 1]
  UnsetVector<Index> particle;   ///< [entry], ascending within a row
  UnsetVector<Real> value;       ///< [entry]
  UnsetVector<Real> gradient;    ///< [entry][i]
  UnsetVector<Real> hessian;     ///< [entry][ij]

  Index size() const { return static_cast<Index>(start.size()) - 1; }
  Offset entries() const { return start.back(); }
  /// Particles of these rows.
  std::span<const Index> of_rows(Index begin, Index end) const {
    return std::span(particle).subspan(static_cast<std::size_t>(at(start, begin)),
                                       static_cast<std::size_t>(at(start, end) - at(start, begin)));
  }
  /// Bytes of all arrays.
  std::size_t bytes() const;
};

/// Rows at `points` (neighbours in the array should be neighbours in space: points are treated in
/// groups that share one search). Throws SolveError naming `body` and the point where the moment
/// matrix is unusable.
template <int D, int Degree = 2>
PointRows<D> build_point_rows(const ParticleSet<D>& particles, std::span<const Vec<D>> points,
                              RowContent content, const std::string& body);
/// The rows of some of the points, with the bits that they have among all; those of all others are
/// empty.
template <int D>
PointRows<D> build_point_rows(const ParticleSet<D>& particles, std::span<const Vec<D>> points,
                              RowContent content, const std::string& body, ItemRange some);

}  // namespace meniscus
