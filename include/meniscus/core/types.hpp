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

template <int D>
concept SpaceDim = (D == 2 || D == 3);

template <int D>
using Vec = Eigen::Matrix<Real, D, 1>;
template <int D>
using Mat = Eigen::Matrix<Real, D, D>;

/// Array element access without sign-conversion noise: at(v, i) is v[i].
template <class Container>
decltype(auto) at(Container&& c, std::integral auto i) {
  return c[static_cast<std::size_t>(i)];
}

}  // namespace meniscus
