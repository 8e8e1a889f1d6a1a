// SPDX-License-Identifier: BSD-3-Clause
// Numbers, indices and small vectors of the whole program.
#pragma once
#include <Eigen/Core>
#include <concepts>
#include <cstddef>
#include <cstdint>

namespace meniscus {

using Real = double;
using Index = std::int32_t;   ///< particle, point, cell number
using Offset = std::int64_t;  ///< position inside a compressed-row value array

/// The space dimensions that a scene can have.
template <int D>
concept SpaceDim = (D == 2 || D == 3);

/// A point or a vector in D dimensions.
template <int D>
using Vec = Eigen::Matrix<Real, D, 1>;

/// A tensor of second order in D dimensions.
template <int D>
using Mat = Eigen::Matrix<Real, D, D>;

/// X as a vector in 3D; in 2D z = 0.
template <int D>
Eigen::Vector3d spatial(const Vec<D>& X) {
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  x.template head<D>() = X;
  return x;
}

/// A finite number larger than any number of a scene. It means "no bound", or starts the search for
/// a minimum.
inline constexpr Real unbounded = 1e300;

/// Array element access without sign-conversion noise: at(v, i) is v[i].
template <class Container>
decltype(auto) at(Container&& c, std::integral auto i) {
  return c[static_cast<std::size_t>(i)];
}

}  // namespace meniscus
