// SPDX-License-Identifier: BSD-3-Clause
// Moment sums, their factorisation and the evaluation of shape functions, four points at a time.
// Included by one source file per degree of the basis: the unrolled sums take long to compile.
#pragma once
#include "kernel/reproducing_kernel.hpp"
#include "numbers/unroll.hpp"

#include <algorithm>

namespace meniscus {
namespace {

template <std::size_t N>
[[gnu::always_inline]] inline Lanes dot(const std::array<Lanes, N>& a,
                                        const std::array<Lanes, N>& b) {
  Lanes even = a[0] * b[0], odd = a[1] * b[1];  // two chains hide the latency
  unroll<N / 2 - 1>([&](auto k) {
    even += a[2 * k + 2] * b[2 * k + 2];
    odd += a[2 * k + 3] * b[2 * k + 3];
  });
  if constexpr (N % 2 == 1) even += a[N - 1] * b[N - 1];
  return even + odd;
}

template <int D, int Degree>
constexpr auto basis_length = static_cast<std::size_t>(monomial_count(D, Degree));

/// Values of all monomials up to Degree at s.
template <int D, int Degree>
[[gnu::always_inline]] inline std::array<Lanes, basis_length<D, Degree>> monomials_at(
    const std::array<Lanes, D>& s) {
  std::array<Lanes, basis_length<D, Degree>> m;
  m[0] = Lanes(1.0);
  unroll<m.size() - 1>([&](auto k) {
    constexpr Monomials<D, Degree> table;
    constexpr auto factor = static_cast<std::size_t>(table.factor[k + 1]);
    constexpr auto variable = static_cast<std::size_t>(table.variable[k + 1]);
    m[k + 1] = m[factor] * s[variable];
  });
  return m;
}

/// Adds the values of monomial n and of all its multiples at s1 and s2 to `sum`; m1 and m2 are the
/// values of monomial n. The recursion is depth first, so only the factors of the current monomial
/// are kept. Two points are added at once, because the sums do not fit into registers.
template <int D, int Degree, int n = 0>
[[gnu::always_inline]] inline void add_monomials(std::array<Lanes, basis_length<D, Degree>>& sum,
                                                 const std::array<Lanes, D>& s1, Lanes m1,
                                                 const std::array<Lanes, D>& s2, Lanes m2) {
  constexpr Monomials<D, Degree> table;
  Lanes& total = sum[static_cast<std::size_t>(n)];
  total += m1;
  total += m2;
  constexpr int first = table.first_multiple(n);
  if constexpr (first > 0) {
    constexpr auto variable =
        static_cast<std::size_t>(table.variable[static_cast<std::size_t>(first)]);
    unroll<D - variable>([&](auto k) {
      add_monomials<D, Degree, first + static_cast<int>(k)>(sum, s1, m1 * s1[variable + k], s2,
                                                            m2 * s2[variable + k]);
    });
  }
}

/// Calls f(i, j, ij) for the entries of a packed second derivative.
template <int D, class F>
[[gnu::always_inline]] inline void for_hessian(F&& f) {
  std::size_t ij = 0;
  for (std::size_t i = 0; i < D; ++i)
    for (std::size_t j = i; j < D; ++j, ++ij) f(i, j, ij);
}

}  // namespace

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
    quality_ = select(pivot.v >= quality_.v, quality_, pivot);  // a NaN is kept
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
void ReproducingKernel<D, Degree>::evaluate_functions(const std::array<Vec<D>, 4>& points,
                                                      std::span<const Candidate<D>> candidates,
                                                      Derivatives order, Real H) {
  std::array<Lanes, D> x;
  for (int i = 0; i < D; ++i) at(x, i) = {points[0][i], points[1][i], points[2][i], points[3][i]};
  const Real inverse_H = 1 / H;
  // One code for all orders of derivatives: otherwise fused multiply-adds could change the bits.
  kernel_.resize(candidates.size() + candidates.size() % 2);
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    Kernel& kernel = kernel_[k];
    const Candidate<D>& c = candidates[k];
    Lanes s2 = Lanes::zero();
    for (int i = 0; i < D; ++i) {
      at(kernel.s, i) = (c.X[i] - at(x, i)) * inverse_H;
      s2 += at(kernel.s, i) * at(kernel.s, i);
    }
    const Real ratio = H / c.support;
    const Real weight = kernel_weight<W>(ratio);
    const KernelValue w = W::at(sqrt(s2) * ratio);
    kernel.phi = w.phi * weight;
    if (order == Derivatives::none) continue;
    kernel.a = w.alpha * (ratio * ratio * weight);
    if (order == Derivatives::first) continue;
    kernel.b = w.beta * (ratio * ratio * weight) / max(s2, 1e-300);
  }
  if (kernel_.size() > candidates.size()) kernel_.back() = Kernel{};  // adds zero to its pair
}

