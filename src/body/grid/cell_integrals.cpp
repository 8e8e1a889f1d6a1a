// SPDX-License-Identifier: BSD-3-Clause
// Integrals over the samples of cells and facets, and corrections that make them exact for
// polynomials.
#include "body/grid/cell_integrals.hpp"

#include "kernel/near_candidates.hpp"

#include <algorithm>
#include <tuple>

namespace meniscus {
namespace {

/// Calls f(first, kernel) for each group of four near points, with the number `first` of its first
/// point. The kernel has the values at these points of the candidates that reach one of them.
template <int D, class F>
void for_fours(const Body<D>& body, std::span<const Vec<D>> points, NearCandidates<D>& candidates,
               F&& f) {
  thread_local ReproducingKernel<D> kernel(body.particles.kernel_function());  // keeps its buffers
  kernel.use(body.particles.kernel_function());
  for (std::size_t first = 0; first < points.size(); first += 4) {
    std::array<Vec<D>, 4> four;  // unused lanes repeat the last point
    for (std::size_t lane = 0; lane < 4; ++lane)
      four[lane] = points[std::min(first + lane, points.size() - 1)];
    const auto places = body.particles.kernel_places(four);
    candidates.select(places);
    kernel.evaluate(places, candidates.near(), Derivatives::none);
    for (std::size_t lane = 0; lane < 4; ++lane)
      body.particles.require_quality(kernel.quality()[static_cast<int>(lane)], four[lane],
                                     body.name);
    f(first, kernel);
  }
}

/// sum_k += sum_q weight_q N_k(x_q) over the lanes q, for the near candidates k.
template <int D, class Weight, class Sum>
void add_four(const ReproducingKernel<D>& kernel, const NearCandidates<D>& candidates,
              const std::array<Weight, 4>& weight, std::vector<Sum>& sum) {
  const auto numbers = candidates.numbers();
  for (std::size_t k = 0; k < numbers.size(); ++k) at(sum, numbers[k]).add(kernel.value(k), weight);
}

/// Number of functionals of a batch: moments 0 and 1 of each n_K.
template <int D>
constexpr std::size_t functional_count = D*(1 + D);

/// Adds the differences between exact integrals of polynomials and their sums over samples. They
/// are distributed to particles by reproducing functionals, for volume and facets in batches of
/// four (RKPM note 5.6).
template <int D>
class MissingMoments {
 public:
  MissingMoments(const Body<D>& body, Index cell, const CellSamples<D>& samples)
      : body_(body), cell_(cell), samples_(samples) {
    if (!samples.volume_exact) parts_.push_back(-1);
    for (std::size_t f = 0; f < samples.facets.size(); ++f)
      if (!samples.facets[f].exact) parts_.push_back(static_cast<int>(f));
  }

