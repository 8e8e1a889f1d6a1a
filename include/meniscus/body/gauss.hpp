// SPDX-License-Identifier: BSD-3-Clause
// Gauss-Legendre rules on [-1, 1] and their tensor products.
#pragma once
#include "meniscus/core/types.hpp"

#include <vector>

namespace meniscus {

struct GaussRule {
  std::vector<Real> x, w;  ///< ascending points, weights that sum to 2
};

/// k points, exact for polynomials of degree 2 k - 1; 1 <= k <= 20, else InputError.
GaussRule gauss_rule(int k);

/// A rule on [-1, 1]^P; the first coordinate varies fastest.
template <int P>
struct TensorRule {
  std::vector<Vec<P>> x;
  std::vector<Real> w;
};

template <int P>
TensorRule<P> tensor_rule(int k) {
  const GaussRule line = gauss_rule(k);
  int count = 1;
  for (int d = 0; d < P; ++d) count *= k;
  TensorRule<P> rule;
  for (int q = 0; q < count; ++q) {
    Vec<P> x;
    Real w = 1;
    for (int d = 0, rest = q; d < P; ++d, rest /= k) {
      x[d] = at(line.x, rest % k);
      w *= at(line.w, rest % k);
    }
    rule.x.push_back(x);
    rule.w.push_back(w);
  }
  return rule;
}

}  // namespace meniscus
