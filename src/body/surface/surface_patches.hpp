// SPDX-License-Identifier: BSD-3-Clause
// The closed surface of a body as biquadratic (2D: quadratic) patches through material points. Area
// and enclosed volume belong to the same surface.
#pragma once
#include "body/body.hpp"
#include "body/surface/quadratic_patches.hpp"
#include "body/surface/wetted_wall.hpp"
#include "numbers/dual.hpp"
#include "numbers/resultant.hpp"
#include "parallel/step_reads.hpp"

#include <array>
#include <cstdint>

namespace meniscus {

/// Every boundary facet is the Lagrange patch x(xi) = sum_a L_a(xi) x_a, xi in [-1, 1]^(D-1), with
/// nodes at -1, 0, 1 per direction. The x_a = X_a + sum_A N_A(X_a) u_A are the current positions of
/// points X_a of the exact reference surface. Neighbouring facets share points, so that the surface
/// is closed.
///
/// With tangents t_k = x,k and the area normal m = t_1 x t_2 (2D: t turned clockwise), 3 Gauss
/// points per direction give
///   area    A = sum w |m|;
///   volume  V = 1/D sum w x . m        exact, hence without net force and torque;
///   height  h = z . centroid = sum w (z . x) (x . m) / ((D + 1) V)   along a direction z.
/// Gradients with respect to the particles follow by the chain rule through dm . b = dt_1 . (t_2 x
/// b) + dt_2 . (b x t_1). In 2D, area and volume are circumference and area, per unit depth.
///
/// In a body of revolution the patches are turned about the axis (axisymmetry note 6):
///   A = sum 2 pi w x_0 |m|,   V = sum pi w x_0^2 m_0,   h = sum pi w (z . x) x_0^2 m_0 / V.
/// Both ends of a curve are on the axis, or it is closed.
///
/// The points of the wetted faces of the body lie on their walls: x_a is the nearest point P(y_a)
/// of the wall to y_a = X_a + sum_A N_A(X_a) u_A, and gradients with respect to particles have the
/// factor DP^T (sharp line note 1).
template <int D>
class SurfacePatches {
 public:
  enum class Size { area, volume };

  /// Throws SolveError if shape functions cannot be built.
  explicit SurfacePatches(const Body<D>& body);
  /// Moves the walls of wetted faces to their places at a time. All functions of displacements or
  /// places use these.
  void at_time(Real time) const;
  /// From now on Size::area is the sum of share x area of each patch.
  void share_area(const std::vector<Real>& of_patch);

  /// The area or volume in the reference configuration.
  Real reference(Size size) const { return size == Size::area ? area_ : volume_; }
  /// The area or volume at the displacement coefficients `u` of the body.
  Real measure(Size size, const NodalVector* u) const;
  /// Moves this rank's points to `u`. All others have to be gathered (places()) before follow() and
  /// follow_height().
  void place(const NodalVector* u);
  Gathered places();
  /// Like measure(), at the places of the points; also stores the gradient for add_gradient().
  /// Allocates nothing. Returns zero on a rank that has no rows of the body.
  Real follow(Size size);
  /// force_A += factor d(size)/du_A for all particles of the body, with the gradient that the last
  /// follow() or follow_height() stored.
  void add_gradient(Real factor, const ForceVector& force);

  /// The area or volume at `u`, and its derivative in the direction `du`.
  Dual<Real> measure(Size size, const NodalVector* u, const NodalVector* du) const;
  /// force_A += derivative, in the direction `du`, of factor d(size)/du_A at `u`. Stores nothing.
  void add_gradient_change(Size size, const NodalVector* u, const NodalVector* du,
                           const Dual<Real>& factor, const ForceVector& force);

  /// The area of each patch.
  std::vector<Real> areas(const NodalVector* u) const;
  /// The places of all points, and their velocities.
  std::vector<Vec<D>> places_at(const NodalVector* u) const;
  NodalVectors velocities(const NodalVector* u, const NodalVector* v) const;

