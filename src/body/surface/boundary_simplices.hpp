// SPDX-License-Identifier: BSD-3-Clause
// The boundary of a body as flat triangles (2D: segments) between its boundary particles.
#pragma once
#include "body/body.hpp"
#include "kernel/row_sums.hpp"
#include "parallel/step_reads.hpp"

#include <array>

namespace meniscus {

template <int D>
struct BoundarySimplices {
  std::vector<Vec<D>> X;                      ///< reference positions of the boundary particles
  std::vector<std::array<Index, D>> corners;  ///< [simplex] numbers in X
  PointRows<D> rows;                          ///< shape functions at X
  ChunkSums chunk_sums;                       ///< of the rows

  explicit BoundarySimplices(const Body<D>& body) {
    std::vector<Index> number(static_cast<std::size_t>(body.size()), -1);
    for (const Index A : boundary_nodes(body.geometry.grid)) {
      at(number, A) = static_cast<Index>(X.size());
      X.push_back(at(body.particles.X(), A));
    }
    corners = triangulate_boundary(body.geometry.grid);
    for (auto& simplex : corners)
      for (Index& A : simplex) A = at(number, A);
    rows = build_point_rows<D>(body.particles, X, {.value = true}, body.name);
    chunk_sums = body.chunk_sums(rows.start, rows.particle);
  }

  /// Sets x[B] to the current positions, at the displacement coefficients u of the body. x has the
  /// size of X.
  void find_places(const NodalVector* u, std::vector<Vec<D>>& x) const {
    parallel_for(rows.size(), [&](Index B) { at(x, B) = at(X, B) + displacement(B, u); });
  }
  Vec<D> displacement(Index B, const NodalVector* u) const {
    const Lanes sum = value_at(rows, B, u);
    Vec<D> moved;
    for (int i = 0; i < D; ++i) moved[i] = sum[i];
    return moved;
  }
  /// force_A += sum_B N_A(X_B) load_B over the particles A of the body.
  void scatter(const NodalVectors& load, const ForceVector& force) {
    chunk_sums.accumulate(force, [&](int, Index begin, Index end, NodalVector* f) {
      for (Index B = begin; B < end; ++B) scatter_value(rows, B, at(load, B), f);
    });
  }
  static std::array<Vec<D>, D> places_of(const std::array<Index, D>& simplex,
                                         const std::vector<Vec<D>>& x) {
    std::array<Vec<D>, D> places;
    for (std::size_t k = 0; k < D; ++k) places[k] = at(x, simplex[k]);
    return places;
  }
  /// Registers the reads of a step. Every rank reads all boundary particles. `first`: number of the
  /// first particle of the body.
  void list_reads(StepReads& reads, Index first) const {
    reads.particles(rows.particle, first);
    reads.rows(chunk_sums, first);
  }
  std::size_t bytes() const {
    return rows.bytes() + chunk_sums.bytes() + X.size() * sizeof(Vec<D>) +
           corners.size() * sizeof(corners[0]);
  }
};

}  // namespace meniscus
