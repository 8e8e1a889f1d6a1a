// SPDX-License-Identifier: BSD-3-Clause
// The two integration rules of the internal force, as operators of the time loop. Both treat
// quadrature points in groups of up to four. gather() computes the gradient of a nodal field at the
// points of a group, one lane per point; scatter() is the exact transpose. Lanes without a point
// have weight zero.
#pragma once
#include "kernel/row_sums.hpp"
#include "numbers/tensor.hpp"
#include "parallel/chunk_sums.hpp"

#include <cstdint>
#include <span>

namespace meniscus {

namespace detail {

inline const Real* components(const Lanes& x) {
  return reinterpret_cast<const Real*>(&x);
}

}  // namespace detail

/// sum_i += the sum over lanes of S_i,KL g_K g_L.
template <int D>
void add_squares(const std::array<Tensor<Lanes>, D>& S, const std::array<Lanes, D>& g,
                 NodalVector& sum) {
  for (int i = 0; i < D; ++i) {
    Lanes square = Lanes::zero();
    for (int K = 0; K < D; ++K)
      for (int L = 0; L < D; ++L) square += at(S, i)(K, L) * at(g, K) * at(g, L);
    sum.set(i, sum[i] + meniscus::sum(square));
  }
}

template <int D>
struct CellRule;
template <int D>
struct PointRule;

/// The functions of rules of bodies of revolution.
void gather_folded(const CellRule<2>& rule, Index cell, const NodalVector* field, Tensor<Lanes>& H);
void scatter_folded(const CellRule<2>& rule, Index cell, const Tensor<Lanes>& P,
                    NodalVector* force);
void add_folded_diagonal(const CellRule<2>& rule, Index cell, const std::array<Tensor<Lanes>, 2>& S,
                         NodalVector* sum);

void gather_folded(const PointRule<2>& rule, Index group, const NodalVector* field,
                   Tensor<Lanes>& H);
void scatter_folded(const PointRule<2>& rule, Index group, const Tensor<Lanes>& P,
                    NodalVector* force);
void add_folded_diagonal(const PointRule<2>& rule, Index group,
                         const std::array<Tensor<Lanes>, 2>& S, NodalVector* sum);

/// The part of the coefficients of the next row that a pass prefetches. gather() and scatter() of
/// one row follow each other: gather() reads from memory, scatter() from cache, and each prefetches
/// a part, so that memory access and arithmetic overlap. A pass alone prefetches the whole.
enum class Prefetch : std::uint8_t { first, second, whole };

/// Nodal cells with linear moments, "q_scni" (RKPM note 5.3). In cell L the gradient of a field is
/// sum_A f_A (a_A + B_A xi). It is evaluated at D + 1 points xi_q of equal weight that reproduce
/// volume, centroid and covariance of the cell. A group is a cell. Rows of other ranks are empty.
///
/// In a body of revolution, H_22 = u_0 / X_0 is the stretch of circles (axisymmetry note 3). Rows
/// are folded (PointRows): `coefficient` is for the component along the axis, `odd` for that across
/// it.
template <int D>
struct CellRule {
  std::vector<Offset> start{0};    ///< [cell + 1]
  std::vector<Index> particle;     ///< [entry]
  UnsetVector<Lanes> coefficient;  ///< [entry][K]: (a_AK, B_AK0, B_AK1, B_AK2)
  /// [entry][K], and [entry][2] of the stretch of circles: (h_A, Bh_A0, Bh_A1, 0); empty unless the
  /// body is of revolution
  UnsetVector<Lanes> odd;
  AlignedVector<Lanes> point;  ///< [cell][M]: xi_qM, a lane per stress point q
  std::vector<Real> volume;    ///< [cell]

  Index groups() const { return static_cast<Index>(volume.size()); }
  Index points_per_group() const { return D + 1; }
  /// Number of the cell, which is the number of its particle, for a lane of a group.
  Index owner(Index group, int) const { return group; }
  Lanes weight(Index group) const {
    const Real w = at(volume, group) / (D + 1);
    return {w, w, w, D == 3 ? w : 0.0};
  }

