// SPDX-License-Identifier: BSD-3-Clause
// Integrals of shape functions over nodal cells and through their facets, each of which is computed
// once for the two cells that share it (RKPM note 5.6).
#pragma once
#include "meniscus/body/body.hpp"
#include "meniscus/core/divided.hpp"

#include <array>
#include <span>
#include <vector>

namespace meniscus {

/// Integral of N over the cell.
struct VolumeIntegral {
  Real value = 0;
  void add(Lanes N, const std::array<Real, 4>& w) {
    value += sum(N * Lanes(w[0], w[1], w[2], w[3]));
  }
};

/// Integrals of N n_K (1, X - Xf) over facets, which is also the weight at a point: lane 0 the
/// moment of order 0, lanes 1 + Q those of order 1.
template <int D>
struct Flux {
  std::array<Lanes, D> moment{};
  Flux() = default;
  Flux(const Vec<D>& n_dA, const Vec<D>& arm) {
    const Lanes one_and_X = with_one(arm);
    for (int K = 0; K < D; ++K) at(moment, K) = n_dA[K] * one_and_X;
  }
  bool is_zero() const {
    Lanes::Mask set{};
    for (const Lanes& m : moment) set |= m.v != 0.0;
    return !any(set);
  }
  void add(Lanes N, const std::array<Flux, 4>& weight) {
    for (int lane = 0; lane < 4; ++lane)
      for (int K = 0; K < D; ++K) at(moment, K) += N[lane] * at(at(weight, lane).moment, K);
  }
  void add(Real N, const Flux& weight) {
    for (int K = 0; K < D; ++K) at(moment, K) += N * at(weight.moment, K);
  }
  /// Adds `sign` times another one, whose arms begin at Xf + arm; `from_centre`: (0, arm).
  void add_moved(const Flux& other, Lanes from_centre, Real sign) {
    for (int K = 0; K < D; ++K) {
      const Lanes& m = at(other.moment, K);
      at(moment, K) += sign * (m + m[0] * from_centre);
    }
  }

  static Lanes with_zero(const Vec<D>& arm) {
    Lanes lanes = Lanes::zero();
    for (int Q = 0; Q < D; ++Q) lanes.set(1 + Q, arm[Q]);
    return lanes;
  }
  static Lanes with_one(const Vec<D>& arm) {
    Lanes lanes = with_zero(arm);
    lanes.set(0, 1);
    return lanes;
  }
};

/// Integrals over the facet between two nodal cells, seen from the one of lower number.
template <int D>
struct SharedFlux {
  Index neighbor;
  Vec<D> centre;  ///< where the arms begin
  std::vector<Index> particle;
  std::vector<Flux<D>> flux;
};

/// What one nodal cell gets and gives away: the integrals over its volume, over the facets that no
/// cell before it in its block has, and of these over those that it shares with cells after it in
/// the block.
template <int D>
struct CellIntegrals {
  std::vector<Candidate<D>> candidates;
  std::vector<VolumeIntegral> volume;  // [candidate]
  std::vector<Flux<D>> flux;           // [candidate], arms from the centroid
  std::vector<SharedFlux<D>> shared;
};

/// Cells that follow each other are mostly near each other, and then share a search.
constexpr Index most_in_group = 8;

/// Of at most `most_in_group` cells of a block; `own` [cell - begin of the block]. Throws
/// SolveError where shape functions cannot be determined.
template <int D>
void integrate_cells(const Body<D>& body, OwnItems cells, OwnItems block,
                     std::span<CellIntegrals<D>> own);

}  // namespace meniscus