  /// Height of the centroid of the enclosed volume along the unit vector `along`.
  Real height(const Vec<D>& along, const NodalVector* u) const;
  /// Like height(), at the places of the points; also stores the gradient, as follow() does.
  Real follow_height(const Vec<D>& along);
  /// force_A += factor times the derivative, in the direction `du`, of the gradient of the height
  /// at `u`. Stores nothing.
  void add_height_gradient_change(const Vec<D>& along, const NodalVector* u, const NodalVector* du,
                                  Real factor, const ForceVector& force);
  /// Derivative, in the direction `du`, of the quantity that was followed last. All ranks call
  /// this; each reads `du` at its own points.
  Real followed_change(const NodalVector* du) const;
  /// Sums of x cross g over the points of each chunk, with their positions x and the stored
  /// gradient g of the quantity that was followed last; the result is to be gathered.
  ChunkTally<Eigen::Vector3d>& followed_moments();

  /// True if the body has wetted faces.
  bool on_walls() const { return !walls_.empty(); }
  /// The wall of a wetted face at the last at_time().
  const WettedWall<D>& wall_of_face(const std::string& face) const;
  /// Force and moment of a wall on points, and the power of this force on the velocity of the wall.
  struct WallForce {
    Resultant total;
    Real power = 0;
    friend WallForce operator+(WallForce a, const WallForce& b) {
      a.total += b.total;
      a.power += b.power;
      return a;
    }
  };
  /// Force and moment, in each chunk, by which walls hold the points against the force factor x
  /// (stored gradient of the quantity that was followed last); the result is to be gathered. With
  /// `face`, only the wall of this face.
  ChunkTally<WallForce>& wall_forces(Real factor, const std::string& face = "");

  /// force_A += factor sum_a N_A(X_a) g_a. Here g_a is the sum of `gradient` over the patches that
  /// contain point a; `gradient` is [group of four patches][a][i] with one lane per patch. Points
  /// with g_a = 0 are skipped.
  void add_to_particles(Real factor, const AlignedVector<Lanes>& gradient,
                        const ForceVector& force);

  /// Registers the particles that place() reads and add_gradient() sums into: the particles of this
  /// rank's own points. `first` is the number of the first particle of the body.
  void list_reads(StepReads& reads, Index first) const { reads.rows(chunk_sums_, first); }
  /// Registers only the particles that add_to_particles() sums into.
  void list_sums(StepReads& reads, Index first) const { reads.sums(chunk_sums_, first); }
  /// The points of this rank.
  ItemRange own_points() const { return chunk_sums_.own_rows(point_count()); }

  Index point_count() const { return static_cast<Index>(X_.size()); }
  Index patch_count() const { return patches_; }
  Index group_count() const { return (patches_ + 3) / 4; }
  /// The points of a patch; the first direction varies fastest.
  const std::array<Index, PatchFunctions<D>::nodes>& points_of(Index patch) const {
    return at(node_, patch);
  }
  /// Values of the shape functions at the points.
  const PointRows<D>& rows() const { return rows_; }
  /// Position of a point in the reference configuration.
  const Vec<D>& reference_place(Index point) const { return at(X_, point); }
  Offset pairs() const { return rows_.entries(); }
  std::size_t bytes() const;

 private:
  static constexpr int nodes = PatchFunctions<D>::nodes;
  template <class T>
  using Vector = std::array<T, D>;
  /// Positions of the nodes of four patches, one lane per patch.
  template <class T>
  using Corners = std::array<Vector<T>, nodes>;
  /// One of the entries that are summed to give the gradient with respect to a point.
  struct Share {
    std::size_t entry;  // index in gradient_ of the first component
    int lane;
  };

  void number_points(const Geometry<D>& geometry);
  void list_shares();
  /// Finds the points of the wetted faces.
  void list_walls(const Body<D>& body);
  /// The place of a point. Lane 3 is its distance from the wall before it was moved there.
  NodalVector place_of(Index point, const NodalVector* u) const;
  void place(const NodalVector* u, NodalVectors& x) const;
  /// The wall of a point, or null.
  const WettedWall<D>* wall_of(Index point) const {
    if (walls_.empty() || at(wall_of_, point) < 0) return nullptr;
    return &at(walls_, at(wall_of_, point)).wall;
  }
  /// Moves a point to its wall; the distance from there becomes lane 3.
  void move_to_wall(Index point, NodalVector& place) const;
  /// DP g at a point with this place.
  NodalVector projected(Index point, const NodalVector& place, const NodalVector& g) const;
  /// Changes of the places x of the points when coefficients change by du.
  NodalVectors changes(const NodalVectors& x, const NodalVector* du) const;
  /// A gradient with respect to the places of points, [group][a][i], and its change.
  struct ChangingGradient {
    AlignedVector<Lanes> value;  // empty without walls
    AlignedVector<Lanes> change;

