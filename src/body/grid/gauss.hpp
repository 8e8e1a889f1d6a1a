// SPDX-License-Identifier: BSD-3-Clause
// Gauss-Legendre rules on [-1, 1] and their tensor products.
#pragma once
#include "numbers/types.hpp"

#include <array>
#include <vector>

namespace meniscus {

/// A Gauss-Legendre rule.
struct GaussRule {
  std::vector<Real> x, w;  ///< ascending points, weights that sum to 2
};

/// The rule of k points, exact for polynomials of degree 2 k - 1. Throws InputError unless 1 <= k
/// <= 20.
const GaussRule& gauss_rule(int k);

/// A rule on [-1, 1]^P; the first coordinate varies fastest.
template <int P>
struct TensorRule {
  std::vector<Vec<P>> x;
  std::vector<Real> w;
};

/// The tensor product with k[d] points in direction d.
template <int P>
TensorRule<P> tensor_rule(const std::array<int, P>& k) {
  std::array<const GaussRule*, P> lines;
  int count = 1;
  for (int d = 0; d < P; ++d) {
    at(lines, d) = &gauss_rule(at(k, d));
    count *= at(k, d);
  }
  TensorRule<P> rule;
  for (int q = 0; q < count; ++q) {
    Vec<P> x;
    Real w = 1;
    for (int d = 0, rest = q; d < P; rest /= at(k, d++)) {
      x[d] = at(at(lines, d)->x, rest % at(k, d));
      w *= at(at(lines, d)->w, rest % at(k, d));
    }
    rule.x.push_back(x);
    rule.w.push_back(w);
  }
  return rule;
}

template <int P>
TensorRule<P> tensor_rule(int k) {
  std::array<int, P> each;
  each.fill(k);
  return tensor_rule<P>(each);
}

}  // namespace meniscus
