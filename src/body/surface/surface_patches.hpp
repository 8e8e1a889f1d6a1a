// SPDX-License-Identifier: BSD-3-Clause
// The closed surface of a body as biquadratic (2D: quadratic) patches through places of material
// points: one surface that has both an area and an enclosed volume.
#pragma once
#include "body/body.hpp"
#include "body/surface/quadratic_patches.hpp"
#include "numbers/dual.hpp"
#include "parallel/step_reads.hpp"

#include <array>

namespace meniscus {

/// Every boundary facet is the Lagrange patch x(xi) = sum_a L_a(xi) x_a, xi in [-1, 1]^(D-1), with
/// nodes at -1, 0, 1 per direction: the places x_a = X_a + sum_A N_A(X_a) u_A of points X_a of the
/// exact reference surface. Neighbouring facets share points, so that the surface is closed.
///
/// With tangents t_k = x,k and the area normal m = t_1 x t_2 (2D: t turned clockwise), 3 Gauss
/// points per direction give
///   area    A = sum w |m|
///   volume  V = 1/D sum w x . m        exact, hence without net force and torque
///   height  h = z . centroid = sum w (z . x) (x . m) / ((D + 1) V)   along a direction z
/// and the gradients of both with respect to the particles, by the chain rule through
/// dm . b = dt_1 . (t_2 x b) + dt_2 . (b x t_1). In 2D: circumference and area, per unit depth.
template <int D>
class SurfacePatches {
 public:
  enum class Size { area, volume };

  /// Throws SolveError if shape functions cannot be built.
  explicit SurfacePatches(const Body<D>& body);

  /// A size in the reference configuration.
  Real reference(Size size) const { return size == Size::area ? area_ : volume_; }
  /// A size at the displacement coefficients `u` of the body.
  Real measure(Size size, const NodalVector* u) const;
  /// The same, and its gradient is remembered; ranks move each a part of the points. Allocates
  /// nothing. A rank that has no rows of the body does nothing and says zero.
  Real follow(Size size, const NodalVector* u);
  /// force_A += factor d(size)/du_A of what was followed last, over the particles of the body.
  void add_gradient(Real factor, std::span<NodalVector> force);

  /// A size at `u` and its change with `du`.
  Dual<Real> measure(Size size, const NodalVector* u, const NodalVector* du) const;
  /// force_A += change with `du` of factor d(size)/du_A at `u`. Nothing is remembered.
  void add_gradient_change(Size size, const NodalVector* u, const NodalVector* du,
                           const Dual<Real>& factor, std::span<NodalVector> force);

  /// Height of the centroid of the enclosed volume along a direction.
  Real height(const Vec<D>& along, const NodalVector* u) const;
  /// Height of the centroid, whose gradient is remembered as by follow().
  Real follow_height(const Vec<D>& along, const NodalVector* u);
  /// force_A += factor times the change with `du` of the gradient of the height at `u`. Nothing is
  /// remembered.
  void add_height_gradient_change(const Vec<D>& along, const NodalVector* u, const NodalVector* du,
                                  Real factor, std::span<NodalVector> force);
  /// Change with `du` of what was followed last. All ranks call this; each reads `du` at its own
  /// points.
  Real followed_change(const NodalVector* du) const;
  /// Sum of x cross g over the points, x their places and g what was followed last. All ranks call
  /// this.
  Eigen::Vector3d followed_moment() const;

  /// force_A += factor sum_a N_A(X_a) g_a, where g_a is the sum over the patches of a point of
  /// `gradient`, which is [group of four patches][a][i], a lane per patch. Points whose g_a is zero
  /// cost nothing.
  void add_to_particles(Real factor, const AlignedVector<Lanes>& gradient,
                        std::span<NodalVector> force);

  /// Of follow() and add_gradient(): a rank reads what moves its own points. The particles of the
  /// body begin at `first`.
  void tell_reads(StepReads& reads, Index first) { reads.rows(windows_, first); }
  /// Of add_to_particles() alone.
  void tell_sums(StepReads& reads, Index first) { reads.sums(windows_, first); }

  Index point_count() const { return static_cast<Index>(X_.size()); }
  Index patch_count() const { return patches_; }
  Index group_count() const { return (patches_ + 3) / 4; }
  /// The points of a patch, the first direction fastest.
  const std::array<Index, PatchFunctions<D>::nodes>& points_of(Index patch) const {
    return at(node_, patch);
  }
  /// Shape functions at the points.
  const PointRows<D>& rows() const { return rows_; }
  /// Of a point in the reference.
  const Vec<D>& reference_place(Index point) const { return at(X_, point); }
  Offset pairs() const { return rows_.entries(); }
  std::size_t bytes() const;

 private:
  static constexpr int nodes = PatchFunctions<D>::nodes;
  template <class T>
  using Vector = std::array<T, D>;
  /// Places of the nodes of four patches, a lane per patch.
  template <class T>
  using Corners = std::array<Vector<T>, nodes>;
  /// Where a component of the gradient with respect to a point is added up from.
  struct Share {
    std::size_t entry;  // in gradient_, of the first component
    int lane;
  };

  void number_points(const Geometry<D>& geometry);
  void list_shares();
  NodalVector place_of(Index point, const NodalVector* u) const;
  void place(const NodalVector* u, NodalVectors& x) const;
  /// Displacements of the points.
  NodalVectors values(const NodalVector* u) const;
  Real size_of_all(Size size, const NodalVectors& x) const;
  /// The nodes of a group from one of the places `x`: no size depends on the origin, round-off
  /// does.
  Corners<Lanes> corners(Index group, const NodalVectors& x) const;
  Corners<Dual<Lanes>> corners(Index group, const NodalVectors& x, const NodalVectors& dx) const;
  /// Size of each of four patches; its gradient with respect to their nodes, [a][i], if asked for.
  /// T is Lanes or Dual<Lanes>.
  template <class T>
  T group_size(Size size, const Corners<T>& place, T* gradient) const;
  /// Sum over the Gauss points of four patches of a function of place and area normal m, and its
  /// gradient as that of group_size(). integrand(weight, x, m, by_x, by_m) returns the share of a
  /// point and sets the derivatives of that share.
  template <class T, class F>
  T group_sum(const Corners<T>& place, T* gradient, F&& integrand) const;
  /// Integral of the height over the volume, from the first point.
  template <class T>
  T group_moment(const Vec<D>& along, const Corners<T>& place, T* gradient) const;
  /// Moves the points of this rank to `u` and brings those of the others; false on a rank that has
  /// no rows of the body.
  bool move_points(const NodalVector* u);
  /// Gradient [group][a][i] with respect to a point.
  NodalVector gradient_of_point(Index point, const AlignedVector<Lanes>& gradient) const;
  /// Of the patches of a group: the last may have lanes without one.
  Real sum_of_patches(Index group, const Lanes& size) const;

  std::vector<PatchFunctions<D>> gauss_;
  Index patches_ = 0;
  std::vector<std::array<Index, nodes>> node_;  // [patch][a]: number of a point
  std::vector<Vec<D>> X_;                       // [point]
  PointRows<D> rows_;
  ForceWindows windows_;
  std::vector<Index> share_begin_;  // [point + 1]
  std::vector<Share> share_;
  Real area_, volume_;  // of the reference
  // Of what was followed last: places, and gradient [group][a][i] with a patch per lane.
  NodalVectors x_;
  AlignedVector<Lanes> gradient_;
  AlignedVector<Lanes> volume_gradient_;  // work space of follow_height(); empty before its first
};

}  // namespace meniscus
