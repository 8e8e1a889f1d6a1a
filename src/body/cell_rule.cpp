// SPDX-License-Identifier: BSD-3-Clause
// Building the rule of nodal cells with linear moments: integrals of shape functions over cells and
// over their facets, each of which is computed once for the two cells that share it (RKPM
// note 5.6).
#include "meniscus/body/body.hpp"
#include "meniscus/core/dense.hpp"
#include "meniscus/core/error.hpp"

#include <algorithm>
#include <tuple>

#include "rounded_rows.hpp"
#include "sums_over_ranks.hpp"

namespace meniscus {
namespace {

/// sum_k += sum_q weight_q N_k(x_q) for all candidates k. Points come in fours that are close
/// together; candidates that reach none of the four are left out.
template <int D, class Weight, class Sum>
void add_integrals(const Body<D>& body, std::span<const Vec<D>> points,
                   std::span<const Weight> weight, std::span<const Candidate<D>> candidates,
                   std::vector<Sum>& integral) {
  thread_local ReproducingKernel<D> kernel(body.particles.window());  // keeps its buffers
  thread_local std::vector<Candidate<D>> near;
  thread_local std::vector<std::size_t> number;
  kernel.use(body.particles.window());
  for (std::size_t q = 0; q < points.size(); q += 4) {
    std::array<Vec<D>, 4> batch;  // the last point fills up, with weight zero
    std::array<Weight, 4> batch_weight{};
    for (std::size_t lane = 0; lane < 4; ++lane) {
      batch[lane] = points[std::min(q + lane, points.size() - 1)];
      if (q + lane < points.size()) batch_weight[lane] = weight[q + lane];
    }
    const auto places = body.particles.kernel_places(batch);
    select_near<D>(places, candidates, near, number);
    kernel.evaluate(places, near, Derivatives::none);
    for (std::size_t lane = 0; lane < 4; ++lane)
      body.particles.require_quality(kernel.quality()[static_cast<int>(lane)], batch[lane],
                                     body.name);
    for (std::size_t k = 0; k < near.size(); ++k)
      integral[number[k]].add(kernel.value(k), batch_weight);
  }
}

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

/// Functions of a batch: moments 0 and 1 of n_K.
template <int D>
constexpr std::size_t functional_count = D*(1 + D);

/// Adds what the samples miss of the integrals of polynomials, by functions that reproduce it: to
/// the volume and to facets, four at a time (RKPM note 5.6).
template <int D>
class MissingMoments {
 public:
  MissingMoments(const Body<D>& body, Index cell, const CellSamples<D>& samples)
      : body_(body), cell_(cell), samples_(samples) {
    if (!samples.volume_exact) parts_.push_back(-1);
    for (std::size_t f = 0; f < samples.facets.size(); ++f)
      if (!samples.facets[f].exact) parts_.push_back(static_cast<int>(f));
  }

  void add(std::span<const Candidate<D>> candidates, std::vector<VolumeIntegral>& volume,
           std::vector<std::vector<Flux<D>>>& facets) {
    for (std::size_t first = 0; first < parts_.size(); first += 4)
      add_four(std::span(parts_).subspan(first, std::min<std::size_t>(4, parts_.size() - first)),
               candidates, volume, facets);
  }

 private:
  using Kernel = ReproducingKernel<D>;
  static constexpr int volume_part = -1;

  const Vec<D>& centre(int part) const {
    return part == volume_part ? body_.cells.centroid(cell_) : at(samples_.facets, part).centre;
  }

