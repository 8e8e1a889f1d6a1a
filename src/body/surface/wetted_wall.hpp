// SPDX-License-Identifier: BSD-3-Clause
// The wall on which a wetted face of a drop lies. Points of the face stay on the wall.
#pragma once
#include "body/surface/reference_surface.hpp"
#include "input/expression.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace meniscus {

/// A plane, or the surface of a ball, a cylinder (2D: a disk) or a hole of these shapes. The
/// nearest point of the wall to a point y is P(y) = y - d n, with the distance d of y from the
/// wall and the unit normal n. On round walls of radius R, n points away from the centre or the
/// axis, and
///
///   DP = (R / (R + d)) (I - n n^T - a a^T) + a a^T,
///
/// with the direction a of the axis of a cylinder. On a plane DP = I - n n^T.
template <int D>
class WettedWall {
 public:
  template <class T>
  using Vector = std::array<T, D>;

  static WettedWall plane(const Vec<D>& point, const Vec<D>& normal) {
    return {point, normal, Vec<D>::Zero(), 0};
  }
  static WettedWall ball(const Vec<D>& centre, Real radius) {
    return {centre, Vec<D>::Zero(), Vec<D>::Zero(), radius};
  }
  static WettedWall cylinder(const Vec<D>& centre, const Vec<D>& axis, Real radius) {
    return {centre, Vec<D>::Zero(), axis, radius};
  }

  /// The nearest point x to y, the normal there, and the distance d of y.
  template <class T>
  struct Foot {
    Vector<T> x, normal;
    T distance;
  };
  /// T is Real or Dual<Real>.
  template <class T>
  Foot<T> foot(const Vector<T>& y) const {
    Foot<T> f;
    Vector<T> from;
    for (int i = 0; i < D; ++i) at(from, i) = at(y, i) - point_[i];
    if (is_plane()) {
      f.distance = along(normal_, from);
      for (int i = 0; i < D; ++i) at(f.normal, i) = T(normal_[i]);
    } else {
      const T height = along(axis_, from);
      T square(0.0);
      for (int i = 0; i < D; ++i) {
        at(from, i) = at(from, i) - height * axis_[i];
        square = square + at(from, i) * at(from, i);
      }
      using std::sqrt;
      const T distance = sqrt(square);
      f.distance = distance - radius_;
      for (int i = 0; i < D; ++i) at(f.normal, i) = at(from, i) / distance;
    }
    for (int i = 0; i < D; ++i) at(f.x, i) = at(y, i) - f.distance * at(f.normal, i);
    return f;
  }
  /// The foot of the point at distance d from a point x of the wall.
  Foot<Real> foot_above(const Vector<Real>& x, Real distance) const {
    Foot<Real> f = foot<Real>(x);
    f.x = x;
    f.distance = distance;
    return f;
  }
  /// DP g = DP^T g at the point with this foot.
  template <class T>
  Vector<T> project(const Foot<T>& f, const Vector<T>& g) const {
    T across(0.0);
    for (int i = 0; i < D; ++i) across = across + at(f.normal, i) * at(g, i);
    Vector<T> p;
    for (int i = 0; i < D; ++i) at(p, i) = at(g, i) - across * at(f.normal, i);
    if (is_plane()) return p;
    const T shrink = radius_ / (radius_ + f.distance), height = along(axis_, p);
    for (int i = 0; i < D; ++i) at(p, i) = shrink * at(p, i) + (1.0 - shrink) * height * axis_[i];
    return p;
  }

  WettedWall moved_by(const Vec<D>& displacement) const {
    WettedWall wall = *this;
    wall.point_ += displacement;
    return wall;
  }

  bool is_plane() const { return radius_ == 0; }
  const Vec<D>& point() const { return point_; }  ///< of the plane or its axis, or the centre
  const Vec<D>& axis() const { return axis_; }    ///< zero without an axis
  Real radius() const { return radius_; }         ///< zero for a plane

 private:
  WettedWall(const Vec<D>& point, const Vec<D>& normal, const Vec<D>& axis, Real radius)
      : point_(point), normal_(normal), axis_(axis), radius_(radius) {}

  template <class T>
  static T along(const Vec<D>& direction, const Vector<T>& v) {
    T sum(0.0);
    for (int i = 0; i < D; ++i) sum = sum + direction[i] * at(v, i);
    return sum;
  }

  Vec<D> point_, normal_, axis_;
  Real radius_;
};

/// A face of a drop that lies on a wall.
template <int D>
struct WettedFace {
  std::string face;
  WettedWall<D> wall;  ///< at rest
  /// The energy per area of the wetted face is relative x tension of the free surface + absolute.
  /// With Young's contact angle theta, relative = - cos theta.
  Real relative = 0, absolute = 0;
  std::vector<Expression> displacement = {};  ///< of the wall, by time; empty: at rest
  Real time_step = 0;                         ///< of the differences by which it has a velocity

  Vec<D> displacement_at(Real time) const {
    Vec<D> d = Vec<D>::Zero();
    for (std::size_t i = 0; i < displacement.size(); ++i)
      d[static_cast<int>(i)] = displacement[i]({0, 0, 0}, time);
    return d;
  }
  /// Differences of fourth order.
  Vec<D> velocity_at(Real time) const {
    if (displacement.empty()) return Vec<D>::Zero();
    const Real h = time_step;
    return (8 * (displacement_at(time + h) - displacement_at(time - h)) -
            (displacement_at(time + 2 * h) - displacement_at(time - 2 * h))) /
           (12 * h);
  }
  WettedWall<D> wall_at(Real time) const {
    return displacement.empty() ? wall : wall.moved_by(displacement_at(time));
  }
  /// The time after which the wall is at rest.
  Real steady_after() const {
    Real after = 0;
    for (const Expression& d : displacement) after = std::max(after, d.steady_after());
    return after;
  }
};

/// The plane, ball or disk on which these points lie to 1e-6 of their extent. With `axis`, the
/// cylinder with this direction. Empty if there is none.
template <int D>
std::optional<WettedWall<D>> wall_through(const std::vector<Vec<D>>& points,
                                          const std::optional<Vec<D>>& axis);

}  // namespace meniscus
