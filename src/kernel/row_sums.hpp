// SPDX-License-Identifier: BSD-3-Clause
// Sums over one row of shape functions: the value of a nodal field at a point, and the transpose.
#pragma once
#include "kernel/point_rows.hpp"

namespace meniscus {

/// N_A of an entry of the rows, for each component.
template <int D>
Lanes shape_at(const PointRows<D>& rows, Offset entry) {
  const Real even = at(rows.value, entry);
  return Lanes(rows.folded ? at(rows.odd_value, entry) : even, even, even, even);
}

/// sum_A N_A f_A at point q, for folded rows.
template <int D>
[[gnu::noinline]] NodalVector folded_value_at(const PointRows<D>& rows, Index q,
                                              const NodalVector* field) {
  Lanes sum = Lanes::zero();
  for (Offset e = at(rows.start, q); e < at(rows.start, q + 1); ++e)
    sum += shape_at(rows, e) * field[at(rows.particle, e)];
  return sum;
}

/// sum_A N_A f_A at point q.
template <int D>
NodalVector value_at(const PointRows<D>& rows, Index q, const NodalVector* field) {
  if constexpr (D == 2)
    if (rows.folded) return folded_value_at(rows, q, field);
  Lanes even = Lanes::zero(), odd = even;  // two chains hide the latency
  const Real* N = rows.value.data() + at(rows.start, q);
  const Index* A = rows.particle.data() + at(rows.start, q);
  const Index* const end = rows.particle.data() + at(rows.start, q + 1);
  for (; A + 1 < end; A += 2, N += 2) {
    even += N[0] * field[A[0]];
    odd += N[1] * field[A[1]];
  }
  if (A != end) even += *N * field[*A];
  return even + odd;
}

/// The values of two fields at point q, in one pass over the row; value_at() gives the same bits.
template <int D>
std::array<NodalVector, 2> values_at(const PointRows<D>& rows, Index q, const NodalVector* one,
                                     const NodalVector* other) {
  if constexpr (D == 2)
    if (rows.folded) return {folded_value_at(rows, q, one), folded_value_at(rows, q, other)};
  Lanes even[2] = {Lanes::zero(), Lanes::zero()}, odd[2] = {Lanes::zero(), Lanes::zero()};
  const Real* N = rows.value.data() + at(rows.start, q);
  const Index* A = rows.particle.data() + at(rows.start, q);
  const Index* const end = rows.particle.data() + at(rows.start, q + 1);
  for (; A + 1 < end; A += 2, N += 2) {
    even[0] += N[0] * one[A[0]];
    even[1] += N[0] * other[A[0]];
    odd[0] += N[1] * one[A[1]];
    odd[1] += N[1] * other[A[1]];
  }
  if (A != end) {
    even[0] += *N * one[*A];
    even[1] += *N * other[*A];
  }
  return {even[0] + odd[0], even[1] + odd[1]};
}

/// N_A,K of an entry of the rows, for each component.
template <int D>
Lanes slope_at(const PointRows<D>& rows, Offset entry, int K) {
  const Real even = at(rows.gradient, entry * D + K);
  return Lanes(rows.folded ? at(rows.odd_gradient, entry * D + K) : even, even, even, even);
}

/// The stretch of the circle of point q per component 0 of the particle of an entry of its folded
/// row: N_A/X_0, or its limit on the axis.
template <int D>
Real circle_stretch_at(const PointRows<D>& rows, Index q, Offset entry) {
  const Real radius = at(rows.radius, q);
  return radius > 0 ? at(rows.odd_value, entry) / radius : at(rows.odd_gradient, entry * D);
}

/// Column K is sum_A f_A N_A,K at point q, for folded rows.
template <int D>
[[gnu::noinline]] std::array<Lanes, D> folded_gradient_at(const PointRows<D>& rows, Index q,
                                                          const NodalVector* field) {
  std::array<Lanes, D> column;
  column.fill(Lanes::zero());
  for (Offset e = at(rows.start, q); e < at(rows.start, q + 1); ++e)
    for (int K = 0; K < D; ++K) at(column, K) += slope_at(rows, e, K) * field[at(rows.particle, e)];
  return column;
}

/// The gradient of the field at point q: column K is sum_A f_A N_A,K.
template <int D>
[[gnu::always_inline]] inline std::array<Lanes, D> gradient_at(const PointRows<D>& rows, Index q,
                                                               const NodalVector* field) {
  if constexpr (D == 2)
    if (rows.folded) return folded_gradient_at(rows, q, field);
  Lanes even[D], odd[D];
  for (int K = 0; K < D; ++K) even[K] = odd[K] = Lanes::zero();
  const Real* g = rows.gradient.data() + at(rows.start, q) * D;
  const Index* A = rows.particle.data() + at(rows.start, q);
  const Index* const end = rows.particle.data() + at(rows.start, q + 1);
  for (; A + 1 < end; A += 2, g += 2 * D)
    for (int K = 0; K < D; ++K) {
      even[K] += field[A[0]] * g[K];
      odd[K] += field[A[1]] * g[D + K];
    }
  if (A != end)
    for (int K = 0; K < D; ++K) even[K] += field[*A] * g[K];
  std::array<Lanes, D> column;
  for (int K = 0; K < D; ++K) at(column, K) = even[K] + odd[K];
  return column;
}

/// sum_A (direction . f_A) N_A,KL at point q, packed as in hessian_index().
template <int D>
std::array<Real, static_cast<std::size_t>(hessian_count(D))> hessian_along(
    const PointRows<D>& rows, Index q, const NodalVector* field, const Vec<D>& direction) {
  std::array<Real, static_cast<std::size_t>(hessian_count(D))> sum{};
  for (Offset e = at(rows.start, q); e < at(rows.start, q + 1); ++e) {
    const Lanes& f = field[at(rows.particle, e)];
    Real component = rows.folded ? 0 : direction[0] * f[0];
    for (int i = 1; i < D; ++i) component += direction[i] * f[i];
    const Real* hessian = rows.hessian.data() + e * hessian_count(D);
    for (std::size_t ij = 0; ij < sum.size(); ++ij) sum[ij] += component * hessian[ij];
    if (!rows.folded) continue;
    const Real* odd = rows.odd_hessian.data() + e * hessian_count(D);
    for (std::size_t ij = 0; ij < sum.size(); ++ij) sum[ij] += direction[0] * f[0] * odd[ij];
  }
  return sum;
}

/// field_A += N_A x.
template <int D>
void scatter_value(const PointRows<D>& rows, Index q, NodalVector x, NodalVector* field) {
  if constexpr (D == 2)
    if (rows.folded) {
      for (Offset e = at(rows.start, q); e < at(rows.start, q + 1); ++e)
        field[at(rows.particle, e)] += shape_at(rows, e) * x;
      return;
    }
  for (Offset e = at(rows.start, q); e < at(rows.start, q + 1); ++e)
    field[at(rows.particle, e)] += at(rows.value, e) * x;
}

}  // namespace meniscus
