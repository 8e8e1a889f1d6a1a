// SPDX-License-Identifier: BSD-3-Clause
// Smooth maps with exact first and second derivatives. They map unit shapes to bodies and are the
// exact solutions of curvature tests.
#pragma once
#include "numbers/jet.hpp"

#include <array>
#include <functional>
#include <utility>

namespace meniscus {

/// x(X), F(i, K) = x_i,K and G[i](K, L) = x_i,KL at one point.
template <int D>
struct MapPoint {
  Vec<D> x;
  Mat<D> F;
  std::array<Mat<D>, D> G;
};

/// A map with its derivatives as a function of X.
template <int D>
using SmoothMap = std::function<MapPoint<D>(const Vec<D>& X)>;

/// x = centre + A X.
template <int D>
SmoothMap<D> affine_map(const Mat<D>& A, const Vec<D>& centre);

/// x = outer(inner(X)).
template <int D>
SmoothMap<D> compose(SmoothMap<D> outer, SmoothMap<D> inner);

/// Twist by 0.7 rad per unit length about y, then by -0.6 about z, then stretch of y by 1.5. This
/// non-affine map takes the unit sphere to an exact 1 : 1.5 : 1 ellipsoid (RKPM note 3.1).
SmoothMap<3> twist_ellipsoid();

/// (X1, X2, X3 (0.207161 + 2.002558 r^2 - 1.122762 r^4) / 2) with r^2 = X1^2 + X2^2. This map takes
/// the unit sphere to the resting shape of a red blood cell (RKPM note 3.1).
SmoothMap<3> biconcave();

/// The map given by a formula f, which takes and returns std::array<Jet<D>, D>.
template <int D, class Formula>
SmoothMap<D> smooth_map(Formula formula) {
  return [f = std::move(formula)](const Vec<D>& X) {
    const auto coordinates = [&]<std::size_t... k>(std::index_sequence<k...>) {
      return std::array<Jet<D>, D>{Jet<D>::variable(X, static_cast<int>(k))...};
    };
    const std::array<Jet<D>, D> x = f(coordinates(std::make_index_sequence<D>{}));
    MapPoint<D> point;
    for (int i = 0; i < D; ++i) {
      point.x[i] = at(x, i).value;
      point.F.row(i) = at(x, i).gradient.transpose();
      at(point.G, i) = at(x, i).hessian;
    }
    return point;
  };
}

}  // namespace meniscus