  /// H_iK = f_i,K at the quadrature points of a cell.
  [[gnu::always_inline]] void gather(Index cell, const NodalVector* field, Tensor<Lanes>& H,
                                     Prefetch ahead = Prefetch::first) const {
    if constexpr (D == 2)
      if (!odd.empty()) return gather_folded(*this, cell, field, H);
    Lanes moment[D][D];
    for (auto& row : moment)
      for (auto& m : row) m = Lanes::zero();
    for_entries(
        cell, ahead, [&](Index A, const std::array<Lanes, D>& g) __attribute__((always_inline)) {
          const Real* f = detail::components(field[A]);
          for (int i = 0; i < D; ++i)
            for (int K = 0; K < D; ++K) moment[i][K] += f[i] * at(g, K);
        });
    const Lanes* xi = point.data() + static_cast<std::size_t>(cell) * D;
    H = Tensor<Lanes>::zero();
    for (int i = 0; i < D; ++i)
      for (int K = 0; K < D; ++K) {
        const Real* m = detail::components(moment[i][K]);
        H(i, K) = Lanes(m[0]);
        for (int M = 0; M < D; ++M) H(i, K) += m[M + 1] * xi[M];
      }
  }

  /// force_A,i += sum_q P_iK(q) (a_AK + B_AKM xi_qM). Lanes of products with the coefficients are
  /// added up at the end.
  [[gnu::always_inline]] void scatter(Index cell, const Tensor<Lanes>& P, NodalVector* force,
                                      Prefetch ahead = Prefetch::second) const {
    if constexpr (D == 2)
      if (!odd.empty()) return scatter_folded(*this, cell, P, force);
    const Lanes* xi = point.data() + static_cast<std::size_t>(cell) * D;
    Lanes moment[D][D];  // (sum P_iK, sum P_iK xi_0, ...) over the points
    for (int i = 0; i < D; ++i)
      for (int K = 0; K < D; ++K)
        moment[i][K] = sums(P(i, K), P(i, K) * xi[0], P(i, K) * xi[1],
                            D == 3 ? P(i, K) * xi[D - 1] : Lanes::zero());
    for_entries(
        cell, ahead, [&](Index A, const std::array<Lanes, D>& g) __attribute__((always_inline)) {
          Lanes f[D];
          for (int i = 0; i < D; ++i) {
            f[i] = moment[i][0] * at(g, 0);
            for (int K = 1; K < D; ++K) f[i] += moment[i][K] * at(g, K);
          }
          force[A] += sums(f[0], f[1], D == 3 ? f[D - 1] : Lanes::zero(), Lanes::zero());
        });
  }

  /// sum_A,i += sum_q S_i,KL(q) g_AK(q) g_AL(q) with the gradients g of shape functions. This is
  /// the diagonal of the operator gather(), P_iK = S_i,KL H_iL, scatter().
  void add_diagonal(Index cell, const std::array<Tensor<Lanes>, D>& S, NodalVector* sum) const {
    if constexpr (D == 2)
      if (!odd.empty()) return add_folded_diagonal(*this, cell, S, sum);
    const Lanes* xi = point.data() + static_cast<std::size_t>(cell) * D;
    for_entries(cell, Prefetch::first, [&](Index A, const std::array<Lanes, D>& coefficients) {
      std::array<Lanes, D> g;
      for (int K = 0; K < D; ++K) {
        const Real* moment = detail::components(at(coefficients, K));
        at(g, K) = Lanes(moment[0]);
        for (int M = 0; M < D; ++M) at(g, K) += moment[M + 1] * xi[M];
      }
      add_squares<D>(S, g, sum[A]);
    });
  }

  template <class Body>
  ChunkSums chunk_sums(const Body& body) const {
    return body.chunk_sums(start, particle);
  }
  Offset pairs() const { return start.back(); }
  std::size_t bytes() const {
    return start.size() * sizeof(Offset) + particle.size() * sizeof(Index) +
           (coefficient.size() + odd.size() + point.size()) * sizeof(Lanes) +
           volume.size() * sizeof(Real);
  }

 private:
  static constexpr std::ptrdiff_t line = 64;  // bytes of a part of the coefficients of an entry

