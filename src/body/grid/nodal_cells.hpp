// SPDX-License-Identifier: BSD-3-Clause
// Nodal cells: the union of the octants (2D: quadrants) of the grid cells at a node. They tile the
// body. The Q-SCNI integration averages gradients over them (RKPM note 5.3).
#pragma once
#include "body/grid/grid.hpp"
#include "kernel/particle_set.hpp"

#include <cstdint>
#include <vector>

namespace meniscus {

/// Quadrature of one nodal cell and of its closed boundary, exact for quadratic polynomials under
/// the maps of the cells. An octant has 3 points per direction, or D + 2 in directions in which its
/// cell is curved; its facets likewise. Weights are those of the grid: in a body of revolution
/// without the circles of the points. Buffers are kept between nodes.
template <int D>
struct CellQuadrature {
  std::vector<Vec<D>> volume_X;
  std::vector<Real> volume_w;    ///< sum = volume of the nodal cell in the grid
  std::vector<Vec<D>> facet_X;   ///< points of the octant facets on the cell boundary
  std::vector<Vec<D>> facet_dA;  ///< outward normal times weight; sum = 0
  /// Index of the first point on the boundary of the body; the points before it lie between two
  /// nodal cells. Both of these cells have bitwise the same points there, with opposite dA.
  std::size_t body_facets_begin = 0;
  /// A quarter (2D: half) of a facet of the body's boundary.
  struct BodyFacet {
    Index cell;              ///< of the grid
    int side;                ///< number of the side, as in Facet
    std::size_t begin, end;  ///< range of its points
  };
  std::vector<BodyFacet> body_facets;
};

/// A smaller quadrature of one nodal cell: its volume, the facets between it and other nodal cells,
/// and its part of the boundary of the body. In equal parallelepipeds the points are exact up to
/// degree 5, in their facets up to degree 3 (2D: 5). If octants are unequal or long compared with
/// the supports, corners and middle of each octant are used (in 2D two Gauss points per direction).
/// The differences between integrals and sums of polynomials are stored, too (RKPM note 5.6).
/// Buffers are kept between nodes.
template <int D>
struct CellSamples {
  /// Integral minus sum for the monomials of X - centre up to `degree`.
  template <int degree>
  using Missing = std::array<Real, static_cast<std::size_t>(monomial_count(D, degree))>;

  /// The points of volume and facets, each stored once. Padding points, which let the points of a
  /// facet begin at a multiple of four, belong to neither.
  std::vector<Vec<D>> X;
  std::vector<std::array<Index, D>> key;  ///< identifies a place; -1 for points without
  std::vector<Real> volume_w;             ///< of the first points; the others have none
  Missing<2> volume_missing;              ///< about the centroid
  bool volume_exact = true;               ///< volume_missing is rounding only

  struct FacetPoint {
    std::size_t number;  ///< in X
    Vec<D> dA;           ///< outward normal times weight
  };
  struct Facet {
    Index neighbor;                     ///< the other nodal cell; -1: the boundary
    std::size_t begin, end;             ///< range in facet_points
    Vec<D> centre;                      ///< mean of its points
    std::array<Missing<3>, D> missing;  ///< [K] with weight n_K dA
    bool exact;
  };
  std::vector<Facet> facets;             ///< in ascending order of neighbor
  std::vector<FacetPoint> facet_points;  ///< facet by facet, in ascending order of number

  /// Keeps the first `count` points.
  void resize(std::size_t count) {
    X.resize(count);
    key.resize(count);
  }
  void clear() {
    resize(0);
    volume_w.clear();
    volume_exact = true;
    facets.clear();
    facet_points.clear();
  }
};

template <int D>
struct FourFacetPoints;  // nodal_cells_samples

/// Volumes, centroids, covariances and quadratures of the nodal cells of a grid, by node number. In
/// a body of revolution, nodal cells are rings: volumes, centroids and covariances are weighted by
/// circles.
template <int D>
class NodalCells {
 public:
  /// `grid` must have its boundary facets and must outlive this object without changes. Throws
  /// InputError if a node belongs to no cell.
  explicit NodalCells(const Grid<D>& grid);

  Index size() const { return static_cast<Index>(volume_.size()); }
  Real volume(Index node) const { return at(volume_, node); }
  const Vec<D>& centroid(Index node) const { return at(centroid_, node); }
  /// S = (1/V) integral of (X - centroid)(X - centroid)^T.
  const Mat<D>& covariance(Index node) const { return at(covariance_, node); }

  /// Fills q for one node. Several threads may call this at once, each with its own q.
  void quadrature(Index node, CellQuadrature<D>& q) const;
  /// Fills q with the points on the boundary of the body only.
  void boundary_points(Index node, CellQuadrature<D>& q) const;
  /// Fills the samples of one node: the volume, the facets to nodes of higher number and to nodes
  /// below `first`, and, if `boundary`, its part of the boundary of the body.
  void sample(Index node, Index first, const ParticleSet<D>& particles, bool boundary,
              CellSamples<D>& samples) const;
  /// The nodes of lower number whose nodal cells share a facet with this one, in ascending order.
  void lower_neighbors(Index node, std::vector<Index>& neighbors) const;

 private:
  static constexpr Index no_neighbor = -1;
  /// The part within one grid cell of a facet of a nodal cell. With a neighbour it is the end of
  /// direction k of the octant, else the beginning, on the boundary of the body.
  struct FacetPart {
    Index neighbor, cell;
    int corner, k;
  };
  std::vector<FacetPart> facet_parts(Index node) const;
  /// Sample points are shared by the parts of a nodal cell, or each part has its own.
  enum class Sharing : std::uint8_t { whole, parts };
  /// True if direction k of an octant begins on the boundary of the body.
  bool on_boundary(Index cell, int corner, int k) const;
  /// The kind of the octant in SampleTable.
  unsigned kind(Index cell, int corner, Sharing sharing) const;
  /// True if an octant is long compared with the supports in some direction.
  bool is_long(Index node, Index cell, int corner, const ParticleSet<D>& particles) const;
  /// True if these octants are equal parallelepipeds and none is missing: in each direction, all of
  /// them are continued beyond the particle, or all end on the boundary. Samples that they share
  /// are then exact. For a facet, `between` is the direction at whose end it lies; for a volume it
  /// is -1.
  bool are_even(const auto& octants, int between) const;
  void sample_volume(Index node, const ParticleSet<D>& particles, CellSamples<D>& samples) const;
  void sample_facet(Index node, std::span<const FacetPart> parts, const ParticleSet<D>& particles,
                    CellSamples<D>& samples) const;
  /// Fill the samples. Return the largest difference from the exact moments, relative to their
  /// size.
  Real missing_of_volume(Index node, Sharing sharing, CellSamples<D>& samples) const;
  void gather_facet_points(std::span<const FacetPart> parts, Sharing sharing,
                           std::vector<FourFacetPoints<D>>& exact, CellSamples<D>& samples) const;
  Real missing_of_facet(std::span<const FacetPart> parts, Sharing sharing,
                        CellSamples<D>& samples) const;
  void facet_points(Index node, CellQuadrature<D>& q) const;
  void append_boundary(Index node, CellQuadrature<D>& q) const;
  /// Sets the volume, centroid and covariance of one nodal cell.
  void integrate(Index node);

  const Grid<D>* grid_;
  NodeCells octants_;
  std::vector<Index> equal_cells_;
  std::vector<std::uint8_t> boundary_sides_;  // [cell] bit `side`: on the boundary
  std::vector<Real> volume_;
  std::vector<Vec<D>> centroid_;
  std::vector<Mat<D>> covariance_;
};

}  // namespace meniscus
