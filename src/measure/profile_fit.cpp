// SPDX-License-Identifier: BSD-3-Clause
// The fit of a profile, and of its change with the direction from its axis.
#include "measure/profile_fit.hpp"

#include "numbers/dense.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace meniscus {
namespace {

/// Distance of the line from the axis along the wall, contact angle, and sum of the curvatures at
/// the height of the wall on the axis.
using ProfileNumbers = Vec<3>;

/// A curve in the half plane (r, z) of an axis, with the liquid at its left, and solutions for
/// small displacements along its normal. The first begins as 1 with the slope 0, the second as 0
/// with the slope 1; the third begins as 0, and its pressure grows outward as r.
struct FittedCurve {
  struct Point {
    Vec<2> place;
    Real angle;  ///< of the tangent against the direction of r
    Real curvature;
    Vec<3> displacement, slope;  ///< of the solutions
  };
  std::vector<Point> points;

  struct Foot {
    Real distance;        ///< positive at the right of the curve
    Vec<3> displacement;  ///< of the solutions
  };
  /// The foot of a point. The arc at the nearest point of the curve counts as circular.
  Foot foot(const Vec<2>& x) const {
    const Point* nearest = nullptr;
    Real least = std::numeric_limits<Real>::max();
    for (const Point& point : points) {
      const Real square = (x - point.place).squaredNorm();
      if (nearest && !(square < least)) continue;
      least = square;
      nearest = &point;
    }
    const Vec<2> away = x - nearest->place;
    const Real c = std::cos(nearest->angle), s = std::sin(nearest->angle);
    const Real along = c * away[0] + s * away[1];
    return {s * away[0] - c * away[1] + nearest->curvature * along * along / 2,
            nearest->displacement + along * nearest->slope};
  }
};

/// A wall in the half plane: z = 0, or a circle through the origin with its centre on the axis.
struct WallCurve {
  Real curvature;

  Vec<2> place(Real arc) const {
    if (curvature == 0) return {arc, 0};
    const Real turn = curvature * arc;
    return {std::sin(turn) / curvature, (std::cos(turn) - 1) / curvature};
  }
  Real height(const Vec<2>& x) const {
    if (curvature == 0) return x[1];
    const Real to_centre = std::hypot(x[0], x[1] + 1 / curvature);
    return std::copysign(to_centre, curvature) - 1 / curvature;
  }
  Real arc(const Vec<2>& x) const {
    if (curvature == 0) return x[0];
    return std::atan2(curvature * x[0], 1 + curvature * x[1]) / curvature;
  }
};

/// Profiles on a wall up to the height `top`.
template <int D>
class Profile {
 public:
  Profile(Real curvature_of_wall, Real bond, Real top)
      : wall_{curvature_of_wall}, bond_(bond), top_(top), step_(top / 40) {}

  /// The profile with these numbers, up to `top` or the axis, and its displacements that vary with
  /// the direction phi as cos(m phi).
  FittedCurve trace(const ProfileNumbers& numbers, int m = 0) const {
    constexpr int most = 200;
    FittedCurve curve;
    const Vec<2> begin = wall_.place(numbers[0]);
    State at;
    at << begin, std::numbers::pi - numbers[1] - wall_.curvature * numbers[0], 1, 0, 0, 1, 0, 0;
    for (int k = 0; k < most; ++k) {
      const Vec<2> place = at.template head<2>();
      curve.points.push_back(
          {place, at[2], curvature(at, numbers[2]), {at[3], at[5], at[7]}, {at[4], at[6], at[8]}});
      if (!(place[0] > step_) || !(wall_.height(place) < 1.2 * top_)) break;
      advance(at, numbers[2], m);
    }
    return curve;
  }