  void add_four(std::span<const int> parts, std::span<const Candidate<D>> candidates,
                std::vector<VolumeIntegral>& volume, std::vector<std::vector<Flux<D>>>& facets) {
    thread_local Kernel kernel(body_.particles.window());
    thread_local std::vector<Candidate<D>> near;
    thread_local std::vector<std::size_t> number;
    kernel.use(body_.particles.window());
    std::array<Vec<D>, 4> centres;
    for (std::size_t lane = 0; lane < 4; ++lane)
      centres[lane] = centre(parts[std::min(lane, parts.size() - 1)]);
    const auto places = body_.particles.kernel_places(centres);
    select_near<D>(places, candidates, near, number);
    kernel.evaluate(places, near, Derivatives::none);
    std::array<typename Kernel::BasisVector, functional_count<D>> right;
    for (auto& b : right) b.fill(Lanes::zero());
    for (std::size_t lane = 0; lane < parts.size(); ++lane) {
      body_.particles.require_quality(kernel.quality()[static_cast<int>(lane)], centres[lane],
                                      body_.name);
      fill(parts[lane], kernel.scale(), static_cast<int>(lane), right);
    }
    kernel.evaluate_functionals(right);
    for (std::size_t lane = 0; lane < parts.size(); ++lane)
      for (std::size_t k = 0; k < near.size(); ++k) {
        const auto amount = [&](std::size_t j) {
          return kernel.functional(k, j)[static_cast<int>(lane)];
        };
        if (parts[lane] == volume_part) {
          volume[number[k]].value += amount(0);
          continue;
        }
        Flux<D>& flux = at(facets, parts[lane])[number[k]];
        for (std::size_t K = 0; K < D; ++K) {
          Lanes more = Lanes::zero();
          for (std::size_t o = 0; o <= D; ++o)
            more.set(static_cast<int>(o), amount(K * (D + 1) + o));
          flux.moment[K] += more;
        }
      }
  }

  /// Right-hand sides of one lane.
  void fill(int part, Real H, int lane,
            std::array<typename Kernel::BasisVector, functional_count<D>>& right) const {
    if (part == volume_part) {
      set(samples_.volume_missing, H, lane, right[0]);
      return;
    }
    static constexpr auto multiple = monomial_multiples<D, 2>();
    for (std::size_t K = 0; K < D; ++K) {
      const auto& missing = at(samples_.facets, part).missing[K];
      typename CellSamples<D>::template Missing<2> moment;
      std::copy_n(missing.begin(), moment.size(), moment.begin());
      set(moment, H, lane, right[K * (D + 1)]);
      for (std::size_t Q = 0; Q < D; ++Q) {
        for (std::size_t m = 0; m < moment.size(); ++m) moment[m] = at(missing, multiple[m][Q]);
        set(moment, H, lane, right[K * (D + 1) + 1 + Q]);
      }
    }
  }

  /// Moments of X - centre as those of its kernel place over H.
  void set(const typename CellSamples<D>::template Missing<2>& moment, Real H, int lane,
           typename Kernel::BasisVector& b) const {
    Mat<D> T = body_.particles.pressed() ? *body_.particles.pressed() : Mat<D>::Identity();
    T /= H;
    Vec<D> first;
    Mat<D> second;
    for (int i = 0; i < D; ++i) {
      first[i] = at(moment, 1 + i);
      for (int j = 0; j < D; ++j) second(i, j) = at(moment, 1 + D + hessian_index(D, i, j));
    }
    first = T * first;
    second = T * second * T.transpose();
    b[0].set(lane, moment[0]);
    for (int i = 0; i < D; ++i) {
      at(b, 1 + i).set(lane, first[i]);
      for (int j = i; j < D; ++j) at(b, 1 + D + hessian_index(D, i, j)).set(lane, second(i, j));
    }
  }