    void set(Index k, const Dual<Lanes>& g) {
      at(change, k) = g.d;
      if (!value.empty()) at(value, k) = g.v;
    }
  };
  ChangingGradient changing_gradient() const;
  /// force_A += change of sum_a N_A(X_a) DP^T g_a at the places x, when coefficients change by du.
  void add_changes_to_particles(const ChangingGradient& gradient, const NodalVectors& x,
                                const NodalVector* du, const ForceVector& force);
  Real size_of_all(Size size, const NodalVectors& x) const;
  /// The nodes of a group, relative to the first of the positions `x`. No size depends on the
  /// origin, but round-off does.
  Corners<Lanes> corners(Index group, const NodalVectors& x) const;
  Corners<Dual<Lanes>> corners(Index group, const NodalVectors& x, const NodalVectors& dx) const;
  /// Area or volume of each of four patches. Also computes the gradient with respect to their
  /// nodes, [a][i], unless `gradient` is null. T is Lanes or Dual<Lanes>.
  template <class T>
  T group_size(Size size, Index group, const Corners<T>& place, T* gradient) const;
  template <class T>
  T group_area(const Corners<T>& place, T* gradient) const;
  template <class T>
  T group_volume(const Corners<T>& place, T* gradient) const;
  /// Sum of a function of position x and area normal m over the Gauss points of four patches, with
  /// its gradient as in group_size(). integrand(weight, x, m, by_x, by_m) returns the contribution
  /// of one point and sets its derivatives with respect to x and m.
  template <class T, class F>
  T group_sum(const Corners<T>& place, T* gradient, F&& integrand) const;
  /// Integral of the height over the volume, measured from the first point.
  template <class T>
  T group_moment(const Vec<D>& along, const Corners<T>& place, T* gradient) const;
  /// Gradient with respect to the place of a point, from `gradient` [group][a][i].
  NodalVector gradient_of_point(Index point, const AlignedVector<Lanes>& gradient) const;
  /// force_A += sum_a N_A(X_a) at_point(a).
  template <class F>
  void add_to_particles(const ForceVector& force, F&& at_point);
  /// Sum of `size` over the patches of a group. The last group may have lanes without a patch.
  Real sum_of_patches(Index group, const Lanes& size) const;

  bool revolved_;
  std::vector<PatchFunctions<D>> gauss_;
  Index patches_ = 0;
  std::vector<std::array<Index, nodes>> node_;  // [patch][a]: number of a point
  std::vector<Vec<D>> X_;                       // [point]
  PointRows<D> rows_;
  ChunkSums chunk_sums_;
  std::vector<Index> share_begin_;  // [point + 1]
  std::vector<Share> share_;
  /// A wetted face, with its wall and the velocity of the wall at the last at_time().
  struct Wetted {
    WettedFace<D> face;
    WettedWall<D> wall;
    Vec<D> velocity;
  };
  mutable std::vector<Wetted> walls_;
  std::vector<std::int8_t> wall_of_;  // [point] number of its wall, or -1; empty without walls
  AlignedVector<Lanes> area_share_;   // [group]; empty: all shares are one
  Real area_, volume_;                // in the reference configuration
  // Positions, and gradient [group][a][i] with one lane per patch, of the last follow().
  NodalVectors x_;
  AlignedVector<Lanes> gradient_;
  AlignedVector<Lanes> volume_gradient_;  // work space of follow_height(); empty before its first
  ChunkTally<Eigen::Vector3d> moments_;
  ChunkTally<WallForce> wall_forces_;  // empty without walls
};

/// The energy per area of each patch, by the wetted faces of the body, over the tension `gamma` of
/// the free surface.
template <int D>
std::vector<Real> tension_shares(const Body<D>& body, Real gamma);

}  // namespace meniscus
