// SPDX-License-Identifier: BSD-3-Clause
// Integrals of shape functions over nodal cells and their facets. A facet is integrated once for
// the two cells that share it (RKPM note 5.6).
#pragma once
#include "body/body.hpp"
#include "parallel/divided.hpp"

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

/// Integrals of N n_K (1, X - Xf) over facets: lane 0 has the moment of order 0, lanes 1 + Q have
/// the moments of order 1. The same type holds the weight of a point.
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
  /// Adds `sign` times the integrals `other`, whose origin is Xf + arm; `from_centre` = (0, arm).
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

/// Integrals over the facet between two nodal cells, computed for the cell of lower number.
template <int D>
struct SharedFlux {
  Index neighbor;
  Vec<D> centre;  ///< origin of the moments
  std::vector<Index> particle;
  std::vector<Flux<D>> flux;
};

/// Integrals of one nodal cell: over its volume and over its facets, without facets shared with
/// lower cells of its block. `shared` has the integrals for higher cells of the block.
template <int D>
struct CellIntegrals {
  std::vector<Candidate<D>> candidates;
  std::vector<VolumeIntegral> volume;  // [candidate]
  std::vector<Flux<D>> flux;           // [candidate], origin at the centroid
  std::vector<SharedFlux<D>> shared;
};

/// Most cells in a group that shares one search. Cells with near numbers are mostly near each
/// other.
constexpr Index most_in_group = 8;

/// Computes own[cell - block.begin] for at most `most_in_group` cells of a block. Throws SolveError
/// if shape functions cannot be determined.
template <int D>
void integrate_cells(const Body<D>& body, OwnItems cells, OwnItems block,
                     std::span<CellIntegrals<D>> own);

}  // namespace meniscus
