// SPDX-License-Identifier: BSD-3-Clause
// Affine maps, composition, and the maps of the curvature studies.
#include "body/shapes/smooth_map.hpp"

namespace meniscus {

namespace {

using Position = std::array<Jet<3>, 3>;

/// Rotates every plane normal to `axis` about it, by `rate` times the coordinate along the axis.
Position twist(Position x, std::size_t axis, Real rate) {
  const std::size_t i = axis == 0 ? 1 : 0, j = axis == 2 ? 1 : 2;
  const Jet<3> angle = rate * x[axis], c = cos(angle), s = sin(angle), xi = x[i], xj = x[j];
  x[i] = c * xi - s * xj;
  x[j] = s * xi + c * xj;
  return x;
}

}  // namespace

template <int D>
SmoothMap<D> affine_map(const Mat<D>& A, const Vec<D>& centre) {
  return [A, centre](const Vec<D>& X) {
    MapPoint<D> point{centre + A * X, A, {}};
    point.G.fill(Mat<D>::Zero());
    return point;
  };
}

template <int D>
SmoothMap<D> compose(SmoothMap<D> outer, SmoothMap<D> inner) {
  return [outer = std::move(outer), inner = std::move(inner)](const Vec<D>& X) {
    const MapPoint<D> f = inner(X), g = outer(f.x);
    MapPoint<D> point{g.x, g.F * f.F, {}};
    for (int i = 0; i < D; ++i) {
      Mat<D>& G = at(point.G, i);
      G = f.F.transpose() * at(g.G, i) * f.F;
      for (int j = 0; j < D; ++j) G += g.F(i, j) * at(f.G, j);
    }
    return point;
  };
}

SmoothMap<3> twist_ellipsoid() {
  return smooth_map<3>([](const Position& X) {
    Position x = twist(twist(X, 1, 0.7), 2, -0.6);
    x[1] = 1.5 * x[1];
    return x;
  });
}

SmoothMap<3> biconcave() {
  return smooth_map<3>([](const Position& X) {
    const Jet<3> r2 = X[0] * X[0] + X[1] * X[1];
    const Jet<3> thickness = 0.207161 + r2 * (2.002558 - 1.122762 * r2);
    return Position{X[0], X[1], 0.5 * X[2] * thickness};
  });
}

template SmoothMap<2> affine_map(const Mat<2>&, const Vec<2>&);
template SmoothMap<3> affine_map(const Mat<3>&, const Vec<3>&);
template SmoothMap<2> compose(SmoothMap<2>, SmoothMap<2>);
template SmoothMap<3> compose(SmoothMap<3>, SmoothMap<3>);

}  // namespace meniscus
