// SPDX-License-Identifier: BSD-3-Clause
// Curvilinear grids of hexahedra (2D: quadrilaterals). Their nodes become the particles of a body,
// and their cells are used to integrate over it.
#pragma once
#include "body/grid/bulge.hpp"
#include "numbers/types.hpp"

#include <array>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace meniscus {

/// A boundary facet: a side that belongs to one cell only. Nodes are in tensor order: bit k of the
/// corner number is set at the upper end of facet direction k. The normal (3D: first x second
/// tangent; 2D: tangent turned clockwise by 90 degrees) points outwards.
template <int D>
struct Facet {
  std::array<Index, 1 << (D - 1)> nodes;
  Index cell = 0;
  int side = 0;    ///< 2 k at the lower end of cell direction k, 2 k + 1 at the upper
  int patch = -1;  ///< number of the surface patch that it lies on, or -1
  /// 3D: patches of the neighbouring facets, beyond the lower (2 t) and upper (2 t + 1) end of
  /// facet direction t.
  std::array<int, 2 * (D - 1)> patch_beyond = no_patches();

 private:
  static constexpr std::array<int, 2 * (D - 1)> no_patches() {
    std::array<int, 2 * (D - 1)> none{};
    none.fill(-1);
    return none;
  }
};

/// Node positions X and cells. Corners of a cell are in tensor order: bit k of the corner number is
/// set at the upper end of cell direction k. The directions form a right-handed system.
template <int D>
struct Grid {
  static_assert(SpaceDim<D>);
  static constexpr int corners = 1 << D;
  using Cell = std::array<Index, corners>;

  std::vector<Vec<D>> X;
  std::vector<Cell> cells;
  std::vector<Facet<D>> facets;  ///< the boundary; find_boundary() fills it
  /// Bulges of cells at a curved surface, set by curve_boundary(). Both are empty in a straight
  /// body.
  std::vector<Bulge<D>> bulges;
  std::vector<Index> bulge_of;  ///< [cell] number of its bulge, or -1
  /// 2D: the grid is the half plane x >= 0 of a body of revolution about the axis x = 0. Its facets
  /// belong to the surface of the body, so none lies on the axis. See half_plane().
  bool revolved = false;

  Index node_count() const { return static_cast<Index>(X.size()); }
  Index cell_count() const { return static_cast<Index>(cells.size()); }
  std::array<Vec<D>, corners> corner_points(const Cell& cell) const {
    std::array<Vec<D>, corners> points;
    for (int a = 0; a < corners; ++a) at(points, a) = at(X, at(cell, a));
    return points;
  }
  /// The bulge of a cell, or null for a straight cell.
  const Bulge<D>* bulge(Index cell) const {
    if (bulge_of.empty() || at(bulge_of, cell) < 0) return nullptr;
    return &at(bulges, at(bulge_of, cell));
  }
};

/// The factor of a volume or area of the grid at X in that of the body: the length 2 pi x of the
/// circle about the axis in a body of revolution, else 1.
template <int D>
Real circle(const Grid<D>& grid, const Vec<D>& X) {
  return grid.revolved ? 2 * std::numbers::pi * X[0] : 1;
}

/// The dimension of the space in which the body is: 3 for a body of revolution, else D.
template <int D>
int space_dimension(const Grid<D>& grid) {
  return grid.revolved ? 3 : D;
}

/// -1 or +1: coordinate xi_k of corner a of the reference cell [-1, 1]^D.
constexpr Real corner_sign(int a, int k) {
  return (a >> k) & 1 ? 1.0 : -1.0;
}

/// The position of a point of a P-dimensional cell in D dimensions, and J(i, k) = dX_i / dxi_k.
template <int D, int P>
struct CellPoint {
  Vec<D> X;
  Eigen::Matrix<Real, D, P> J;
};

/// Multilinear map of xi in [-1, 1]^P for corners in tensor order (cells: P = D; facets: P = D -
/// 1).
template <int D, int P>
CellPoint<D, P> multilinear(const std::array<Vec<D>, (1 << P)>& corners, const Vec<P>& xi) {
  CellPoint<D, P> point{Vec<D>::Zero(), Eigen::Matrix<Real, D, P>::Zero()};
  for (int a = 0; a < (1 << P); ++a) {
    Real N = 1;
    Vec<P> dN = Vec<P>::Ones();
    for (int k = 0; k < P; ++k) {
      const Real value = 0.5 * (1 + corner_sign(a, k) * xi[k]);
      N *= value;
      for (int l = 0; l < P; ++l) dN[l] *= l == k ? 0.5 * corner_sign(a, k) : value;
    }
    point.X += N * at(corners, a);
    point.J += at(corners, a) * dN.transpose();
  }
  return point;
}