template <int D, int Degree>
void ReproducingKernel<D, Degree>::sum_moments() {
  constexpr auto n = static_cast<std::size_t>(basis_size);
  static constexpr auto product = monomial_products<D, Degree>();
  std::array<Lanes, basis_length<D, 2 * Degree>> moment;
  moment.fill(Lanes::zero());
  for (std::size_t k = 0; k < kernel_.size(); k += 2) {
    const Kernel &one = kernel_[k], &two = kernel_[k + 1];
    add_monomials<D, 2 * Degree>(moment, one.s, one.phi, two.s, two.phi);
  }
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b <= a; ++b) factor_[a * n + b] = at(moment, product[a][b]);
}

template <int D, int Degree>
auto ReproducingKernel<D, Degree>::first_right_hand_sides(const BasisVector& c) const
    -> std::array<BasisVector, D> {
  // - sum Phi_A,i P_A (P_A.c) = sum a_A (P_A.c) s_i P_A: monomials of one degree more.
  std::array<Lanes, basis_length<D, Degree + 1>> sum;
  sum.fill(Lanes::zero());
  for (std::size_t k = 0; k < kernel_.size(); k += 2) {
    const Kernel &one = kernel_[k], &two = kernel_[k + 1];
    add_monomials<D, Degree + 1>(sum, one.s, one.a * dot(monomials_at<D, Degree>(one.s), c), two.s,
                                 two.a * dot(monomials_at<D, Degree>(two.s), c));
  }
  std::array<BasisVector, D> right;
  static constexpr auto times = monomial_multiples<D, Degree>();
  for (std::size_t i = 0; i < D; ++i) {
    for (std::size_t m = 0; m < right[i].size(); ++m) right[i][m] = at(sum, times[m][i]);
    right[i][1 + i] += 1.0;
  }
  return right;
}

template <int D, int Degree>
auto ReproducingKernel<D, Degree>::second_right_hand_sides(
    const BasisVector& c, const std::array<BasisVector, D>& c_i) const
    -> std::array<BasisVector, static_cast<std::size_t>(hessian_count(D))> {
  constexpr auto pairs = static_cast<std::size_t>(hessian_count(D));
  std::array<BasisVector, pairs> right;
  for (BasisVector& r : right) r.fill(Lanes::zero());
  if constexpr (Degree >= 2)
    for_hessian<D>([&](std::size_t i, std::size_t j, std::size_t ij) {
      right[ij][1 + D + ij] = Lanes(i == j ? 2.0 : 1.0);
    });
  // Phi_A,ij (P_A.c) + Phi_A,i (P_A.c,j) + Phi_A,j (P_A.c,i)
  const auto factors = [&](const Kernel& kernel, const BasisVector& P) {
    const Lanes Pc = dot(P, c), a_Pc = kernel.a * Pc, b_Pc = kernel.b * Pc;
    std::array<Lanes, D> a_Pc_i;
    for (std::size_t i = 0; i < D; ++i) a_Pc_i[i] = kernel.a * dot(P, c_i[i]);
    std::array<Lanes, pairs> factor;
    for_hessian<D>([&](std::size_t i, std::size_t j, std::size_t ij) {
      factor[ij] = kernel.s[j] * (b_Pc * kernel.s[i] - a_Pc_i[i]) - kernel.s[i] * a_Pc_i[j];
      if (i == j) factor[ij] += a_Pc;
    });
    return factor;
  };
  for (std::size_t k = 0; k < kernel_.size(); k += 2) {
    const BasisVector P1 = monomials_at<D, Degree>(kernel_[k].s),
                      P2 = monomials_at<D, Degree>(kernel_[k + 1].s);
    const auto factor1 = factors(kernel_[k], P1), factor2 = factors(kernel_[k + 1], P2);
    for (std::size_t ij = 0; ij < pairs; ++ij)
      unroll<P1.size()>([&](auto m) {
        right[ij][m] -= factor1[ij] * P1[m];
        right[ij][m] -= factor2[ij] * P2[m];
      });
  }
  return right;
}

