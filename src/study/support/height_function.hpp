// SPDX-License-Identifier: BSD-3-Clause
// Published curvature errors of height functions on Cartesian grids, for comparison: circles and
// spheres at random places, test cases of the Basilisk solver (curvature*.ref).
#pragma once
#include "numbers/types.hpp"

#include <array>
#include <cmath>
#include <optional>

namespace meniscus::study {

struct HeightFunctionError {
  Real diameter;        ///< diameter in cells
  Real mean, rms, max;  ///< relative errors of the curvature
};

template <int D>
inline constexpr std::array<HeightFunctionError, 5> height_function_errors{
    {{6.4, 1.16e-1, 1.22e-1, 2.38e-1},
     {12.8, 3.47e-2, 4.38e-2, 1.92e-1},
     {25.6, 6.23e-3, 7.96e-3, 9.81e-2},
     {51.2, 1.43e-3, 1.49e-3, 2.43e-3},
     {88.5, 4.74e-4, 4.93e-4, 7.95e-4}}};
template <>
inline constexpr std::array<HeightFunctionError, 5> height_function_errors<2>{
    {{6.4, 4.27e-2, 4.54e-2, 1.25e-1},
     {12.8, 1.30e-2, 1.38e-2, 4.20e-2},
     {25.6, 3.03e-3, 3.11e-3, 5.38e-3},
     {51.2, 7.44e-4, 7.62e-4, 1.22e-3},
     {88.5, 2.49e-4, 2.54e-4, 3.96e-4}}};

/// Interpolates the table by powers of the diameter; empty outside of the table.
template <int D>
std::optional<HeightFunctionError> height_function_error(Real diameter) {
  const auto& table = height_function_errors<D>;
  for (std::size_t i = 0; i + 1 < table.size(); ++i) {
    const auto &a = table[i], &b = table[i + 1];
    if (diameter < a.diameter || diameter > b.diameter) continue;
    const Real s = std::log(diameter / a.diameter) / std::log(b.diameter / a.diameter);
    const auto power = [s](Real x, Real y) { return x * std::pow(y / x, s); };
    return HeightFunctionError{diameter, power(a.mean, b.mean), power(a.rms, b.rms),
                               power(a.max, b.max)};
  }
  return {};
}

}  // namespace meniscus::study
