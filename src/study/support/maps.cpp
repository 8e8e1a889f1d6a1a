// SPDX-License-Identifier: BSD-3-Clause
// The maps of the curvature studies, and the check that a map does not fold.
#include "study/support/maps.hpp"

#include "meniscus/error.hpp"
#include "numbers/dense.hpp"

#include <fmt/core.h>

namespace meniscus::study {
namespace {

template <int D>
using Position = std::array<Jet<D>, D>;

/// Rotates (x_i, x_j) by an angle that varies with the position; x_i^2 + x_j^2 does not change.
template <int D>
void turn(Position<D>& x, std::size_t i, std::size_t j, const Jet<D>& angle) {
  const Jet<D> c = cos(angle), s = sin(angle), xi = x[i], xj = x[j];
  x[i] = c * xi - s * xj;
  x[j] = s * xi + c * xj;
}

/// Bends the x axis to a circle of radius 2 about the point -2 of the last coordinate axis.
template <int D>
Position<D> bend(Position<D> x) {
  const Jet<D> angle = 0.5 * x[0], radius = 2.0 + x[D - 1];
  x[0] = radius * sin(angle);
  x[D - 1] = radius * cos(angle) - 2.0;
  return x;
}

/// Waves without symmetry: each coordinate moves with the next one.
template <int D>
Position<D> wave(const Position<D>& X) {
  Position<D> x = X;
  for (std::size_t i = 0; i < D; ++i)
    x[i] = X[i] + 0.12 * sin(2.0 * X[(i + 1) % D] + static_cast<Real>(i) + 0.3 * X[i]);
  return x;
}

Position<2> thin(const Position<2>& X) {
  const Jet<2> r2 = X[0] * X[0];
  return {X[0], 0.5 * X[1] * (0.207161 + r2 * (2.002558 - 1.122762 * r2))};
}

/// Rotation by an angle that grows with r^2, at the rim by 0.7 per unit length. It maps the circle
/// onto itself.
SmoothMap<2> swirl(Real part) {
  return smooth_map<2>([=](Position<2> x) {
    turn<2>(x, 0, 1, 0.35 * part * (x[0] * x[0] + x[1] * x[1]));
    return x;
  });
}

/// The twists of twist_ellipsoid(), which map the sphere onto itself.
SmoothMap<3> twist(Real part) {
  return smooth_map<3>([=](Position<3> x) {
    turn<3>(x, 0, 2, 0.7 * part * x[1]);
    turn<3>(x, 0, 1, -0.6 * part * x[2]);
    return x;
  });
}

/// A path of one map `turn_by(part of the whole angle)` per stage, one after the other, followed by
/// the stretch of y, which reaches `stretch` at the end.
template <int D>
typename NamedMap<D>::Path turning_path(SmoothMap<D> (*turn_by)(Real), Real stretch) {
  return [=](int stage, int stages) {
    Vec<D> axes = Vec<D>::Ones();
    axes[1] = std::pow(stretch, static_cast<Real>(stage) / stages);
    const SmoothMap<D> part = turn_by(1.0 / stages);
    SmoothMap<D> map = part;
    for (int j = 1; j < stage; ++j) map = compose<D>(part, map);
    return compose<D>(affine_map<D>(axes.asDiagonal(), Vec<D>::Zero()), map);
  };
}

}  // namespace

template <>
const std::vector<NamedMap<3>>& named_maps() {
  static const std::vector<NamedMap<3>> maps{{"twist_ellipsoid", turning_path<3>(twist, 1.5)},
                                             {"biconcave", straight_path(biconcave())},
                                             {"twist", turning_path<3>(twist, 1)},
                                             {"bent", straight_path(smooth_map<3>(bend<3>))},
                                             {"wavy", straight_path(smooth_map<3>(wave<3>))}};
  return maps;
}

template <>
const std::vector<NamedMap<2>>& named_maps() {
  static const std::vector<NamedMap<2>> maps{{"swirl_ellipse", turning_path<2>(swirl, 1.5)},
                                             {"biconcave_2d", straight_path(smooth_map<2>(thin))},
                                             {"swirl", turning_path<2>(swirl, 1)},
                                             {"bent_2d", straight_path(smooth_map<2>(bend<2>))},
                                             {"wavy_2d", straight_path(smooth_map<2>(wave<2>))}};
  return maps;
}

template <int D>
typename NamedMap<D>::Path straight_path(SmoothMap<D> map) {
  return [map = std::move(map)](int stage, int stages) -> SmoothMap<D> {
    const Real s = static_cast<Real>(stage) / stages;
    return [map, s](const Vec<D>& X) {
      MapPoint<D> point = map(X);
      point.x = (1 - s) * X + s * point.x;
      point.F = (1 - s) * Mat<D>::Identity() + s * point.F;
      for (Mat<D>& G : point.G) G *= s;
      return point;
    };
  };
}

template <int D>
void require_no_fold(const NamedMap<D>& map, std::span<const Vec<D>> places) {
  for (const Vec<D>& X : places) {
    const Real J = determinant<D>(map.map(X).F);
    if (J > 0) continue;
    std::string place = fmt::format("{:.4g}", X[0]);
    for (int i = 1; i < D; ++i) place += fmt::format(", {:.4g}", X[i]);
    throw InputError(fmt::format(
        "the map '{}' folds the body: det F = {:.4g} at X = ({}); a map must keep det F > 0 on the "
        "whole unit {}; make its displacements smaller or exchange two of its components",
        map.name, J, place, D == 3 ? "ball" : "disk"));
  }
}

template NamedMap<2>::Path straight_path(SmoothMap<2>);
template NamedMap<3>::Path straight_path(SmoothMap<3>);
template void require_no_fold(const NamedMap<2>&, std::span<const Vec<2>>);
template void require_no_fold(const NamedMap<3>&, std::span<const Vec<3>>);

}  // namespace meniscus::study