  /// The change of the contact angle by the displacements of a curve.
  Vec<3> change_of_angle(const FittedCurve& curve) const {
    const FittedCurve::Point& line = curve.points.front();
    const Real c = std::cos(line.angle), s = std::sin(line.angle),
               of_wall = -wall_.curvature * wall_.arc(line.place);
    const Vec<2> out(std::cos(of_wall), std::sin(of_wall)), up(-out[1], out[0]);
    const Vec<2> tangent(c, s), normal(s, -c);
    // A displacement by 1 along the normal moves the end of the curve by this arc.
    const Real arc = -normal.dot(up) / tangent.dot(up);
    const Real along_wall = arc * tangent.dot(out) + normal.dot(out);
    return line.slope - (line.curvature * arc + wall_.curvature * along_wall) * line.displacement;
  }

  /// Numbers of the circle a |y|^2 + b.y + c = 0 that fits points best, by least squares of the
  /// left side over its gradient (Taubin 1991), which finds almost straight lines, too.
  ProfileNumbers of_circle(const std::vector<Vec<2>>& x, const std::vector<Real>& area) const {
    Vec<2> mean = Vec<2>::Zero();
    Real total = 0, square = 0;
    for (std::size_t q = 0; q < x.size(); ++q) {
      mean += area[q] * x[q];
      total += area[q];
    }
    mean /= total;
    for (std::size_t q = 0; q < x.size(); ++q)
      square += area[q] * (x[q] - mean).squaredNorm() / total;
    const Real size = 2 * std::sqrt(square);
    Mat<3> moments = Mat<3>::Zero();
    for (std::size_t q = 0; q < x.size(); ++q) {
      const Vec<2> y = x[q] - mean;
      const Vec<3> row((y.squaredNorm() - square) / size, y[0], y[1]);
      moments += area[q] * row * row.transpose();
    }
    const Vec<3> best = symmetric_axes<3>(moments).axes.col(0);
    const Real a = std::copysign(std::max(std::abs(best[0]), 1e-6) / size, best[0]);
    const Vec<2> b = best.tail<2>(), to_centre = -b / (2 * a);
    return end_on_wall(mean + to_centre, std::sqrt(to_centre.squaredNorm() + square),
                       -to_centre.normalized());
  }

 private:
  /// Place, angle, and the displacements with their slopes.
  using State = Eigen::Matrix<Real, 9, 1>;

  Real curvature_of_parallel(const State& at) const {
    return D == 3 ? std::sin(at[2]) / std::max(at[0], step_ / 2) : 0;
  }
  Real curvature(const State& at, Real p) const {
    return p - bond_ * at[1] - curvature_of_parallel(at);
  }
  /// A displacement n along the normal does not change the sum of the curvatures at a place if
  /// n'' + n' cos(angle)/r = (m^2/r^2 - the squares of both curvatures - bond cos(angle)) n.
  State rate(const State& at, Real p, int m) const {
    const Real c = std::cos(at[2]), bend = curvature(at, p), other = curvature_of_parallel(at),
               r = std::max(at[0], step_ / 2), spread = D == 3 ? c / r : 0,
               factor = (D == 3 ? m * m / (r * r) : 0) - bend * bend - other * other - bond_ * c;
    State rate;
    rate << c, std::sin(at[2]), bend, at[4], factor * at[3] - spread * at[4], at[6],
        factor * at[5] - spread * at[6], at[8], factor * at[7] - spread * at[8] - at[0];
    return rate;
  }
  /// A step along the curve, by Runge and Kutta's rule of order 4.
  void advance(State& at, Real p, int m) const {
    const State a = rate(at, p, m), b = rate(at + step_ / 2 * a, p, m),
                c = rate(at + step_ / 2 * b, p, m), d = rate(at + step_ * c, p, m);
    at += step_ / 6 * (a + 2 * b + 2 * c + d);
  }
  /// Follows a circle from the direction n from its centre down to the wall.
  ProfileNumbers end_on_wall(const Vec<2>& centre, Real R, Vec<2> n) const {
    constexpr int parts = 2000;
    const Real turn = std::min(2 * std::numbers::pi / parts, top_ / (200 * R));
    const Vec<2> left(-n[1], n[0]), start = centre + R * n;
    const Real sign =
        wall_.height(start + R * turn * left) < wall_.height(start - R * turn * left) ? 1 : -1;
    const Real c = std::cos(turn), s = sign * std::sin(turn);
    const Real upward =
        -sign * n[0];  // z component of the tangent at the start, away from the wall
    Vec<2> x = start;
    for (int k = 0; k < parts && wall_.height(x) > 0; ++k) {
      n = Vec<2>(c * n[0] - s * n[1], s * n[0] + c * n[1]);
      x = centre + R * n;
    }
    const Vec<2> up = -sign * Vec<2>(-n[1], n[0]), outward(up[1], -up[0]);
    const Real arc = wall_.arc(x);
    const Real angle = std::numbers::pi - std::atan2(up[1], up[0]) - wall_.curvature * arc;
    return {arc, std::clamp(angle, 0.02, std::numbers::pi - 0.02),
            n.dot(outward) / R + (D == 3 ? upward / start[0] : 0) + bond_ * start[1]};
  }