  const Body<D>& body_;
  Index cell_;
  const CellSamples<D>& samples_;
  std::vector<int> parts_;  // facets, or the volume
};

/// Fluxes through the facets with these points.
template <int D>
void integrate_fluxes(const Body<D>& body, std::span<const Vec<D>> X, std::span<const Vec<D>> dA,
                      const Vec<D>& centre, std::span<const Candidate<D>> candidates,
                      std::vector<Flux<D>>& flux) {
  thread_local std::vector<Flux<D>> weight;
  weight.clear();
  for (std::size_t q = 0; q < X.size(); ++q) weight.emplace_back(dA[q], X[q] - centre);
  flux.assign(candidates.size(), {});
  add_integrals<D, Flux<D>>(body, X, weight, candidates, flux);
}

/// The integrals through a facet that are not zero, for the cell on its other side.
template <int D>
void pack_shared(const typename CellSamples<D>::SharedFacet& facet,
                 std::span<const Candidate<D>> candidates, std::span<const Flux<D>> flux,
                 SharedFlux<D>& packed) {
  packed.neighbor = facet.neighbor;
  packed.centre = facet.centre;
  packed.particle.clear();
  packed.flux.clear();
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    if (flux[k].is_zero()) continue;
    packed.particle.push_back(candidates[k].particle);
    packed.flux.push_back(flux[k]);
  }
}

/// Integrals over the samples of a cell, its volume and facets.
template <int D>
void integrate_samples(const Body<D>& body, Index cell, const CellSamples<D>& samples,
                       OwnItems block, CellIntegrals<D>& own) {
  own.volume.assign(own.candidates.size(), {});
  add_integrals<D, Real>(body, samples.volume_X, samples.volume_w, own.candidates, own.volume);
  thread_local std::vector<std::vector<Flux<D>>> facets;
  facets.resize(samples.facets.size());
  for (std::size_t f = 0; f < facets.size(); ++f) {
    const auto& facet = samples.facets[f];
    const std::size_t count = facet.end - facet.begin;
    integrate_fluxes<D>(body, std::span(samples.facet_X).subspan(facet.begin, count),
                        std::span(samples.facet_dA).subspan(facet.begin, count), facet.centre,
                        own.candidates, facets[f]);
  }
  MissingMoments<D>(body, cell, samples).add(own.candidates, own.volume, facets);

  std::size_t shared = 0;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    const auto& facet = samples.facets[f];
    const Lanes arm = Flux<D>::with_zero(facet.centre - body.cells.centroid(cell));
    for (std::size_t k = 0; k < own.candidates.size(); ++k)
      own.flux[k].add_moved(facets[f][k], arm, 1);
    if (facet.neighbor < cell || facet.neighbor >= block.end) continue;
    if (shared == own.shared.size()) own.shared.emplace_back();
    pack_shared<D>(facet, own.candidates, facets[f], own.shared[shared++]);
  }
  own.shared.resize(shared);
}

template <int D>
Real reach(std::span<const Vec<D>> points, const Vec<D>& centre) {
  Real radius = 0;
  for (const Vec<D>& x : points) radius = std::max(radius, (x - centre).norm());
  return radius * (1 + 1e-12);
}

/// What a nodal cell is integrated with.
template <int D>
struct SampledCell {
  CellSamples<D> samples;
  CellQuadrature<D> boundary;
  Real reach;  ///< of all points from the centroid
};

/// `first`: that of the cells whose integrals are computed along with this one's.
template <int D>
void sample(const Body<D>& body, Index cell, Index first, SampledCell<D>& sampled) {
  body.cells.sample(cell, first, body.particles, sampled.samples);
  body.cells.boundary_points(cell, sampled.boundary);
  const Vec<D>& centroid = body.cells.centroid(cell);
  sampled.reach = std::max({reach<D>(sampled.samples.volume_X, centroid),
                            reach<D>(sampled.samples.facet_X, centroid),
                            reach<D>(sampled.boundary.facet_X, centroid)});
}

/// Cells that follow each other are mostly near each other, and then share a search.
constexpr Index most_in_group = 8;

/// The end of the group that begins with the first of these cells, and the mean of its centroids.
template <int D>
std::pair<Index, Vec<D>> group_of(const Body<D>& body, OwnItems cells) {
  const Vec<D>& first = body.cells.centroid(cells.begin);
  const Real near = at(body.particles.support(), cells.begin);
  Vec<D> sum = first;
  Index end = cells.begin + 1;
  for (; end < cells.end; ++end) {
    const Vec<D>& centroid = body.cells.centroid(end);
    if ((centroid - first).squaredNorm() > near * near) break;
    sum += centroid;
  }
  return {end, sum / (end - cells.begin)};
}

