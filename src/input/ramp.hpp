// SPDX-License-Identifier: BSD-3-Clause
// Ramps: loads and material numbers switched on smoothly over a span of time, then constant.
#pragma once
#include "input/input.hpp"

#include <algorithm>

namespace meniscus {

/// The fraction x^2 (3 - 2 x) of a change, with x = (t - begin)/(end - begin) limited to [0, 1]. By
/// default the fraction is 1 at all times.
struct Ramp {
  Real begin = 0, end = 0;

  Real fraction(Real time) const {
    const Real x = progress(time);
    return x * x * (3 - 2 * x);
  }
  /// Time derivative of fraction().
  Real rate(Real time) const {
    const Real x = progress(time);
    return end > begin ? 6 * x * (1 - x) / (end - begin) : 0;
  }

 private:
  Real progress(Real time) const {
    return end > begin ? std::clamp((time - begin) / (end - begin), 0.0, 1.0) : 1;
  }
};

/// The row of `key = [begin, end]`. If it is left out, the fraction is 1 from the start. `what`
/// names the quantity that changes, for the documentation.
template <class M>
Row<M> ramp_row(std::string key, Ramp M::*member, const std::string& what) {
  Row<M> row = reals_row<M>(
      std::move(key), nullptr, 2, dimension::time, range::non_negative,
      "[begin, end] of the smooth change of " + what + "; [0, 0]: changed from the start",
      std::vector<Real>{0, 0});
  row.read = [key = row.key, member](M& m, const Block& block) {
    const std::vector<Real> span =
        block.reals(key, 2, dimension::time, range::non_negative, std::vector<Real>{0, 0});
    m.*member = {span[0], span[1]};
    if (!block.in_order()) return;  // numbers out of range are already reported
    if (span[0] > span[1] || (span[0] == span[1] && span[0] > 0))
      block.problem(key,
                    "the ramp ends before it begins, or at once; allowed is begin < end, or "
                    "[0, 0]");
  };
  return row;
}

}  // namespace meniscus
