// SPDX-License-Identifier: BSD-3-Clause
// log(1 + x) for every scalar that materials are evaluated with.
#pragma once
#include <cmath>
#include <complex>

#include "meniscus/core/simd.hpp"

namespace meniscus {

inline Real log1p(Real x) { return std::log1p(x); }

inline std::complex<Real> log1p(std::complex<Real> x) {
  const Real a = x.real(), b = x.imag();
  return {Real(0.5) * std::log1p(2 * a + a * a + b * b), std::atan2(b, 1 + a)};
}

/// 2 atanh(x / (2 + x)) by its series, relative error < 4e-16 for -1/2 < x < 1; std::log1p outside.
inline Lanes log1p(Lanes x) {
  const Lanes z = x / (2.0 + x), y = z * z, y2 = y * y, y4 = y2 * y2, y8 = y4 * y4;
  const auto four = [&](int k) {
    return (1.0 / k + y * (1.0 / (k + 2))) + y2 * (1.0 / (k + 4) + y * (1.0 / (k + 6)));
  };
  const Lanes series = (four(1) + y4 * four(9)) + y8 * (four(17) + y4 * four(25));
  Lanes result = 2.0 * z * series;
  for (int lane = 0; lane < Lanes::width; ++lane)
    if (!(x[lane] > -0.5 && x[lane] < 1.0)) result.set(lane, std::log1p(x[lane]));
  return result;
}

}  // namespace meniscus