/// At most `most_in_group` cells of the block; `own` [cell - begin of the block].
template <int D>
void integrate_cells(const Body<D>& body, OwnItems cells, OwnItems block,
                     std::span<CellIntegrals<D>> own) {
  thread_local std::array<SampledCell<D>, most_in_group> sampled;
  thread_local std::vector<Candidate<D>> around;
  for (Index begin = cells.begin, end; begin < cells.end; begin = end) {
    Vec<D> centre;
    std::tie(end, centre) = group_of(body, {begin, cells.end});
    Real radius = 0;
    for (Index cell = begin; cell < end; ++cell) {
      sample(body, cell, block.begin, at(sampled, cell - begin));
      radius = std::max(
          radius, (body.cells.centroid(cell) - centre).norm() + at(sampled, cell - begin).reach);
    }
    body.particles.candidates(centre, radius * (1 + 1e-12), around);
    for (Index cell = begin; cell < end; ++cell) {
      const auto& [samples, boundary, reach] = at(sampled, cell - begin);
      CellIntegrals<D>& of_cell = at(own, cell - block.begin);
      const Vec<D>& centroid = body.cells.centroid(cell);
      body.particles.candidates(centroid, reach, around, of_cell.candidates);
      integrate_fluxes<D>(body, boundary.facet_X, boundary.facet_dA, centroid, of_cell.candidates,
                          of_cell.flux);
      integrate_samples<D>(body, cell, samples, block, of_cell);
    }
  }
}

/// One row of the cell rule, before it is packed.
template <int D>
struct CellRow {
  struct Entry {
    Index particle;
    Real integral = 0;
    Flux<D> flux;
  };
  std::vector<Entry> entries;                  // by ascending particle
  std::vector<Index> particle;                 // in the order in which they are packed
  std::vector<std::array<Lanes, D>> gradient;  // likewise, [K]: (a_K, B_K.)
  std::size_t exact = 0;                       // how many of them stay in double
};

