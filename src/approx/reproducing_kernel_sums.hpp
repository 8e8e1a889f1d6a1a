// SPDX-License-Identifier: BSD-3-Clause
// Moment sums, their factorisation and the evaluation of shape functions, four points at a time.
// Included by one source file per degree of the basis: the unrolled sums take long to compile.
#pragma once
#include "meniscus/approx/reproducing_kernel.hpp"
#include "meniscus/core/unroll.hpp"

#include <algorithm>

namespace meniscus {
namespace {

template <std::size_t N>
Lanes dot(const std::array<Lanes, N>& a, const std::array<Lanes, N>& b) {
  Lanes even = a[0] * b[0], odd = a[1] * b[1];  // two chains hide the latency
  unroll<N / 2 - 1>([&](auto k) {
    even += a[2 * k + 2] * b[2 * k + 2];
    odd += a[2 * k + 3] * b[2 * k + 3];
  });
  if constexpr (N % 2 == 1) even += a[N - 1] * b[N - 1];
  return even + odd;
}

template <std::size_t N>
void add_scaled(std::array<Lanes, N>& sum, Lanes factor, const std::array<Lanes, N>& a) {
  unroll<N>([&](auto k) { sum[k] += factor * a[k]; });
}

template <int D, int Degree>
constexpr auto basis_length = static_cast<std::size_t>(monomial_count(D, Degree));

/// Value of all monomials up to Degree at s, times `start`.
template <int D, int Degree>
[[gnu::always_inline]] inline std::array<Lanes, basis_length<D, Degree>> monomials_at(
    const std::array<Lanes, D>& s, Lanes start) {
  std::array<Lanes, basis_length<D, Degree>> m;
  m[0] = start;
  unroll<m.size() - 1>([&](auto k) {
    constexpr Monomials<D, Degree> table;
    constexpr auto factor = static_cast<std::size_t>(table.factor[k + 1]);
    constexpr auto variable = static_cast<std::size_t>(table.variable[k + 1]);
    m[k + 1] = m[factor] * s[variable];
  });
  return m;
}

}  // namespace

template <int D, int Degree>
auto ReproducingKernel<D, Degree>::basis(const std::array<Lanes, D>& s) -> BasisVector {
  return monomials_at<D, Degree>(s, Lanes(1.0));
}

template <int D, int Degree>
void ReproducingKernel<D, Degree>::factorise_moments() {
  // factor_ holds M (lower triangle). Jacobi scaling, then L L^T; quality_ is the smallest L_kk^2.
  constexpr auto n = static_cast<std::size_t>(basis_size);
  for (std::size_t a = 0; a < n; ++a) scale_[a] = 1.0 / sqrt(factor_[a * n + a]);
  quality_ = Lanes(1.0);
  unroll<n>([&](auto a) {
    unroll<a>([&](auto b) {
      Lanes s = factor_[a * n + b] * (scale_[a] * scale_[b]);
      unroll<b>([&](auto k) { s -= factor_[a * n + k] * factor_[b * n + k]; });
      factor_[a * n + b] = s * inverse_pivot_[b];
    });
    Lanes pivot = factor_[a * n + a] * (scale_[a] * scale_[a]);
    unroll<a>([&](auto k) { pivot -= factor_[a * n + k] * factor_[a * n + k]; });
    quality_ = select(pivot.v >= quality_.v, quality_, pivot);  // not a number stays visible
    inverse_pivot_[a] = 1.0 / sqrt(pivot);
  });
}

template <int D, int Degree>
auto ReproducingKernel<D, Degree>::solve(const BasisVector& right_hand_side) const -> BasisVector {
  constexpr auto n = static_cast<std::size_t>(basis_size);
  BasisVector x;
  unroll<n>([&](auto a) {
    Lanes s = scale_[a] * right_hand_side[a];
    unroll<a>([&](auto k) { s -= factor_[a * n + k] * x[k]; });
    x[a] = s * inverse_pivot_[a];
  });
  unroll<n>([&](auto reverse) {
    constexpr std::size_t a = n - 1 - reverse;
    Lanes s = x[a];
    unroll<reverse>([&](auto k) { s -= factor_[(a + 1 + k) * n + a] * x[a + 1 + k]; });
    x[a] = s * inverse_pivot_[a];
  });
  unroll<n>([&](auto a) { x[a] *= scale_[a]; });
  return x;
}

template <int D, int Degree>
template <class W>
void ReproducingKernel<D, Degree>::evaluate_windows(const std::array<Vec<D>, 4>& points,
                                                    std::span<const Candidate<D>> candidates,
                                                    Derivatives order, Real inverse_H) {
  const bool first = order != Derivatives::none, second = order == Derivatives::second;
  std::array<Lanes, D> x;
  for (int i = 0; i < D; ++i) at(x, i) = {points[0][i], points[1][i], points[2][i], points[3][i]};
  kernel_.resize(candidates.size());
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    Kernel& kernel = kernel_[k];
    const Candidate<D>& c = candidates[k];
    std::array<Lanes, D> d;
    Lanes r2 = Lanes::zero();
    for (int i = 0; i < D; ++i) {
      at(d, i) = c.X[i] - at(x, i);
      r2 += at(d, i) * at(d, i);
      at(kernel.s, i) = at(d, i) * inverse_H;
    }
    const Real inverse_support = 1 / c.support;
    const WindowValue w = W::at(sqrt(r2) * inverse_support);
    kernel.phi = w.phi;
    if (!first) continue;
    const Lanes alpha = w.alpha * (inverse_support * inverse_support);
    for (int i = 0; i < D; ++i) at(kernel.phi_i, i) = -alpha * at(d, i);
    if (!second) continue;
    const Lanes beta = w.beta * (inverse_support * inverse_support) / max(r2, 1e-300);
    for (int i = 0; i < D; ++i)
      for (int j = i; j < D; ++j)
        at(kernel.phi_ij, hessian_index(D, i, j)) =
            i == j ? alpha + beta * at(d, i) * at(d, i) : beta * at(d, i) * at(d, j);
  }
}

