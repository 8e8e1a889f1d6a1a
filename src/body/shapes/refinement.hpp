// SPDX-License-Identifier: BSD-3-Clause
// Finer and coarser cells of any shape, by one number.
#pragma once
#include "numbers/types.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace meniscus {

struct Wall;

/// A number of cells times k, rounded; a multiple of 2 stays one, as some shapes ask, and one
/// around a ring that is a multiple of 4, since its half may have to be even.
inline int refined(int cells, Real k, bool is_around = false) {
  const int multiple = is_around && cells % 4 == 0 ? 4 : cells % 2 == 0 ? 2 : 1;
  return std::max(multiple, multiple * static_cast<int>(std::lround(k * cells / multiple)));
}

/// Makes the cells of a shape k times as fine, by its members core, rings, layers, around, cells
/// and spacing. The layers of a Wall are its particles. A mesh has `halvings`: how often its edges
/// are halved. Returns false if k is not a power of two, 1 or more, and the shape is a mesh.
template <class S>
bool refine(S& shape, Real k) {
  const auto take = [&](int& cells) { cells = refined(cells, k); };
  if constexpr (requires { shape.core; }) take(shape.core);
  if constexpr (requires { shape.rings; }) take(shape.rings);
  if constexpr (requires { shape.around; }) shape.around = refined(shape.around, k, true);
  if constexpr (requires { shape.layers; }) {
    if constexpr (std::is_base_of_v<Wall, S>)
      shape.layers = std::max(3, static_cast<int>(std::lround(k * (shape.layers - 1))) + 1);
    else
      take(shape.layers);
  }
  if constexpr (requires { shape.cells; })
    for (Real& cells : shape.cells) cells = refined(static_cast<int>(cells), k);
  if constexpr (requires { shape.spacing; }) shape.spacing /= k;
  if constexpr (requires { shape.halvings; }) {
    shape.halvings = k < 1 ? 0 : std::ilogb(k);
    return std::ldexp(1, shape.halvings) == k;
  }
  return true;
}

}  // namespace meniscus
