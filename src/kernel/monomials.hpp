// SPDX-License-Identifier: BSD-3-Clause
// Numbering of the monomials of D variables up to a degree, at compile time.
#pragma once
#include "numbers/types.hpp"

#include <array>

namespace meniscus {

/// Number of monomials of D variables up to `degree`.
constexpr int monomial_count(int D, int degree) {
  int n = 1;
  for (int k = 1; k <= D; ++k) n = n * (degree + k) / k;
  return n;
}

/// Number of entries of a symmetric second derivative.
constexpr int hessian_count(int D) {
  return D * (D + 1) / 2;
}

/// Position of d2/dx_i dx_j in a packed second derivative: xx, xy, (xz,) yy, (yz, zz).
constexpr int hessian_index(int D, int i, int j) {
  const int a = i < j ? i : j, b = i < j ? j : i;
  return a * D - a * (a - 1) / 2 + b - a;
}

/// The monomials sorted by degree, 1; x, y, z; xx, xy, xz, yy, yz, zz; ... Monomial n is the
/// earlier monomial factor[n] times the variable number variable[n].
template <int D, int Degree>
struct Monomials {
  static constexpr int size = monomial_count(D, Degree);
  std::array<std::array<int, D>, size> exponent{};
  std::array<int, size> factor{}, variable{};

  constexpr Monomials() {
    int n = 1, previous = 0;
    for (int degree = 1; degree <= Degree; ++degree) {
      const int end = n;
      // Multiply every monomial of the degree below by its last variable or a later one.
      for (int m = previous; m < end; ++m) {
        int last = 0;
        for (int i = 0; i < D; ++i)
          if (exponent[static_cast<std::size_t>(m)][static_cast<std::size_t>(i)] > 0) last = i;
        for (int i = m == 0 ? 0 : last; i < D; ++i) {
          const auto k = static_cast<std::size_t>(n++);
          exponent[k] = exponent[static_cast<std::size_t>(m)];
          ++exponent[k][static_cast<std::size_t>(i)];
          factor[k] = m;
          variable[k] = i;
        }
      }
      previous = end;
    }
  }

  /// The first monomial k with factor[k] = n, or 0. All monomials with this factor follow each
  /// other.
  constexpr int first_multiple(int n) const {
    for (int k = 1; k < size; ++k)
      if (factor[static_cast<std::size_t>(k)] == n) return k;
    return 0;
  }

  /// Number of the monomial with these exponents; -1 if there is none.
  constexpr int find(const std::array<int, D>& e) const {
    for (int k = 0; k < size; ++k)
      if (exponent[static_cast<std::size_t>(k)] == e) return k;
    return -1;
  }
};

/// multiple[a][i]: number, among the monomials up to Degree + 1, of a times variable i.
template <int D, int Degree>
constexpr auto monomial_multiples() {
  constexpr Monomials<D, Degree> basis;
  constexpr Monomials<D, Degree + 1> above;
  std::array<std::array<int, D>, static_cast<std::size_t>(basis.size)> multiple{};
  for (std::size_t a = 0; a < multiple.size(); ++a)
    for (std::size_t i = 0; i < static_cast<std::size_t>(D); ++i) {
      std::array<int, D> e = basis.exponent[a];
      ++e[i];
      multiple[a][i] = above.find(e);
    }
  return multiple;
}

/// product[a][b]: number, among the monomials up to 2 Degree, of the product of a and b.
template <int D, int Degree>
constexpr auto monomial_products() {
  constexpr Monomials<D, Degree> basis;
  constexpr Monomials<D, 2 * Degree> moments;
  constexpr auto n = static_cast<std::size_t>(basis.size);
  std::array<std::array<int, n>, n> product{};
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < n; ++b) {
      std::array<int, D> e{};
      for (std::size_t i = 0; i < static_cast<std::size_t>(D); ++i)
        e[i] = basis.exponent[a][i] + basis.exponent[b][i];
      product[a][b] = moments.find(e);
    }
  return product;
}

}  // namespace meniscus