  WallCurve wall_;
  Real bond_, top_, step_;
};

/// Points in the half plane of the axis, and functions of their direction phi from it: cos(m phi)
/// and sin(m phi) for m = 1, 2; in 2D, 1 on one side and -1 on the other.
template <int D>
struct Around {
  std::vector<Vec<2>> x;
  std::vector<std::array<Real, (D - 1) * (D - 1)>> mode;

  Around(const std::vector<Vec<D>>& points, const WallFrame<D>& wall, const Vec<D>& along) {
    for (const Vec<D>& point : points) {
      const Vec<D> y = point - wall.point;
      const Real z = y.dot(wall.normal);
      const Vec<D> out = y - z * wall.normal;
      const Real r = out.norm(), c = r > 0 ? out.dot(along) / r : 1;
      x.push_back({r, z});
      if constexpr (D == 3) {
        const Real s = r > 0 ? out.dot(cross(wall.normal, along)) / r : 0;
        mode.push_back({c, s, c * c - s * s, 2 * s * c});
      } else {
        mode.push_back({c > 0 ? 1.0 : -1.0});
      }
    }
  }
};

/// Distances of points from a profile, and their derivatives with respect to its numbers.
struct CurveDistances {
  std::vector<Real> value;
  std::vector<ProfileNumbers> rate;
};

template <int D>
CurveDistances distances(const Profile<D>& profile, const ProfileNumbers& numbers,
                         const ProfileNumbers& scale, const std::vector<Vec<2>>& x) {
  constexpr Real increment = 1e-5;
  CurveDistances all;
  const FittedCurve here = profile.trace(numbers);
  for (const Vec<2>& point : x) all.value.push_back(here.foot(point).distance);
  all.rate.resize(x.size());
  for (int j = 0; j < 3; ++j) {
    ProfileNumbers moved = numbers;
    moved[j] += increment * scale[j];
    const FittedCurve there = profile.trace(moved);
    for (std::size_t q = 0; q < x.size(); ++q)
      all.rate[q][j] = (there.foot(x[q]).distance - all.value[q]) / (increment * scale[j]);
  }
  return all;
}

/// The profile of revolution nearest to the points, by the method of Gauss and Newton. Steps are
/// halved until the distances become smaller.
template <int D>
ProfileNumbers nearest_profile(const Profile<D>& profile, const ProfileNumbers& scale,
                               const std::vector<Vec<2>>& x, const std::vector<Real>& area) {
  constexpr int most = 20, halvings = 8;
  const auto squares = [&](const ProfileNumbers& numbers) {
    const FittedCurve curve = profile.trace(numbers);
    Real sum = 0;
    for (std::size_t q = 0; q < x.size(); ++q) {
      const Real distance = curve.foot(x[q]).distance;
      sum += area[q] * distance * distance;
    }
    return sum;
  };
  ProfileNumbers numbers = profile.of_circle(x, area);
  Real least = squares(numbers);
  for (int iteration = 0; iteration < most; ++iteration) {
    const CurveDistances d = distances(profile, numbers, scale, x);
    Mat<3> normal = Mat<3>::Zero();
    Vec<3> right = Vec<3>::Zero();
    for (std::size_t q = 0; q < x.size(); ++q) {
      normal += area[q] * d.rate[q] * d.rate[q].transpose();
      right -= area[q] * d.value[q] * d.rate[q];
    }
    const Vec<3> change = solve_symmetric(normal, right);
    Real share = 1, now = squares(numbers + change);
    for (int halving = 0; halving < halvings && !(now < least); ++halving) {
      share /= 2;
      now = squares(numbers + share * change);
    }
    if (!(now < least)) break;
    numbers += share * change;
    least = now;
    if (std::abs(change[1]) < 1e-8) break;
  }
  return numbers;
}

}  // namespace