  void add(NearCandidates<D>& candidates, std::vector<VolumeIntegral>& volume,
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

  void add_four(std::span<const int> parts, NearCandidates<D>& candidates,
                std::vector<VolumeIntegral>& volume, std::vector<std::vector<Flux<D>>>& facets) {
    thread_local Kernel kernel(body_.particles.kernel_function());
    kernel.use(body_.particles.kernel_function());
    std::array<Vec<D>, 4> centres;
    for (std::size_t lane = 0; lane < 4; ++lane)
      centres[lane] = centre(parts[std::min(lane, parts.size() - 1)]);
    const auto places = body_.particles.kernel_places(centres);
    candidates.select(places);
    kernel.evaluate(places, candidates.near(), Derivatives::none);
    std::array<typename Kernel::BasisVector, functional_count<D>> right;
    for (auto& b : right) b.fill(Lanes::zero());
    for (std::size_t lane = 0; lane < parts.size(); ++lane) {
      body_.particles.require_quality(kernel.quality()[static_cast<int>(lane)], centres[lane],
                                      body_.name);
      fill(parts[lane], kernel.scale(), static_cast<int>(lane), right);
    }
    kernel.evaluate_functionals(right);
    const auto numbers = candidates.numbers();
    for (std::size_t lane = 0; lane < parts.size(); ++lane)
      for (std::size_t k = 0; k < numbers.size(); ++k) {
        const auto amount = [&](std::size_t j) {
          return kernel.functional(k, j)[static_cast<int>(lane)];
        };
        if (parts[lane] == volume_part) {
          at(volume, numbers[k]).value += amount(0);
          continue;
        }
        Flux<D>& flux = at(at(facets, parts[lane]), numbers[k]);
        for (std::size_t K = 0; K < D; ++K) {
          Lanes more = Lanes::zero();
          for (std::size_t o = 0; o <= D; ++o)
            more.set(static_cast<int>(o), amount(K * (D + 1) + o));
          flux.moment[K] += more;
        }
      }
  }

  /// Sets the right-hand sides of one lane.
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

  /// Transforms moments of X - centre to moments of kernel places, in units of H.
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
  std::vector<int> parts_;  // numbers of facets, or volume_part
};

/// Fluxes through the facets, given by their points X and normals times weights dA.
template <int D>
void integrate_fluxes(const Body<D>& body, std::span<const Vec<D>> X, std::span<const Vec<D>> dA,
                      const Vec<D>& centre, NearCandidates<D>& candidates,
                      std::vector<Flux<D>>& flux) {
  flux.assign(candidates.all().size(), {});
  for_fours<D>(body, X, candidates, [&](std::size_t first, const ReproducingKernel<D>& kernel) {
    std::array<Flux<D>, 4> weight{};
    for (std::size_t lane = 0; lane < 4 && first + lane < X.size(); ++lane)
      weight[lane] = Flux<D>(dA[first + lane], X[first + lane] - centre);
    add_four<D>(kernel, candidates, weight, flux);
  });
}

/// Adds the points of a facet that are in the group of four that begins with `first`. Begins with
/// facet point `next`, which is advanced.
template <int D>
void add_facet_points(const CellSamples<D>& samples, const typename CellSamples<D>::Facet& facet,
                      std::size_t first, const ReproducingKernel<D>& kernel,
                      const NearCandidates<D>& candidates, std::size_t& next,
                      std::vector<Flux<D>>& flux) {
  std::array<Flux<D>, 4> weight;
  std::array<int, 4> lane{};
  std::size_t count = 0;
  for (; next < facet.end && samples.facet_points[next].number < first + 4; ++next, ++count) {
    const auto& [number, dA] = samples.facet_points[next];
    lane[count] = static_cast<int>(number - first);
    weight[count] = Flux<D>(dA, samples.X[number] - facet.centre);
  }
  if (count == 4) return add_four<D>(kernel, candidates, weight, flux);
  const auto numbers = candidates.numbers();
  for (std::size_t p = 0; p < count; ++p)
    for (std::size_t k = 0; k < numbers.size(); ++k)
      at(flux, numbers[k]).add(kernel.value(k)[lane[p]], weight[p]);
}

/// Integrals over the volume and the facets of a cell. Each point is evaluated once for all of
/// them.
template <int D>
void add_integrals(const Body<D>& body, const CellSamples<D>& samples,
                   NearCandidates<D>& candidates, std::vector<VolumeIntegral>& volume,
                   std::span<std::vector<Flux<D>>> facets) {
  thread_local std::vector<std::size_t> next;  // [facet] number of its next point
  next.clear();
  for (const auto& facet : samples.facets) next.push_back(facet.begin);
  for_fours<D>(
      body, samples.X, candidates, [&](std::size_t first, const ReproducingKernel<D>& kernel) {
        if (first < samples.volume_w.size()) {
          std::array<Real, 4> w{};
          for (std::size_t q = first; q < std::min(first + 4, samples.volume_w.size()); ++q)
            w[q - first] = samples.volume_w[q];
          add_four<D>(kernel, candidates, w, volume);
        }
        for (std::size_t f = 0; f < facets.size(); ++f)
          add_facet_points(samples, samples.facets[f], first, kernel, candidates, next[f],
                           facets[f]);
      });
}

/// The numbers of the candidates with a flux that is not zero.
template <int D>
void list_with_flux(std::span<const Flux<D>> flux, std::vector<Index>& numbers) {
  numbers.resize(flux.size());
  std::size_t count = 0;
  for (std::size_t k = 0; k < flux.size(); ++k) {  // without a branch, which could not be predicted
    numbers[count] = static_cast<Index>(k);
    count += !flux[k].is_zero();
  }
  numbers.resize(count);
}

/// The fluxes through a facet for the cell on its other side. `numbers`: candidates with a flux.
template <int D>
void pack_shared(const typename CellSamples<D>::Facet& facet,
                 std::span<const Candidate<D>> candidates, std::span<const Flux<D>> flux,
                 std::span<const Index> numbers, SharedFlux<D>& packed) {
  packed.neighbor = facet.neighbor;
  packed.centre = facet.centre;
  packed.particle.clear();
  packed.flux.clear();
  packed.particle.reserve(numbers.size());
  packed.flux.reserve(numbers.size());
  for (const Index k : numbers) {
    packed.particle.push_back(at(candidates, k).particle);
    packed.flux.push_back(at(flux, k));
  }
}

/// Integrals over the samples of a cell, over its volume and its facets.
template <int D>
void integrate_samples(const Body<D>& body, Index cell, const CellSamples<D>& samples,
                       OwnItems block, NearCandidates<D>& candidates, CellIntegrals<D>& own) {
  own.volume.assign(own.candidates.size(), {});
  thread_local std::vector<std::vector<Flux<D>>> facets;
  thread_local std::vector<Index> numbers;
  facets.resize(samples.facets.size());
  for (auto& flux : facets) flux.assign(own.candidates.size(), {});
  add_integrals<D>(body, samples, candidates, own.volume, facets);
  MissingMoments<D>(body, cell, samples).add(candidates, own.volume, facets);

  std::size_t shared = 0;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    const auto& facet = samples.facets[f];
    const Lanes arm = Flux<D>::with_zero(facet.centre - body.cells.centroid(cell));
    list_with_flux<D>(facets[f], numbers);
    for (const Index k : numbers) at(own.flux, k).add_moved(at(facets[f], k), arm, 1);
    if (facet.neighbor < cell || facet.neighbor >= block.end) continue;
    if (shared == own.shared.size()) own.shared.emplace_back();
    pack_shared<D>(facet, own.candidates, facets[f], numbers, own.shared[shared++]);
  }
  own.shared.resize(shared);
}

template <int D>
Real reach(std::span<const Vec<D>> points, const Vec<D>& centre) {
  Real radius = 0;
  for (const Vec<D>& x : points) radius = std::max(radius, (x - centre).norm());
  return radius * (1 + 1e-12);
}

/// The quadrature points of a nodal cell.
template <int D>
struct SampledCell {
  CellSamples<D> samples;
  CellQuadrature<D> boundary;  ///< points of loaded faces; empty if no face is loaded
  Real reach;                  ///< largest distance of a point from the centroid
};

/// Samples one cell. `first`: first cell of the block whose integrals are computed together.
template <int D>
void sample(const Body<D>& body, Index cell, Index first, SampledCell<D>& sampled) {
  body.cells.sample(cell, first, body.particles, !body.loaded_faces, sampled.samples);
  sampled.boundary.facet_X.clear();
  sampled.boundary.facet_dA.clear();
  if (body.loaded_faces) body.cells.boundary_points(cell, sampled.boundary);
  const Vec<D>& centroid = body.cells.centroid(cell);
  sampled.reach =
      std::max(reach<D>(sampled.samples.X, centroid), reach<D>(sampled.boundary.facet_X, centroid));
}

/// The end of the group of near cells that begins with cells.begin, and the mean of their
/// centroids.
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

}  // namespace

template <int D>
void integrate_cells(const Body<D>& body, OwnItems cells, OwnItems block,
                     std::span<CellIntegrals<D>> own) {
  thread_local std::array<SampledCell<D>, most_in_group> sampled;
  thread_local std::vector<Candidate<D>> around;
  thread_local NearCandidates<D> near;
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
      near.begin(of_cell.candidates);
      integrate_fluxes<D>(body, boundary.facet_X, boundary.facet_dA, centroid, near, of_cell.flux);
      integrate_samples<D>(body, cell, samples, block, near, of_cell);
    }
  }
}

#define MENISCUS_INSTANTIATE(D) \
  template void integrate_cells(const Body<D>&, OwnItems, OwnItems, std::span<CellIntegrals<D>>);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
