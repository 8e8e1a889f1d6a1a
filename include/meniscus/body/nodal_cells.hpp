// SPDX-License-Identifier: BSD-3-Clause
// Nodal cells: the union of the octants (2D: quadrants) of the grid cells at a node. They tile the
// body, and the smoothed gradients of the Q-SCNI integration are averages over them (RKPM
// note 5.3).
#pragma once
#include "meniscus/approx/particle_set.hpp"
#include "meniscus/body/grid.hpp"

#include <cstdint>
#include <vector>

namespace meniscus {

/// Quadrature of one nodal cell and of its closed boundary; exact for what cell maps and
/// quadratic polynomials give. An octant has 3 points per direction, D + 2 in the directions in
/// which its cell is curved; its facets likewise. Reused from node to node: buffers keep their
/// memory.
template <int D>
struct CellQuadrature {
  std::vector<Vec<D>> volume_X;
  std::vector<Real> volume_w;    ///< weights; sum = volume of the nodal cell
  std::vector<Vec<D>> facet_X;   ///< points of the octant facets on the cell boundary
  std::vector<Vec<D>> facet_dA;  ///< outward normal times weight; sum = 0
  /// Points [0, body_facets_begin) lie between two nodal cells, the others on the body's boundary.
  /// Of the former, the neighbouring nodal cell has the same points, with dA of opposite sign, bit
  /// for bit.
  std::size_t body_facets_begin = 0;
  /// A quarter (2D: half) of a facet of the body's boundary.
  struct BodyFacet {
    Index cell;              ///< of the grid
    int side;                ///< as in Facet
    std::size_t begin, end;  ///< its points
  };
  std::vector<BodyFacet> body_facets;
};

/// Few points for the integrals of smooth functions over one nodal cell, over the facets between it
/// and other nodal cells, and over its part of the boundary of the body: as many as are exact up to
/// the fifth degree in equal parallelepipeds, and to the third in their facets; corners and middle
/// of each octant (in the plane two per direction) where octants are unequal or long beside the
/// supports. What sums over them miss of the integrals of polynomials goes with them (RKPM
/// note 5.6). Reused from node to node.
template <int D>
struct CellSamples {
  /// Integral minus sum, for the monomials of X - centre up to `degree`.
  template <int degree>
  using Missing = std::array<Real, static_cast<std::size_t>(monomial_count(D, degree))>;

  /// Of the volume and the facets: each point once, whichever of them have it. Points that only
  /// fill up fours, so that those of a facet come together, are of none.
  std::vector<Vec<D>> X;
  std::vector<std::array<Index, D>> key;  ///< the same for the same place; none: -1
  std::vector<Real> volume_w;             ///< of the first points; the others have none
  Missing<2> volume_missing;              ///< centre: the centroid
  bool volume_exact = true;               ///< nothing but rounding is missing

  struct FacetPoint {
    std::size_t number;  ///< in X
    Vec<D> dA;           ///< outward normal times weight
  };
  struct Facet {
    Index neighbor;                     ///< the other nodal cell; -1: the boundary of the body
    std::size_t begin, end;             ///< its points
    Vec<D> centre;                      ///< their mean
    std::array<Missing<3>, D> missing;  ///< [K] with n_K dA
    bool exact;
  };
  std::vector<Facet> facets;             ///< by ascending neighbor
  std::vector<FacetPoint> facet_points;  ///< of each facet by ascending number

  /// Without points from this one on.
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

/// Volumes, centroids, covariances and quadratures of the nodal cells of a grid, by node.
template <int D>
class NodalCells {
 public:
  /// `grid` must have its boundary found, outlive this object, and not change.
  /// Throws InputError if a node belongs to no cell.
  explicit NodalCells(const Grid<D>& grid);

  Index size() const { return static_cast<Index>(volume_.size()); }
  Real volume(Index node) const { return at(volume_, node); }
  const Vec<D>& centroid(Index node) const { return at(centroid_, node); }
  /// S = (1/V) integral of (X - centroid)(X - centroid)^T.
  const Mat<D>& covariance(Index node) const { return at(covariance_, node); }

  /// Fills q for one node. Safe to call at the same time from several threads, each with its own q.
  void quadrature(Index node, CellQuadrature<D>& q) const;
  /// Only the points on the boundary of the body.
  void boundary_points(Index node, CellQuadrature<D>& q) const;
  /// Fills the samples of one node, with the facets towards nodes of higher number and towards
  /// those below `first`, and if `boundary` with its part of the boundary of the body, likewise.
  void sample(Index node, Index first, const ParticleSet<D>& particles, bool boundary,
              CellSamples<D>& samples) const;
  /// Nodes of lower number whose nodal cells share a facet with this one, ascending.
  void lower_neighbors(Index node, std::vector<Index>& neighbors) const;

 private:
  static constexpr Index no_neighbor = -1;
  /// A facet within one grid cell, seen from the node: end of direction k of its octant; without
  /// neighbor its beginning, on the boundary of the body.
  struct FacetPart {
    Index neighbor, cell;
    int corner, k;
  };
  std::vector<FacetPart> facet_parts(Index node) const;
  /// Whether the points are those of the nodal cell or of each of its parts.
  enum class Sharing : std::uint8_t { whole, parts };
  /// Whether direction k of an octant begins on the boundary of the body.
  bool on_boundary(Index cell, int corner, int k) const;
  /// Of an octant, as in SampleTable.
  unsigned kind(Index cell, int corner, Sharing sharing) const;
  /// Whether an octant is long beside the supports in some direction.
  bool is_long(Index node, Index cell, int corner, const ParticleSet<D>& particles) const;
  /// Whether these octants, or parts of a facet between two nodal cells (the end of direction
  /// `between`; volumes: -1), are equal and have all that continue them beyond the particle: then
  /// samples that they share miss nothing.
  bool are_even(const auto& octants, int between) const;
  void sample_volume(Index node, const ParticleSet<D>& particles, CellSamples<D>& samples) const;
  void sample_facet(Index node, std::span<const FacetPart> parts, const ParticleSet<D>& particles,
                    CellSamples<D>& samples) const;
  /// Fill the samples and return how much is missing, relative to what there is.
  Real missing_of_volume(Index node, Sharing sharing, CellSamples<D>& samples) const;
  Real missing_of_facet(std::span<const FacetPart> parts, Sharing sharing,
                        CellSamples<D>& samples) const;
  void facet_points(Index node, CellQuadrature<D>& q) const;
  void append_boundary(Index node, CellQuadrature<D>& q) const;
  /// Sets the volume, centroid and covariance of one nodal cell.
  void integrate(Index node);

  const Grid<D>* grid_;
  NodeCells octants_;
  std::vector<Index> equal_cells_;
  std::vector<std::uint8_t> boundary_sides_;  // per cell: bit `side` set if on the body's boundary
  std::vector<Real> volume_;
  std::vector<Vec<D>> centroid_;
  std::vector<Mat<D>> covariance_;
};

}  // namespace meniscus
