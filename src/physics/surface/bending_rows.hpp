// SPDX-License-Identifier: BSD-3-Clause
// Rows of shape functions for the curvature of the surface of a body: derivatives by two lengths
// along the reference surface at Gauss points of the facets (membranes note 2).
#pragma once
#include "body/body.hpp"
#include "numbers/dual.hpp"
#include "physics/surface/bending.hpp"
#include "physics/surface/surface_sites.hpp"

#include <type_traits>

namespace meniscus {

/// The rows of all Gauss points of the surface of a body. The parameters of a point are two lengths
/// along tangents of the reference. In 2D the second one is along the depth, and in a body of
/// revolution along the circle.
template <int D>
class BendingRows {
 public:
  /// Throws InputError if the surface of the body has edges or is made of flat facets.
  BendingRows(const Body<D>& body, const SurfaceSites& sites);

  Index size() const { return static_cast<Index>(area_.size()); }
  /// Reference area of a point; areas of all points add up to the surface of the body.
  Real area(Index q) const { return at(area_, q); }
  /// 2H of the reference.
  Real twice_mean_curvature(Index q) const {
    return CurvedPoint<Real>(at(rest_, q)).twice_mean_curvature;
  }

  /// Derivatives of the positions at displacements u.
  SurfaceDerivatives<Real> derivatives(Index q, const NodalVector* u) const {
    SurfaceDerivatives<Real> d = changes(q, u);
    for (std::size_t k = 0; k < d.size(); ++k)
      for (std::size_t i = 0; i < 3; ++i) d[k][i] += at(rest_, q)[k][i];
    return d;
  }
  /// Derivatives of the displacements du.
  SurfaceDerivatives<Real> changes(Index q, const NodalVector* du) const;
  /// force_A += factor sum_k slope_k N_A,k, the transpose of changes().
  void scatter(Index q, Real factor, const SurfaceDerivatives<Real>& slope,
               NodalVector* force) const;

  ChunkSums chunk_sums(const Body<D>& body) const { return body.chunk_sums(start_, particle_); }
  std::size_t bytes() const;
  Offset pairs() const { return start_.back(); }

 private:
  /// Numbers of an entry: in 3D N,1 N,2 N,11 N,12 N,22; in 2D N, N,1 and N,11, for each component.
  using Number = std::conditional_t<D == 3, Real, Lanes>;
  static constexpr std::size_t numbers = D == 3 ? 5 : 3;
  using Entry = std::array<Number, numbers>;

  void add_point(const PointRows<D>& rows, const SurfacePoints<D>& surface, Index q);

  std::vector<Offset> start_{0};
  std::vector<Index> particle_;
  AlignedVector<Entry> entry_;
  std::vector<Real> area_;
  std::vector<Real> radius_;  // of points of a body of revolution
  std::vector<SurfaceDerivatives<Real>> rest_;
};

}  // namespace meniscus