/// The derivatives dN_a / dxi of the functions of the multilinear map.
template <int P>
std::array<Vec<P>, (1 << P)> corner_slopes(const Vec<P>& xi) {
  std::array<Vec<P>, (1 << P)> slopes;
  for (int a = 0; a < (1 << P); ++a)
    for (int k = 0; k < P; ++k) {
      Real& slope = at(slopes, a)[k] = 0.5 * corner_sign(a, k);
      for (int l = 0; l < P; ++l)
        if (l != k) slope *= 0.5 * (1 + corner_sign(a, l) * xi[l]);
    }
  return slopes;
}

/// The map of a cell: multilinear, plus its bulge if it has one.
template <int D>
CellPoint<D, D> cell_point(const std::array<Vec<D>, (1 << D)>& corners, const Bulge<D>* bulge,
                           const Vec<D>& xi) {
  CellPoint<D, D> point = multilinear<D, D>(corners, xi);
  if (bulge) {
    const BulgeFunctions<D> functions(xi);
    point.X += bulge->deviation.lazyProduct(functions.N);
    point.J += bulge->deviation.lazyProduct(functions.dN);
  }
  return point;
}

/// Sets grid.facets from the cells of a conforming grid, ordered by cell and side. Throws
/// InputError naming the cells if more than two share a side.
template <int D>
void find_boundary(Grid<D>& grid);

/// A point of the cell where det J <= 0, if there is one. Checks the 3^D points {-1, 0, 1}^D; for
/// straight cells in 2D this proves det J > 0 everywhere.
template <int D>
std::optional<CellPoint<D, D>> find_fold(const Grid<D>& grid, Index cell);

/// Throws InputError naming the first folded cell, the place and the Jacobian. `cause` begins the
/// message, e.g. "the shape".
template <int D>
void check_jacobians(const Grid<D>& grid, const std::string& cause);

/// The cells at each node in ascending order, and the corner of each cell that the node is.
struct NodeCells {
  struct Entry {
    Index cell;
    std::int32_t corner;
  };
  std::vector<Offset> row;  ///< cells of node i: entry[row[i]] .. entry[row[i + 1]]
  std::vector<Entry> entry;

  std::span<const Entry> of(Index node) const {
    return {entry.data() + at(row, node), entry.data() + at(row, node + 1)};
  }
};

template <int D>
NodeCells cells_of_nodes(const Grid<D>& grid);

/// Volume (2D: area) of the body, exact for the maps of its cells.
template <int D>
Real volume(const Grid<D>& grid);

/// The edge length of a cube (2D: square) with the mean volume of the cells.
template <int D>
Real mean_spacing(const Grid<D>& grid);

/// For each node the mean, over the cells around it, of the root mean square of their diagonals. In
/// a lattice this is sqrt(D) spacings, also at the boundary. For simplices it is the diagonal of
/// the cube (2D: square) that could be cut into such simplices. Lengths are measured after the
/// inverse of the symmetric stretch U was applied (ParticleSet).
template <int D>
std::vector<Real> diagonals_around_nodes(const Grid<D>& grid, const Mat<D>& stretch);

/// Supports from the grid: `factor` times diagonals_around_nodes(), [node].
template <int D>
std::vector<Real> supports_by_cells(const Grid<D>& grid, const Mat<D>& stretch, Real factor);

/// The mean stretch U of the cells: symmetric, det U = 1, U^2 proportional to the sum of J J^T at
/// the centres of the cells. If a map A made this grid from cells that were isotropic on average,
/// such as the cells of a ball, then U is the left stretch of A. Returns U = I if U deviates from I
/// by less than 1e-9.
template <int D>
Mat<D> mean_stretch(const Grid<D>& grid);

/// The nodes on boundary facets, in ascending order.
template <int D>
std::vector<Index> boundary_nodes(const Grid<D>& grid);

/// Boundary facets cut into simplices with outward normals: triangles along the shorter diagonal
/// (3D), or segments (2D). Facet f has the simplices f * (D - 1), ..., (f + 1) * (D - 1) - 1.
template <int D>
std::vector<std::array<Index, D>> triangulate_boundary(const Grid<D>& grid);

/// Moves the interior nodes one after the other. Each coordinate changes by a uniform random number
/// of +- `fraction` times the shortest cell edge at that node; a move that folds a cell is drawn
/// again. Boundary nodes and bulges stay. The result depends on the seed only, not on the machine.
/// Throws InputError if a node finds no place in 100 draws or if `fraction` is negative.
template <int D>
void jitter_interior(Grid<D>& grid, Real fraction, std::uint64_t seed);

/// Gauss points of the cells.
template <int D>
struct CellPoints {
  std::vector<Vec<D>> X;
  std::vector<Real> weight;  ///< reference volume
  int per_cell = 0;          ///< points of cell e: [e * per_cell, (e + 1) * per_cell)
};

/// k Gauss points per direction in every cell, 1 <= k <= 20.
template <int D>
CellPoints<D> cell_gauss_points(const Grid<D>& grid, int k);

}  // namespace meniscus
