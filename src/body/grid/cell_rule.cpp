// SPDX-License-Identifier: BSD-3-Clause
// Builds the quadrature rule of nodal cells with linear moments: integrals of shape functions over
// cells and facets give its rows (RKPM note 5.6).
#include "body/body.hpp"
#include "body/grid/cell_integrals.hpp"
#include "body/grid/folded_cells.hpp"
#include "body/sums_over_ranks.hpp"
#include "meniscus/error.hpp"
#include "numbers/dense.hpp"

#include <algorithm>

namespace meniscus {
namespace {

/// One row of the cell rule, before it is packed.
template <int D>
struct CellRow {
  struct Entry {
    Index particle;
    Real integral = 0;
    Flux<D> flux;
  };
  std::vector<Entry> entries;                  // by ascending particle
  std::vector<std::array<Lanes, D>> gradient;  // [entry][K]: (a_K, B_K.)
};

/// Adds to a row the fluxes through facets that the cell shares with earlier cells of its block,
/// where they were computed. Particles that are new to the row are appended.
template <int D>
void add_lower_facets(const Body<D>& body, Index cell, std::span<const CellIntegrals<D>> block,
                      Index first, CellRow<D>& row) {
  thread_local std::vector<Index> slot;  // [particle] number of its entry; -1: no entry yet
  thread_local std::vector<Index> lower;
  slot.resize(std::max(slot.size(), body.particles.X().size()), -1);
  for (std::size_t e = 0; e < row.entries.size(); ++e)
    at(slot, row.entries[e].particle) = static_cast<Index>(e);
  body.cells.lower_neighbors(cell, lower);
  for (const Index neighbor : lower) {
    if (neighbor < first) continue;
    for (const SharedFlux<D>& facet : at(block, neighbor - first).shared) {
      if (facet.neighbor != cell) continue;
      const Lanes arm = Flux<D>::with_zero(facet.centre - body.cells.centroid(cell));
      for (std::size_t k = 0; k < facet.particle.size(); ++k) {
        Index& s = at(slot, facet.particle[k]);
        if (s < 0) {
          s = static_cast<Index>(row.entries.size());
          row.entries.push_back({facet.particle[k], 0, {}});
        }
        at(row.entries, s).flux.add_moved(facet.flux[k], arm, -1);
      }
    }
  }
  for (const auto& e : row.entries) at(slot, e.particle) = -1;
}

/// Flux integrals of one nodal cell: a_K = (1/V) oint N n_K,
/// B_KM = [oint N n_K (X - Xb)_Q - delta_KQ int N] (V S)^-1_QM. `block`: integrals of the cells
/// from `first` on.
template <int D>
void assemble_row(const Body<D>& body, Index cell, std::span<const CellIntegrals<D>> block,
                  Index first, CellRow<D>& row) {
  const CellIntegrals<D>& own = at(block, cell - first);
  row.entries.clear();
  for (std::size_t k = 0; k < own.candidates.size(); ++k)
    row.entries.push_back({own.candidates[k].particle, own.volume[k].value, own.flux[k]});
  add_lower_facets(body, cell, block, first, row);
  std::erase_if(row.entries, [](const auto& e) { return e.integral == 0 && e.flux.is_zero(); });
  const auto by_particle = [](const auto& a, const auto& b) { return a.particle < b.particle; };
  if (!std::is_sorted(row.entries.begin(), row.entries.end(), by_particle))
    std::sort(row.entries.begin(), row.entries.end(), by_particle);

  const Real V = body.cells.volume(cell);
  const Mat<D> inverse_VS = inverse<D>(V * body.cells.covariance(cell));
  std::array<Lanes, D> inverse_row;
  for (int Q = 0; Q < D; ++Q) at(inverse_row, Q) = Flux<D>::with_zero(inverse_VS.row(Q));
  const Lanes inverse_V = Lanes(1 / V, 0, 0, 0);
  row.gradient.resize(row.entries.size());
  for (std::size_t k = 0; k < row.entries.size(); ++k) {
    const auto& [particle, integral, flux] = row.entries[k];
    for (int K = 0; K < D; ++K) {
      const Lanes& m = at(flux.moment, K);
      Lanes g = m[0] * inverse_V - integral * at(inverse_row, K);
      for (int Q = 0; Q < D; ++Q) g += m[1 + Q] * at(inverse_row, Q);
      at(row.gradient[k], K) = g;
    }
  }
}

/// Reserves memory for the entries of the rows of these cells. The number of entries is estimated
/// from above: some cells are sampled, and all particles whose supports reach the bounding sphere
/// of a sample are counted. Unused reserve occupies no memory, while growing an array would need
/// twice its memory for a moment.
template <int D>
void reserve_entries(const Body<D>& body, OwnItems cells, CellRule<D>& rule) {
  constexpr Index samples = 256;
  const Index step = (cells.end - cells.begin + samples - 1) / samples;
  std::vector<Candidate<D>> candidates;
  std::size_t entries = 0;
  for (Index cell = cells.begin + step / 2; cell < cells.end; cell += step) {
    const Real half_diagonal = std::sqrt(3 * body.cells.covariance(cell).trace());
    body.particles.candidates(body.cells.centroid(cell), half_diagonal, candidates);
    entries += candidates.size() * static_cast<std::size_t>(step);
  }
  rule.particle.reserve(entries);
  rule.coefficient.reserve(entries * D);
}

/// Vertices of the regular simplex with sum t = 0 and mean t t^T = I / D.
template <int D>
std::array<Vec<D>, D + 1> simplex() {
  if constexpr (D == 3) {
    const Real t = 1 / std::sqrt(3.0);
    return {Vec<3>(t, t, t), Vec<3>(t, -t, -t), Vec<3>(-t, t, -t), Vec<3>(-t, -t, t)};
  } else {
    const Real s = std::sqrt(0.75);
    return {Vec<2>(1, 0), Vec<2>(-0.5, s), Vec<2>(-0.5, -s)};
  }
}

/// Stress points xi_q = sqrt(D) S^(1/2) t_q, one lane per q. In 2D the fourth lane has weight zero;
/// it repeats the third point, so that its stress is finite if the stresses of the cell are.
template <int D>
std::array<Lanes, D> stress_points(const Mat<D>& S) {
  const Mat<D> root = square_root<D>(S);
  const auto t = simplex<D>();
  std::array<Lanes, D> xi;
  for (int q = 0; q < static_cast<int>(Lanes::width); ++q)
    for (int M = 0; M < D; ++M)
      at(xi, M).set(q, std::sqrt(Real(D)) * (root.row(M) * at(t, std::min(q, D))).value());
  return xi;
}

/// Appends rows to the rule.
template <int D>
void pack(std::span<const CellRow<D>> rows, CellRule<D>& rule) {
  const std::size_t first = rule.start.size() - 1;
  for (const CellRow<D>& row : rows)
    rule.start.push_back(rule.start.back() + static_cast<Offset>(row.entries.size()));
  rule.particle.resize(static_cast<std::size_t>(rule.start.back()));
  grow(rule.coefficient, static_cast<std::size_t>(rule.start.back()) * D);
  parallel_for(
      static_cast<Index>(rows.size()),
      [&](Index k) {
        const CellRow<D>& row = rows[static_cast<std::size_t>(k)];
        const Offset start = at(rule.start, first + static_cast<std::size_t>(k));
        Index* A = rule.particle.data() + start;
        Lanes* g = rule.coefficient.data() + start * D;
        for (std::size_t e = 0; e < row.entries.size(); ++e) {
          *A++ = row.entries[e].particle;
          g = std::copy(row.gradient[e].begin(), row.gradient[e].end(), g);
        }
      },
      8);
}

/// Makes the system provide the memory pages of the next `count` elements of an array, within its
/// reserve.
template <class T>
void take_pages_of_next(UnsetVector<T>& v, std::size_t count) {
  take_pages(v.data() + v.size(), std::min(count, v.capacity() - v.size()) * sizeof(T));
}

/// Sets the volumes and stress points of all cells; they take little memory compared with the rows.
template <int D>
void list_points(const Body<D>& body, CellRule<D>& rule) {
  rule.volume.resize(static_cast<std::size_t>(body.size()));
  rule.point.resize(rule.volume.size() * D);
  parallel_for(body.size(), [&](Index cell) {
    at(rule.volume, cell) = body.cells.volume(cell);
    const auto xi = stress_points<D>(body.cells.covariance(cell));
    std::copy(xi.begin(), xi.end(), rule.point.begin() + cell * D);
  });
}

/// Gives the cells after the last row empty rows.
template <int D>
void end_rows(const Body<D>& body, CellRule<D>& rule) {
  const std::size_t size = static_cast<std::size_t>(body.size()) + 1;
  rule.start.resize(size, rule.start.back());
}

/// Appends the rows of the given cells to a rule without rows. Facets shared within a block of
/// cells are computed once, and facets between blocks twice. Blocks do not depend on `cells`, so
/// the rows have the same bits on any number of ranks.
template <int D>
void append_rows(const Body<D>& body, OwnItems cells, CellRule<D>& rule,
                 SumsOverRanks& shape_integral) {
  rule.start.resize(static_cast<std::size_t>(cells.begin) + 1, 0);
  reserve_entries(body, cells, rule);
  // The integrals need several times the memory of their rows, and rows that are not packed yet
  // twice as much: small blocks keep both small.
  constexpr Index block = 512, packed_at_once = 64;
  std::vector<CellIntegrals<D>> integrals(static_cast<std::size_t>(std::min(block, body.size())));
  std::vector<CellRow<D>> rows(static_cast<std::size_t>(packed_at_once));
  // Expected number of elements of the next block: as many as the block before had; for the first
  // block, its share of the reserve.
  std::size_t taken = rule.coefficient.capacity() * static_cast<std::size_t>(block) /
                      static_cast<std::size_t>(std::max(block, cells.end - cells.begin));
  for (Index begin = cells.begin / block * block; begin < cells.end; begin += block) {
    const Index first = std::max(begin, cells.begin), end = std::min(begin + block, cells.end);
    const std::size_t filled = rule.coefficient.size();
    parallel_for((end - begin + most_in_group - 1) / most_in_group + 1,
                 [&](Index item) {
                   if (item == 0) return take_pages_of_next(rule.coefficient, taken);
                   const Index from = begin + (item - 1) * most_in_group;
                   integrate_cells<D>(body, {from, std::min(end, from + most_in_group)},
                                      {begin, begin + block}, integrals);
                 },
                 1);
    for (Index next = first; next < end; next += packed_at_once) {
      const Index count = std::min(packed_at_once, end - next);
      parallel_for(
          count, [&](Index k) { assemble_row<D>(body, next + k, integrals, begin, at(rows, k)); },
          4);
      for (Index k = 0; k < count; ++k)
        for (const auto& entry : at(rows, k).entries)
          shape_integral.add(entry.particle, entry.integral);
      pack<D>(std::span(rows).first(static_cast<std::size_t>(count)), rule);
    }
    taken = rule.coefficient.size() - filled;
  }
}

}  // namespace

template <int D>
CellRows<D>::CellRows(const Body<D>& body, OwnItems cells) : shape_integral(body.size()) {
  if constexpr (D == 2)
    if (body.geometry.grid.revolved) {
      append_folded_rows(body, cells, rule, shape_integral);
      return;
    }
  append_rows(body, cells, rule, shape_integral);
}

template <int D>
CellOperator<D> cell_rule_of(const Body<D>& body, CellRows<D> rows) {
  CellOperator<D> op{std::move(rows.rule), rows.shape_integral.of_all()};
  end_rows(body, op.rule);
  list_points(body, op.rule);
  return op;
}

template <int D>
CellOperator<D> build_cell_rule(const Body<D>& body, OwnItems cells) {
  std::optional<CellRows<D>> rows;
  on_each_rank([&] { rows.emplace(body, cells); });
  return cell_rule_of(body, std::move(*rows));
}

template <int D>
CellOperator<D> build_cell_rule(const Body<D>& body) {
  return build_cell_rule(body, body.division.own_rows(body.size()));
}

#define MENISCUS_INSTANTIATE(D)                                       \
  template struct CellRows<D>;                                        \
  template CellOperator<D> cell_rule_of(const Body<D>&, CellRows<D>); \
  template CellOperator<D> build_cell_rule(const Body<D>&);           \
  template CellOperator<D> build_cell_rule(const Body<D>&, OwnItems);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
