// SPDX-License-Identifier: BSD-3-Clause
// Bulges of cells at a curved surface: quadratic deviations of edges and sides from the multilinear
// map.
#pragma once
#include "numbers/types.hpp"

#include <array>

namespace meniscus {

/// The mode of one edge or (3D) side of the reference cell. It is the product of bubbles 1 - xi_k^2
/// in the directions of the bits of `along`, and of (1 +- xi_k) / 2 in the others, with + for the
/// bits of `upper`. It is 1 in the middle of that edge or side, and 0 on all edges and sides that
/// do not contain it.
struct BulgeMode {
  unsigned along, upper;
};

template <int D>
constexpr auto bulge_modes() {
  std::array<BulgeMode, D == 2 ? 4 : 18> modes{};
  std::size_t count = 0;
  for (unsigned along = 1; along + 1 < (1u << D); ++along)
    for (unsigned upper = 0; upper < (1u << D); ++upper)
      if ((along & upper) == 0) modes[count++] = {along, upper};
  return modes;
}

/// X(xi) = multilinear map + sum over the modes of deviation * mode(xi). Neighbouring cells have
/// the same deviation on a common edge or side, so the grid stays conforming.
template <int D>
struct Bulge {
  static constexpr auto modes = bulge_modes<D>();  ///< one per edge and (3D) side
  static constexpr int mode_count = static_cast<int>(modes.size());

  Eigen::Matrix<Real, D, mode_count> deviation = Eigen::Matrix<Real, D, mode_count>::Zero();
  unsigned curved = 0;  ///< bit k: the map is quadratic in xi_k, otherwise linear

  /// Adds to the deviation of modes[mode].
  void add(int mode, const Vec<D>& amount) {
    deviation.col(mode) += amount;
    curved |= at(modes, mode).along;
  }
};

/// Values of the modes and their derivatives with respect to xi.
template <int D>
struct BulgeFunctions {
  Eigen::Matrix<Real, Bulge<D>::mode_count, 1> N;
  Eigen::Matrix<Real, Bulge<D>::mode_count, D> dN;

  explicit BulgeFunctions(const Vec<D>& xi) {
    for (int m = 0; m < Bulge<D>::mode_count; ++m) {
      const BulgeMode mode = at(Bulge<D>::modes, m);
      N[m] = 1;
      dN.row(m).setOnes();
      for (int k = 0; k < D; ++k) {
        const bool bubble = (mode.along >> k) & 1;
        const Real slope_of_end = (mode.upper >> k) & 1 ? 0.5 : -0.5;
        const Real value = bubble ? 1 - xi[k] * xi[k] : 0.5 + slope_of_end * xi[k];
        const Real slope = bubble ? -2 * xi[k] : slope_of_end;
        N[m] *= value;
        for (int l = 0; l < D; ++l) dN(m, l) *= l == k ? slope : value;
      }
    }
  }
};

}  // namespace meniscus
