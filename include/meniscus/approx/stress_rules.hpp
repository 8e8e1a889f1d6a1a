// SPDX-License-Identifier: BSD-3-Clause
// The two integration rules of the internal force as operators of the time loop. Both treat stress
// points in groups of up to four: gather() turns a nodal field into its gradient at the points of a
// group, a lane per point; scatter() is the exact transpose. Lanes without a point have weight
// zero.
#pragma once
#include "meniscus/approx/force_windows.hpp"
#include "meniscus/approx/row_sums.hpp"
#include "meniscus/core/tensor.hpp"

#include <span>

namespace meniscus {

namespace detail {

inline const Real* components(const Lanes& x) {
  return reinterpret_cast<const Real*>(&x);
}

/// (a_q, b_q, c_q, 0) of lane q.
inline std::array<Lanes, 4> by_lane(Lanes a, Lanes b, Lanes c) {
  const __m256d ab0 = _mm256_unpacklo_pd(a.v, b.v), ab1 = _mm256_unpackhi_pd(a.v, b.v);
  const __m256d zero = _mm256_setzero_pd();
  const __m256d c0 = _mm256_unpacklo_pd(c.v, zero), c1 = _mm256_unpackhi_pd(c.v, zero);
  return {Lanes::Native(_mm256_permute2f128_pd(ab0, c0, 0x20)),
          Lanes::Native(_mm256_permute2f128_pd(ab1, c1, 0x20)),
          Lanes::Native(_mm256_permute2f128_pd(ab0, c0, 0x31)),
          Lanes::Native(_mm256_permute2f128_pd(ab1, c1, 0x31))};
}

/// (1, x0, x1, x2).
inline Lanes after_one(Lanes x) {
  const __m256d rotated = _mm256_permute4x64_pd(x.v, _MM_SHUFFLE(2, 1, 0, 3));
  return Lanes::Native(_mm256_blend_pd(rotated, _mm256_set1_pd(1.0), 1));
}

/// (sum of a, sum of b, sum of c, 0).
inline Lanes lane_sums(Lanes a, Lanes b, Lanes c) {
  const __m256d ab = _mm256_hadd_pd(a.v, b.v), c0 = _mm256_hadd_pd(c.v, _mm256_setzero_pd());
  return Lanes::Native(_mm256_permute2f128_pd(ab, c0, 0x20)) +
         Lanes(Lanes::Native(_mm256_permute2f128_pd(ab, c0, 0x31)));
}

}  // namespace detail

/// Nodal cells with linear moments, "q_scni" (RKPM note 5.3): in cell L the gradient of a field is
/// sum_A f_A (a_A + B_A xi), evaluated at D + 1 points xi_q of equal weight that reproduce volume,
/// centroid and covariance of the cell. A group is a cell.
///
/// The time loop is bound by memory, so coefficients are stored in single precision. What rounding
/// would spoil is put right in double: a few further entries per cell restore the moments of all
/// quadratic polynomials, so that gradients of quadratic fields, patch tests, force and torque sums
/// are exact to double round-off; other fields see coefficients that differ by 6e-8.
template <int D>
struct CellRule {
  static constexpr int exact_entries = monomial_count(D, 2);

  std::vector<Offset> start{0};           ///< [cell + 1]
  std::vector<Index> particle;            ///< [entry]
  AlignedVector<FloatLanes> coefficient;  ///< [entry][K]: (a_AK, B_AK0, B_AK1, B_AK2)
  std::vector<Index> exact_particle;      ///< [cell][exact entry]
  AlignedVector<Lanes> exact;             ///< [cell][exact entry][K], added to coefficient
  AlignedVector<Lanes> point;             ///< [cell][M]: xi_qM, a lane per stress point q
  std::vector<Real> volume;               ///< [cell]

  Index groups() const { return static_cast<Index>(volume.size()); }
  Index points_per_group() const { return D + 1; }
  /// Number of the cell (= particle) that a lane of a group belongs to.
  Index owner(Index group, int) const { return group; }
  Lanes weight(Index group) const {
    const Real w = at(volume, group) / (D + 1);
    return {w, w, w, D == 3 ? w : 0.0};
  }

  /// H_iK = f_i,K at the stress points of a cell.
  [[gnu::always_inline]] void gather(Index cell, const Lanes* field, Tensor<Lanes>& H) const {
    Lanes moment[D][D];
    for (auto& row : moment)
      for (auto& m : row) m = Lanes::zero();
    const auto add = [&](Index A, const auto* g) __attribute__((always_inline)) {
      const Real* f = detail::components(field[A]);
      for (int K = 0; K < D; ++K) {
        const Lanes c = g[K];
        for (int i = 0; i < D; ++i) moment[i][K] += f[i] * c;
      }
    };
    for_each_entry(cell, prefetch_begin(cell), add);
    const Lanes* xi = point.data() + static_cast<std::size_t>(cell) * D;
    H = Tensor<Lanes>::zero();
    for (int i = 0; i < D; ++i)
      for (int K = 0; K < D; ++K) {
        const Real* m = detail::components(moment[i][K]);
        H(i, K) = Lanes(m[0]);
        for (int M = 0; M < D; ++M) H(i, K) += m[M + 1] * xi[M];
      }
  }