template <int D, int Degree>
void ReproducingKernel<D, Degree>::evaluate(const std::array<Vec<D>, 4>& points,
                                            std::span<const Candidate<D>> candidates,
                                            Derivatives order) {
  constexpr auto n = static_cast<std::size_t>(basis_size);
  constexpr auto pairs = static_cast<std::size_t>(hessian_count(D));
  static constexpr auto product = monomial_products<D, Degree>();
  const bool first = order != Derivatives::none, second = order == Derivatives::second;

  Real H = 0;
  for (const auto& c : candidates) H = std::max(H, c.support);
  const Real inverse_H = 1 / H;
  with_window(window_,
              [&](auto w) { evaluate_windows<decltype(w)>(points, candidates, order, inverse_H); });

  std::array<Lanes, static_cast<std::size_t>(monomial_count(D, 2 * Degree))> moment;
  moment.fill(Lanes::zero());
  const std::size_t even = kernel_.size() / 2 * 2;
  for (std::size_t k = 0; k < even; k += 2) {  // two at once: the sums do not fit into registers
    const auto m1 = monomials_at<D, 2 * Degree>(kernel_[k].s, kernel_[k].phi);
    const auto m2 = monomials_at<D, 2 * Degree>(kernel_[k + 1].s, kernel_[k + 1].phi);
    unroll<m1.size()>([&](auto a) { moment[a] += m1[a] + m2[a]; });
  }
  if (even < kernel_.size()) {
    const auto m = monomials_at<D, 2 * Degree>(kernel_[even].s, kernel_[even].phi);
    unroll<m.size()>([&](auto a) { moment[a] += m[a]; });
  }
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b <= a; ++b) factor_[a * n + b] = at(moment, product[a][b]);
  factorise_moments();

  BasisVector right;
  right.fill(Lanes::zero());
  right[0] = Lanes(1.0);
  const BasisVector c = solve(right);

  std::array<BasisVector, D> c_i;
  if (first) {
    for (std::size_t i = 0; i < D; ++i) {
      c_i[i].fill(Lanes::zero());
      c_i[i][1 + i] = Lanes(inverse_H);
    }
    for (const Kernel& kernel : kernel_) {
      const BasisVector P = basis(kernel.s);
      const Lanes Pc = dot(P, c);
      for (std::size_t i = 0; i < D; ++i) add_scaled(c_i[i], -kernel.phi_i[i] * Pc, P);
    }
    for (std::size_t i = 0; i < D; ++i) c_i[i] = solve(c_i[i]);
  }

  std::array<BasisVector, pairs> c_ij;
  if (second) {
    for (std::size_t i = 0; i < D; ++i)
      for (std::size_t j = i; j < D; ++j) {
        const auto ij =
            static_cast<std::size_t>(hessian_index(D, static_cast<int>(i), static_cast<int>(j)));
        c_ij[ij].fill(Lanes::zero());
        if constexpr (Degree >= 2)
          c_ij[ij][1 + D + ij] = Lanes((i == j ? 2 : 1) * inverse_H * inverse_H);
      }
    for (const Kernel& kernel : kernel_) {
      const BasisVector P = basis(kernel.s);
      const Lanes Pc = dot(P, c);
      std::array<Lanes, D> Pc_i;
      for (std::size_t i = 0; i < D; ++i) Pc_i[i] = dot(P, c_i[i]);
      std::size_t ij = 0;
      for (std::size_t i = 0; i < D; ++i)
        for (std::size_t j = i; j < D; ++j, ++ij)
          add_scaled(
              c_ij[ij],
              -(kernel.phi_ij[ij] * Pc + kernel.phi_i[i] * Pc_i[j] + kernel.phi_i[j] * Pc_i[i]), P);
    }
    for (std::size_t ij = 0; ij < pairs; ++ij) c_ij[ij] = solve(c_ij[ij]);
  }

  value_.resize(candidates.size());
  if (first) gradient_.resize(candidates.size() * D);
  if (second) hessian_.resize(candidates.size() * pairs);
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const Kernel& kernel = kernel_[k];
    const BasisVector P = basis(kernel.s);
    const Lanes Pc = dot(P, c);
    value_[k] = Pc * kernel.phi;
    if (!first) continue;
    std::array<Lanes, D> Pc_i;
    for (std::size_t i = 0; i < D; ++i) {
      Pc_i[i] = dot(P, c_i[i]);
      gradient_[k * D + i] = Pc_i[i] * kernel.phi + Pc * kernel.phi_i[i];
    }
    if (!second) continue;
    std::size_t ij = 0;
    for (std::size_t i = 0; i < D; ++i)
      for (std::size_t j = i; j < D; ++j, ++ij)
        hessian_[k * pairs + ij] = dot(P, c_ij[ij]) * kernel.phi + Pc_i[i] * kernel.phi_i[j] +
                                   Pc_i[j] * kernel.phi_i[i] + Pc * kernel.phi_ij[ij];
  }
}

}  // namespace meniscus