/// Adds to a row what facets of cells before it in its block have of it. Particles that are new to
/// the row come behind the others.
template <int D>
void add_lower_facets(const Body<D>& body, Index cell, std::span<const CellIntegrals<D>> block,
                      Index first, CellRow<D>& row) {
  thread_local std::vector<Index> slot;  // [particle] its entry; -1: none yet
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

/// For more entries than the rows of these cells have, by the particles that reach boxes like some
/// of the cells: what is not filled takes no memory, but growing would take twice as much for a
/// moment.
template <int D>
void reserve_entries(const Body<D>& body, OwnItems cells, RowPrecision precision,
                     CellRule<D>& rule) {
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
  if (precision == RowPrecision::full)
    rule.coefficient.reserve(entries * D);
  else
    rule.rounded.reserve(entries * D);
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

/// xi_q = sqrt(D) S^(1/2) t_q, a lane per q.
template <int D>
std::array<Lanes, D> stress_points(const Mat<D>& S) {
  const Mat<D> root = square_root<D>(S);
  const auto t = simplex<D>();
  std::array<Lanes, D> xi;
  xi.fill(Lanes::zero());
  for (int q = 0; q <= D; ++q)
    for (int M = 0; M < D; ++M)
      at(xi, M).set(q, std::sqrt(Real(D)) * (root.row(M) * at(t, q)).value());
  return xi;
}

/// Orders the entries of a row as they are packed and rounded.
template <int D>
void order_row(const Body<D>& body, Index cell, RowPrecision precision, CellRow<D>& row) {
  row.particle.clear();
  for (const auto& entry : row.entries) row.particle.push_back(entry.particle);
  row.exact = precision == RowPrecision::full
                  ? row.particle.size()
                  : make_up_for_rounding<D>(body.particles.X(), body.cells.centroid(cell),
                                            row.particle, row.gradient);
}

/// Appends rows to the rule.
template <int D>
void pack(std::span<const CellRow<D>> rows, CellRule<D>& rule) {
  const std::size_t first = rule.start.size() - 1;
  for (const CellRow<D>& row : rows) {
    rule.start.push_back(rule.start.back() + static_cast<Offset>(row.particle.size()));
    rule.double_start.push_back(rule.double_start.back() + static_cast<Offset>(row.exact));
  }
  rule.particle.resize(static_cast<std::size_t>(rule.start.back()));
  grow(rule.coefficient, static_cast<std::size_t>(rule.double_start.back()) * D);
  grow(rule.rounded, static_cast<std::size_t>(rule.start.back() - rule.double_start.back()) * D);
  parallel_for(static_cast<Index>(rows.size()), [&](Index k) {
    const CellRow<D>& row = rows[static_cast<std::size_t>(k)];
    const Offset start = at(rule.start, first + static_cast<std::size_t>(k)),
                 double_start = at(rule.double_start, first + static_cast<std::size_t>(k));
    std::copy(row.particle.begin(), row.particle.end(), rule.particle.begin() + start);
    Lanes* g = rule.coefficient.data() + double_start * D;
    SingleLanes* r = rule.rounded.data() + (start - double_start) * D;
    for (std::size_t e = 0; e < row.particle.size(); ++e)
      for (const Lanes& x : row.gradient[e])
        if (e < row.exact)
          *g++ = x;
        else
          *r++ = SingleLanes::rounded(x);
  });
}

/// Volumes and stress points of all cells: little beside their rows.
template <int D>
void list_points(const Body<D>& body, CellRule<D>& rule) {
  for (Index cell = 0; cell < body.size(); ++cell) {
    rule.volume.push_back(body.cells.volume(cell));
    for (const Lanes& xi : stress_points<D>(body.cells.covariance(cell))) rule.point.push_back(xi);
  }
}

/// Makes the rows of all other cells empty.
template <int D>
void end_rows(const Body<D>& body, CellRule<D>& rule) {
  const std::size_t size = static_cast<std::size_t>(body.size()) + 1;
  rule.start.resize(size, rule.start.back());
  rule.double_start.resize(size, rule.double_start.back());
}

/// Appends rows to a rule that has none. What cells share within a block is computed once, and what
/// they share with others twice, for whatever cells the rows are asked: so rows do not depend on
/// that to the last bit.
template <int D>
void append_rows(const Body<D>& body, OwnItems cells, RowPrecision precision, CellRule<D>& rule,
                 SumsOverRanks& shape_integral) {
  rule.start.resize(static_cast<std::size_t>(cells.begin) + 1, 0);
  rule.double_start.resize(rule.start.size(), 0);
  reserve_entries(body, cells, precision, rule);
  constexpr Index block = 512;  // what rows are made of takes several times their memory
  std::vector<CellIntegrals<D>> integrals(static_cast<std::size_t>(std::min(block, body.size())));
  std::vector<CellRow<D>> rows(integrals.size());
  for (Index begin = cells.begin / block * block; begin < cells.end; begin += block) {
    const Index first = std::max(begin, cells.begin), end = std::min(begin + block, cells.end);
    parallel_for((end - begin + most_in_group - 1) / most_in_group,
                 [&](Index group) {
                   const Index from = begin + group * most_in_group;
                   integrate_cells<D>(body, {from, std::min(end, from + most_in_group)},
                                      {begin, begin + block}, integrals);
                 },
                 1);
    parallel_for(
        end - first,
        [&](Index k) {
          assemble_row<D>(body, first + k, integrals, begin, at(rows, k));
          order_row(body, first + k, precision, at(rows, k));
        },
        4);
    for (Index k = 0; k < end - first; ++k)
      for (const auto& entry : at(rows, k).entries)
        shape_integral.add(entry.particle, entry.integral);
    pack<D>(std::span(rows).first(static_cast<std::size_t>(end - first)), rule);
  }
}

}  // namespace

template <int D>
CellOperator<D> build_cell_rule(const Body<D>& body, RowPrecision precision, OwnItems cells) {
  CellOperator<D> op;
  SumsOverRanks shape_integral(body.size());
  on_each_rank([&] { append_rows(body, cells, precision, op.rule, shape_integral); });
  end_rows(body, op.rule);
  list_points(body, op.rule);
  op.shape_integral = shape_integral.of_all();
  return op;
}

template <int D>
CellOperator<D> build_cell_rule(const Body<D>& body, RowPrecision precision) {
  return build_cell_rule(body, precision, own_rows(body.size()));
}

#define MENISCUS_INSTANTIATE(D)                                           \
  template CellOperator<D> build_cell_rule(const Body<D>&, RowPrecision); \
  template CellOperator<D> build_cell_rule(const Body<D>&, RowPrecision, OwnItems);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