  /// force_A,i += sum_q P_iK(q) (a_AK + B_AKM xi_qM).
  [[gnu::always_inline]] void scatter(Index cell, const Tensor<Lanes>& P, Lanes* force) const {
    // moment[i][K] = (sum_q P_iK, sum_q P_iK xi_q0, ...), in the order of the coefficients.
    const Lanes* xi = point.data() + static_cast<std::size_t>(cell) * D;
    const auto rows = detail::by_lane(xi[0], xi[1], D == 3 ? xi[D - 1] : Lanes::zero());
    Lanes moment[3][D];
    for (int i = 0; i < D; ++i)
      for (int K = 0; K < D; ++K) {
        const Real* p = detail::components(P(i, K));
        const auto weighted = [&](std::size_t q) { return p[q] * detail::after_one(rows[q]); };
        moment[i][K] = (weighted(0) + weighted(1)) + (weighted(2) + weighted(3));
      }
    if constexpr (D == 2) moment[2][0] = moment[2][1] = Lanes::zero();
    const auto add = [&](Index A, const auto* g) __attribute__((always_inline)) {
      Lanes sum[3];
      const Lanes first = g[0];
      for (int i = 0; i < 3; ++i) sum[i] = moment[i][0] * first;
      for (int K = 1; K < D; ++K) {
        const Lanes c = g[K];
        for (int i = 0; i < 3; ++i) sum[i] += moment[i][K] * c;
      }
      force[A] += detail::lane_sums(sum[0], sum[1], sum[2]);
    };
    for_each_entry(cell, prefetch_begin(cell) + entries(cell) * cache_line, add);
  }

  ForceWindows windows(Index particles) const { return {start, particle, particles}; }
  Offset pairs() const { return start.back(); }
  std::size_t bytes() const {
    return start.size() * sizeof(Offset) +
           (particle.size() + exact_particle.size()) * sizeof(Index) +
           coefficient.size() * sizeof(FloatLanes) + (exact.size() + point.size()) * sizeof(Lanes) +
           volume.size() * sizeof(Real);
  }

 private:
  Offset entries(Index cell) const { return at(start, cell + 1) - at(start, cell); }

  /// Calls add(A, coefficients) for all entries of a cell, and touches the memory at `ahead`, a
  /// line per entry. Coefficients are read once from memory and again from cache: fetching those of
  /// the next cell in every loop over this one lets memory and arithmetic overlap.
  template <class F>
  [[gnu::always_inline]] void for_each_entry(Index cell, const char* ahead, F&& add) const {
    const FloatLanes* g = coefficient.data() + at(start, cell) * D;
    const Index* A = particle.data() + at(start, cell);
    const Index* const end = particle.data() + at(start, cell + 1);
    for (; A != end; ++A, g += D, ahead += cache_line) {
      _mm_prefetch(ahead, _MM_HINT_T1);
      add(*A, g);
    }
    const auto first = static_cast<std::size_t>(cell) * exact_entries;
    for (std::size_t e = first; e < first + exact_entries; ++e)
      add(exact_particle[e], exact.data() + e * D);
  }

  static constexpr std::ptrdiff_t cache_line = 64;
  const char* prefetch_begin(Index cell) const {
    return reinterpret_cast<const char*>(coefficient.data() + at(start, cell + 1) * D);
  }
};

/// Stress at evaluation points with gradients of shape functions: Gauss points, or the particles
/// themselves. A group is `per_group` consecutive points (one where neighbouring points have
/// different material numbers).
template <int D>
struct PointRule {
  PointRows<D> rows;               ///< gradients
  std::vector<Real> point_weight;  ///< [point]: reference volume
  std::vector<Index> point_owner;  ///< [point]: nearest particle, for messages and output
  Index per_group = 4;

  Index groups() const { return (rows.size() + per_group - 1) / per_group; }
  Index points_per_group() const { return per_group; }
  Index owner(Index group, int lane) const {
    return at(point_owner, std::min(group * per_group + lane, rows.size() - 1));
  }
  Lanes weight(Index group) const {
    Lanes w = Lanes::zero();
    for (int lane = 0; lane < count(group); ++lane)
      w.set(lane, at(point_weight, group * per_group + lane));
    return w;
  }

  [[gnu::always_inline]] void gather(Index group, const Lanes* field, Tensor<Lanes>& H) const {
    H = Tensor<Lanes>::zero();
    for (int lane = 0; lane < count(group); ++lane) {
      const auto column = gradient_at(rows, group * per_group + lane, field);
      for (int K = 0; K < D; ++K)
        for (int i = 0; i < D; ++i) H(i, K).set(lane, at(column, K)[i]);
    }
  }

  [[gnu::always_inline]] void scatter(Index group, const Tensor<Lanes>& P, Lanes* force) const {
    std::array<Lanes, 4> column[D];
    for (int K = 0; K < D; ++K) column[K] = detail::by_lane(P(0, K), P(1, K), P(2, K));
    for (int lane = 0; lane < count(group); ++lane) {
      const Index q = group * per_group + lane;
      const Real* g = rows.gradient.data() + at(rows.start, q) * D;
      const Index* A = rows.particle.data() + at(rows.start, q);
      const Index* const end = rows.particle.data() + at(rows.start, q + 1);
      for (; A != end; ++A, g += D) {
        Lanes f = at(column[0], lane) * g[0];
        for (int K = 1; K < D; ++K) f += at(column[K], lane) * g[K];
        force[*A] += f;
      }
    }
  }

  Offset pairs() const { return rows.entries(); }
  ForceWindows windows(Index particles) const {
    // Windows count groups as rows.
    std::vector<Offset> group_start;
    for (Index g = 0; g < groups(); ++g) group_start.push_back(at(rows.start, g * per_group));
    group_start.push_back(rows.entries());
    return {group_start, rows.particle, particles};
  }
  std::size_t bytes() const {
    return rows.bytes() + point_weight.size() * sizeof(Real) + point_owner.size() * sizeof(Index);
  }

 private:
  int count(Index group) const { return std::min(per_group, rows.size() - group * per_group); }
};

}  // namespace meniscus
