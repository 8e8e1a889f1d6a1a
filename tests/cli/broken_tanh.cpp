// SPDX-License-Identifier: BSD-3-Clause
// A hyperbolic tangent that is no number from 0.03 on, to be loaded before that of the system: the
// formulas of one rank fail, those of the others do not.
#include <limits>

extern "C" double tanh(double x) noexcept {
  return x > 0.03 ? std::numeric_limits<double>::quiet_NaN() : x;
}