template <int D>
LineAngles fit_profile(const std::vector<Vec<D>>& x, const std::vector<Real>& area,
                       const WallFrame<D>& wall, Real bond, const Vec<D>& along) {
  constexpr int of_order = D - 1;  // number of functions of the direction of each order
  constexpr std::array<int, 3> solutions{0, 3, 2};
  constexpr int orders = D - 1, unknowns = D == 3 ? 3 + 2 * (3 + 2) : 3 + 3;
  const Around<D> around(x, wall, along);
  Real low = std::numeric_limits<Real>::max(), top = 0;
  for (const Vec<2>& point : around.x) {
    low = std::min(low, WallCurve{wall.curvature}.height(point));
    top = std::max(top, WallCurve{wall.curvature}.height(point));
  }
  const Profile<D> profile(wall.curvature, bond, top);
  const ProfileNumbers scale(top, 1, 1 / top),
      numbers = nearest_profile(profile, scale, around.x, area);

  // Linear least squares for changes around the axis, and the last change of the profile itself.
  const CurveDistances d = distances(profile, numbers, scale, around.x);
  std::array<FittedCurve, 3> curve;
  for (int m = 1; m <= orders; ++m) at(curve, m) = profile.trace(numbers, m);
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(unknowns, unknowns);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(unknowns), row(unknowns);
  Real total = 0, squares = 0;
  for (std::size_t q = 0; q < x.size(); ++q) {
    row.head<3>() = d.rate[q];
    int column = 3;
    for (int m = 1, mode = 0; m <= orders; ++m) {
      const Vec<3> displacement = at(curve, m).foot(around.x[q]).displacement;
      for (int k = 0; k < of_order; ++k, ++mode)
        for (int i = 0; i < at(solutions, m); ++i)
          row[column++] = -at(around.mode[q], mode) * displacement[i];
    }
    normal += area[q] * row * row.transpose();
    right -= area[q] * d.value[q] * row;
    total += area[q];
    squares += area[q] * d.value[q] * d.value[q];
  }
  const Eigen::VectorXd solution = solve_symmetric(normal, right);
  // Changes by the first function of an order, which is 1 in front.
  const auto change = [&](int m, int column) {
    const Vec<3> of_angle = profile.change_of_angle(at(curve, m));
    Real sum = 0;
    for (int i = 0; i < at(solutions, m); ++i) sum += of_angle[i] * solution[column + i];
    return sum;
  };
  const Real mean = numbers[1] + solution[1], odd = change(1, 3), even = D == 3 ? change(2, 9) : 0;
  squares = std::max(0.0, squares - right.dot(solution));
  return {mean, mean + even + odd, mean + even - odd, std::sqrt(squares / total) / (top - low)};
}

template LineAngles fit_profile(const std::vector<Vec<2>>&, const std::vector<Real>&,
                                const WallFrame<2>&, Real, const Vec<2>&);
template LineAngles fit_profile(const std::vector<Vec<3>>&, const std::vector<Real>&,
                                const WallFrame<3>&, Real, const Vec<3>&);

}  // namespace meniscus