  /// Calls work(particle, coefficients[K]) for the entries of a row.
  template <class F>
  [[gnu::always_inline]] void for_entries(Index cell, Prefetch part, F&& work) const {
    const Offset first = at(start, cell), next = at(start, cell + 1);
    const Index* A = particle.data() + first;
    const Index* const end = particle.data() + next;
    const Lanes* g = coefficient.data() + first * D;
    const char* ahead = reinterpret_cast<const char*>(coefficient.data() + next * D) +
                        (part == Prefetch::second ? (end - A) * line : 0);
    const std::ptrdiff_t bytes =
        part == Prefetch::whole ? D * static_cast<std::ptrdiff_t>(sizeof(Lanes)) : line;
    for (; A != end; ++A, g += D, ahead += bytes) {
      prefetch(ahead);
      if (part == Prefetch::whole) prefetch(ahead + line);
      std::array<Lanes, D> here;
      for (int K = 0; K < D; ++K) at(here, K) = in_register(g[K]);
      work(*A, here);
    }
  }
};

/// Quadrature points with gradients of shape functions: Gauss points, or the particles themselves.
/// A group has `per_group` consecutive points (one if neighbouring points have different material
/// parameters). In a body of revolution, H_22 = u_0 / X_0, see CellRule.
template <int D>
struct PointRule {
  static constexpr Index most_per_group = 4;

  PointRows<D> rows;               ///< gradients; those of other ranks may be empty
  std::vector<Real> point_weight;  ///< [point]: reference volume
  std::vector<Index> point_owner;  ///< [point]: nearest particle, for messages and output
  Index per_group = most_per_group;

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

  [[gnu::always_inline]] void gather(Index group, const NodalVector* field,
                                     Tensor<Lanes>& H) const {
    if constexpr (D == 2)
      if (rows.folded) return gather_folded(*this, group, field, H);
    H = Tensor<Lanes>::zero();
    for (int lane = 0; lane < count(group); ++lane) {
      const auto column = gradient_at(rows, group * per_group + lane, field);
      for (int K = 0; K < D; ++K)
        for (int i = 0; i < D; ++i) H(i, K).set(lane, at(column, K)[i]);
    }
  }

  [[gnu::always_inline]] void scatter(Index group, const Tensor<Lanes>& P,
                                      NodalVector* force) const {
    if constexpr (D == 2)
      if (rows.folded) return scatter_folded(*this, group, P, force);
    std::array<Lanes, 4> column[D];
    for (int K = 0; K < D; ++K) column[K] = by_lane(P(0, K), P(1, K), P(2, K));
    const std::ptrdiff_t ahead = distance_to_next(group);
    for (int lane = 0; lane < count(group); ++lane) {
      const Index q = group * per_group + lane;
      const Real* g = rows.gradient.data() + at(rows.start, q) * D;
      const Index* A = rows.particle.data() + at(rows.start, q);
      const Index* const end = rows.particle.data() + at(rows.start, q + 1);
      for (; A != end; ++A, g += D) {
        __builtin_prefetch(g + ahead);
        Lanes f = at(column[0], lane) * g[0];
        for (int K = 1; K < D; ++K) f += at(column[K], lane) * g[K];
        force[*A] += f;
      }
    }
  }

  /// See CellRule::add_diagonal().
  void add_diagonal(Index group, const std::array<Tensor<Lanes>, D>& S, NodalVector* sum) const {
    if constexpr (D == 2)
      if (rows.folded) return add_folded_diagonal(*this, group, S, sum);
    for (int lane = 0; lane < count(group); ++lane) {
      const Index q = group * per_group + lane;
      for (Offset e = at(rows.start, q); e < at(rows.start, q + 1); ++e) {
        std::array<Lanes, D> g;
        for (int K = 0; K < D; ++K) {
          at(g, K) = Lanes::zero();
          at(g, K).set(lane, at(rows.gradient, e * D + K));
        }
        add_squares<D>(S, g, sum[at(rows.particle, e)]);
      }
    }
  }

  Offset pairs() const { return rows.entries(); }
  template <class Body>
  ChunkSums chunk_sums(const Body& body) const {
    // Each group counts as one row.
    std::vector<Offset> group_start;
    for (Index g = 0; g < groups(); ++g) group_start.push_back(at(rows.start, g * per_group));
    group_start.push_back(rows.entries());
    return body.chunk_sums(group_start, rows.particle);
  }
  std::size_t bytes() const {
    return rows.bytes() + point_weight.size() * sizeof(Real) + point_owner.size() * sizeof(Index);
  }

  /// Number of points of a group.
  int count(Index group) const { return std::min(per_group, rows.size() - group * per_group); }

 private:
  // scatter() reads the gradients of a group from cache, and prefetches the gradients of the next
  // group.
  std::ptrdiff_t distance_to_next(Index group) const {
    const Index first = group * per_group;
    return (at(rows.start, first + count(group)) - at(rows.start, first)) * D;
  }
};

}  // namespace meniscus
