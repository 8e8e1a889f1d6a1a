// SPDX-License-Identifier: BSD-3-Clause
// Nodal cells: the union of the octants (2D: quadrants) of the grid cells at a node. They tile the
// body, and the smoothed gradients of the Q-SCNI integration are averages over them (RKPM
// note 5.3).
#pragma once
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

 private:
  void volume_points(Index node, CellQuadrature<D>& q) const;
  void facet_points(Index node, CellQuadrature<D>& q) const;
  void integrate(Index node, CellQuadrature<D>& q);

  const Grid<D>* grid_;
  NodeCells octants_;
  std::vector<std::uint8_t> boundary_sides_;  // per cell: bit `side` set if on the body's boundary
  std::vector<Real> volume_;
  std::vector<Vec<D>> centroid_;
  std::vector<Mat<D>> covariance_;
};

}  // namespace meniscus
