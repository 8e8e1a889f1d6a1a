// SPDX-License-Identifier: BSD-3-Clause
// Quadratic patches through positions of a face, on which a pressure acts.
#pragma once
#include "body/surface/face_cells.hpp"
#include "body/surface/quadratic_patches.hpp"
#include "kernel/point_rows.hpp"
#include "physics/loads/traction.hpp"

#include <map>

namespace meniscus {

/// The surface of a face, whose points move with the particles of the body. Integrals over it are
/// exact for a uniform pressure.
template <int D>
class PressurePatches {
 public:
  static constexpr int nodes = PatchFunctions<D>::nodes, corners = 1 << (D - 1);

  /// `even`: the pressure does not depend on the place. The rim of the face is then closed by the
  /// planes on which it is held, if that is possible.
  PressurePatches(const Body<D>& body, const FaceCells<D>& cells, const HeldDirections& held,
                  bool even);

  bool closed() const { return closed_; }
  /// True if the face encloses a volume, alone or with the planes on which its rim is held.
  bool has_volume() const { return closed_ || !rim_.empty(); }
  /// The enclosed volume at positions x of the points.
  Real volume(const NodalVectors& x) const;

  /// The points with rows; further points follow them.
  const PointRows<D>& rows() const { return rows_; }
  Index points() const { return rows_.size(); }
  /// Reference positions of all points.
  const NodalVectors& X() const { return X_; }
  /// Sets the further points from the points with rows.
  void place_held_rim(NodalVectors& x) const;

  Index pieces() const { return static_cast<Index>(pieces_.size()); }
  Index gauss_points() const { return static_cast<Index>(functions_.front().size()); }
  /// Reference position of a Gauss point of a piece.
  Vec<D> place(Index piece, Index gauss_point) const;
  /// Computes the forces f_a = - INT p L_a m on the points at the positions x; m is the area
  /// normal. `pressures`: [piece][Gauss point].
  void find_forces(std::span<const Real> pressures, const NodalVectors& x, NodalVectors& forces);

  /// For each piece, the points with rows on which its forces depend, in ascending order.
  std::vector<std::vector<Index>> points_of_pieces() const;
  /// M(i Q + q, j Q + r) += minus the derivative of the force on q = points[..] of a piece.
  void add_stiffness(Index piece, std::span<const Index> points, std::span<const Real> pressures,
                     const NodalVectors& x, Eigen::MatrixXd& M) const;
  std::size_t bytes() const {
    return rows_.bytes() + pieces_.size() * sizeof(Piece) + X_.size() * sizeof(NodalVector) +
           piece_force_.size() * sizeof(Vec<D>);
  }

 private:
  /// A facet or a quarter of a facet.
  struct Piece {
    std::array<Index, nodes> point;
    std::size_t functions;  ///< index in functions_
  };
  /// A point on the rim of the face: its position x, the position y that its held directions allow,
  /// and the middle of both. `allowed` and `middle` have no rows; they come after all
  /// points with rows.
  struct RimPoint {
    Index point, allowed, middle;
    Mat<D> free;  ///< y = X + free (x - X)
  };
  /// Sides of pieces as pairs of points, the smaller number first. The value counts the pieces that
  /// have the side in this direction minus the pieces that have it in the opposite direction.
  using Sides = std::map<std::pair<Index, Index>, int>;

  /// An edge of the rim, in the sense of the face, with its middle (2D: one point).
  using RimEdge = std::array<Index, D == 3 ? 3 : 1>;
  /// A node of a piece as a function of a point with rows: T (x - X) + X.
  struct Source {
    Index point;
    Mat<D> T;
  };

  void list_pieces(const Body<D>& body, const FaceCells<D>& cells, const HeldDirections& held,
                   bool even);
  static void go_around(const std::array<Index, nodes>& point, int corner, Sides& sides);
  std::vector<RimEdge> rim_edges(const Sides& sides) const;
  void close_by_held_rim(const Sides& sides, const std::map<Index, Index>& node_of,
                         const HeldDirections& held, std::vector<Vec<D>>& X);
  bool weigh_volume(const std::array<std::vector<Real>, D>& planes, Real tolerance);
  Source source_of(Index point) const;
  CellPoint<D, D - 1> place(const PatchFunctions<D>& f, const Piece& piece,
                            const NodalVectors& x) const;
  const std::vector<PatchFunctions<D>>& functions_of(const Piece& piece) const {
    return functions_[piece.functions];
  }

  bool revolved_;
  std::vector<std::vector<PatchFunctions<D>>> functions_;  // of whole facets, then of quarters
  std::vector<Piece> pieces_;
  bool closed_ = false;
  std::vector<RimPoint> rim_;  // of an open face that encloses a volume
  Vec<D> volume_weight_ = Vec<D>::Constant(1.0 / D), volume_origin_ = Vec<D>::Zero();
  NodalVectors X_;
  PointRows<D> rows_;
  std::vector<Vec<D>> piece_force_;  // [piece][node], work space
};

}  // namespace meniscus