template <int D, int Degree>
template <Derivatives order>
void ReproducingKernel<D, Degree>::evaluate_order(const std::array<Vec<D>, 4>& points,
                                                  std::span<const Candidate<D>> candidates) {
  constexpr bool first = order != Derivatives::none, second = order == Derivatives::second;
  constexpr auto pairs = static_cast<std::size_t>(hessian_count(D));
  Real H = 0;
  for (const auto& candidate : candidates) H = std::max(H, candidate.support);
  scale_of_places_ = H;
  with_kernel_function(kernel_function_, [&](auto w) {
    evaluate_functions<decltype(w)>(points, candidates, order, H);
  });
  sum_moments();
  factorise_moments();

  BasisVector unit;
  unit.fill(Lanes::zero());
  unit[0] = Lanes(1.0);
  const BasisVector c = solve(unit);
  std::array<BasisVector, D> c_i;
  std::array<BasisVector, pairs> c_ij;
  if constexpr (first) {
    c_i = first_right_hand_sides(c);
    for (BasisVector& x : c_i) x = solve(x);
  }
  if constexpr (second) {
    c_ij = second_right_hand_sides(c, c_i);
    for (BasisVector& x : c_ij) x = solve(x);
  }

  const Real inverse_H = 1 / H, inverse_H2 = inverse_H * inverse_H;
  value_.resize(candidates.size());
  if constexpr (first) gradient_.resize(candidates.size() * D);
  if constexpr (second) hessian_.resize(candidates.size() * pairs);
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const Kernel& kernel = kernel_[k];
    const BasisVector P = monomials_at<D, Degree>(kernel.s);
    const Lanes Pc = dot(P, c);
    value_[k] = Pc * kernel.phi;
    if constexpr (first) {
      const Lanes a_Pc = kernel.a * Pc;
      std::array<Lanes, D> Pc_i;
      for (std::size_t i = 0; i < D; ++i) {
        Pc_i[i] = dot(P, c_i[i]);
        gradient_[k * D + i] = inverse_H * (Pc_i[i] * kernel.phi - a_Pc * kernel.s[i]);
      }
      if constexpr (second) {
        const Lanes b_Pc = kernel.b * Pc;
        for_hessian<D>([&](std::size_t i, std::size_t j, std::size_t ij) {
          const Lanes mixed = kernel.s[i] * Pc_i[j] + kernel.s[j] * Pc_i[i];
          Lanes N_ij =
              dot(P, c_ij[ij]) * kernel.phi - kernel.a * mixed + b_Pc * (kernel.s[i] * kernel.s[j]);
          if (i == j) N_ij += a_Pc;
          hessian_[k * pairs + ij] = inverse_H2 * N_ij;
        });
      }
    }
  }
}

template <int D, int Degree>
void ReproducingKernel<D, Degree>::evaluate_functionals(std::span<const BasisVector> b) {
  solved_.clear();
  for (const BasisVector& right : b) solved_.push_back(solve(right));
  functional_.resize(value_.size() * b.size());
  for (std::size_t k = 0; k < value_.size(); ++k) {
    const BasisVector P = monomials_at<D, Degree>(kernel_[k].s);
    for (std::size_t j = 0; j < b.size(); ++j)
      functional_[k * b.size() + j] = dot(P, solved_[j]) * kernel_[k].phi;
  }
}

template <int D, int Degree>
void ReproducingKernel<D, Degree>::evaluate(const std::array<Vec<D>, 4>& points,
                                            std::span<const Candidate<D>> candidates,
                                            Derivatives order) {
  switch (order) {
    case Derivatives::none:
      return evaluate_order<Derivatives::none>(points, candidates);
    case Derivatives::first:
      return evaluate_order<Derivatives::first>(points, candidates);
    case Derivatives::second:
      return evaluate_order<Derivatives::second>(points, candidates);
  }
}

}  // namespace meniscus
