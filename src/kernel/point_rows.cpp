// SPDX-License-Identifier: BSD-3-Clause
// Building compressed rows of shape functions, four points at a time.
#include "kernel/point_rows.hpp"

#include "parallel/parallel.hpp"

#include <algorithm>

namespace meniscus {
namespace {

constexpr Index group_size = 4;  // points of one batch of ReproducingKernel; they share a search

/// Calls f(array, numbers per entry) for each array that rows of this content have.
template <int D, class F>
void for_arrays(RowContent content, bool folded, F&& f) {
  constexpr auto pairs = static_cast<std::size_t>(hessian_count(D));
  f(&PointRows<D>::particle, std::size_t{1});
  if (content.value) f(&PointRows<D>::value, std::size_t{1});
  if (content.gradient) f(&PointRows<D>::gradient, std::size_t{D});
  if (content.hessian) f(&PointRows<D>::hessian, pairs);
  if (!folded) return;
  if (content.value) f(&PointRows<D>::odd_value, std::size_t{1});
  if (content.gradient) f(&PointRows<D>::odd_gradient, std::size_t{D});
  if (content.hessian) f(&PointRows<D>::odd_hessian, pairs);
}

/// Sets the number of entries of all arrays.
template <int D>
void resize(PointRows<D>& rows, std::size_t entries, RowContent content) {
  for_arrays<D>(content, rows.folded,
                [&](auto array, std::size_t numbers) { (rows.*array).resize(entries * numbers); });
}
template <int D>
void reserve(PointRows<D>& rows, std::size_t entries, RowContent content) {
  for_arrays<D>(content, rows.folded,
                [&](auto array, std::size_t numbers) { (rows.*array).reserve(entries * numbers); });
}

template <int D>
void append_row(PointRows<D>& rows, const std::vector<Candidate<D>>& candidates, RowContent content,
                const auto& kernel, int lane) {
  std::size_t e = rows.particle.size(), reaching = 0;
  for (std::size_t k = 0; k < candidates.size(); ++k) reaching += kernel.reaches(k, lane);
  resize(rows, e + reaching, content);
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    if (!kernel.reaches(k, lane)) continue;
    rows.particle[e] = candidates[k].particle;
    if (content.value) rows.value[e] = kernel.value(k)[lane];
    if (content.gradient)
      for (int i = 0; i < D; ++i) at(rows.gradient, e * D + i) = kernel.gradient(k, i)[lane];
    if (content.hessian)
      for (int ij = 0; ij < hessian_count(D); ++ij)
        at(rows.hessian, e * hessian_count(D) + ij) = kernel.hessian(k, ij)[lane];
    ++e;
  }
  rows.start.push_back(static_cast<Offset>(e));
}

/// Transforms derivatives with respect to kernel coordinates G x into derivatives with respect to
/// x: N,i = N,k G_ki. G is symmetric.
template <int D>
void stretch_derivatives(PointRows<D>& rows, const Mat<D>& G) {
  for (std::size_t e = 0; e < rows.gradient.size() / D; ++e) {
    Eigen::Map<Vec<D>> gradient(&rows.gradient[e * D]);
    gradient = (G * gradient).eval();
  }
  constexpr auto pairs = static_cast<std::size_t>(hessian_count(D));
  for (std::size_t e = 0; e < rows.hessian.size() / pairs; ++e) {
    Mat<D> H;
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) H(i, j) = at(rows.hessian, e * pairs + hessian_index(D, i, j));
    H = (G * H * G).eval();
    for (int i = 0; i < D; ++i)
      for (int j = i; j < D; ++j) at(rows.hessian, e * pairs + hessian_index(D, i, j)) = H(i, j);
  }
}

/// Adds sign times `numbers` numbers of entry `from` to entry `to`.
void add_entry(const UnsetVector<Real>& from_array, Offset from, Real sign,
               UnsetVector<Real>& to_array, Offset to, std::size_t numbers) {
  for (std::size_t i = 0; i < numbers; ++i)
    at(to_array, to * static_cast<Offset>(numbers) + static_cast<Offset>(i)) +=
        sign * at(from_array, from * static_cast<Offset>(numbers) + static_cast<Offset>(i));
}

/// Folds rows that have entries for images. An image reaches a point only if its particle does.
template <int D>
PointRows<D> folded(const ParticleSet<D>& particles, std::span<const Vec<D>> points,
                    const PointRows<D>& rows, RowContent content) {
  PointRows<D> result;
  result.folded = true;
  for (Index q = 0; q < rows.size(); ++q) {
    const Offset first = at(rows.start, q), next = at(rows.start, q + 1);
    const auto begin = rows.particle.begin() + first, end = rows.particle.begin() + next;
    const Offset own = std::lower_bound(begin, end, particles.size()) - begin;
    const Offset entry = result.entries();
    result.particle.insert(result.particle.end(), begin, begin + own);
    result.start.push_back(entry + own);
    const auto add = [&](Offset e, Offset to, Real even, Real odd) {
      for_arrays<D>(content, false, [&](auto array, std::size_t numbers) {
        if constexpr (std::is_same_v<decltype(array), UnsetVector<Real> PointRows<D>::*>)
          add_entry(rows.*array, e, even, result.*array, to, numbers);
      });
      if (content.value) add_entry(rows.value, e, odd, result.odd_value, to, 1);
      if (content.gradient) add_entry(rows.gradient, e, odd, result.odd_gradient, to, D);
      if (content.hessian)
        add_entry(rows.hessian, e, odd, result.odd_hessian, to,
                  static_cast<std::size_t>(hessian_count(D)));
    };
    for_arrays<D>(content, true, [&](auto array, std::size_t numbers) {
      if constexpr (std::is_same_v<decltype(array), UnsetVector<Real> PointRows<D>::*>)
        (result.*array).resize(static_cast<std::size_t>(entry + own) * numbers, 0.0);
    });
    for (Offset e = first; e < next; ++e) {
      const Index A = at(rows.particle, e), source = particles.source(A);
      const Offset to = std::lower_bound(begin, begin + own, source) - begin;
      if (to == own || *(begin + to) != source) continue;
      const bool on_axis = at(particles.X(), source)[0] == 0;
      add(e, entry + to, 1, on_axis ? 0 : A == source ? 1 : -1);
    }
    if (content.value && at(points, q)[0] == 0)  // not only to rounding
      std::fill(result.odd_value.begin() + entry, result.odd_value.end(), 0.0);
  }
  return result;
}

template <int D, int Degree>
PointRows<D> group_rows(const ParticleSet<D>& particles, std::span<const Vec<D>> points,
                        RowContent content, const std::string& body) {
  const Derivatives order = content.hessian    ? Derivatives::second
                            : content.gradient ? Derivatives::first
                                               : Derivatives::none;
  std::array<Vec<D>, group_size> batch;  // unused lanes repeat the last point
  for (std::size_t lane = 0; lane < group_size; ++lane)
    batch[lane] = points[std::min(lane, points.size() - 1)];
  thread_local std::vector<Candidate<D>> candidates;
  particles.candidates(batch, candidates);

  // The limit is known for the quadratic basis. A cubic basis is worse conditioned.
  const Real least = Degree > 2 ? 1e-6 : ParticleSet<D>::unusable_quality;
  thread_local ReproducingKernel<D, Degree> kernel(
      particles.kernel_function());  // keeps its buffers
  kernel.use(particles.kernel_function());
  if (candidates.size() < static_cast<std::size_t>(kernel.basis_size))
    particles.require_quality(0, batch[0], body);
  kernel.evaluate(particles.kernel_places(batch), candidates, order);

  PointRows<D> rows;
  reserve(rows, candidates.size() * points.size(), content);
  for (std::size_t lane = 0; lane < points.size(); ++lane) {
    particles.require_quality(kernel.quality()[static_cast<int>(lane)], batch[lane], body, least);
    append_row(rows, candidates, content, kernel, static_cast<int>(lane));
  }
  if (particles.pressed()) stretch_derivatives(rows, *particles.pressed());
  return particles.mirrored() ? folded(particles, points, rows, content) : rows;
}

/// Reserves memory for `times` as many entries as `some` rows have, times a safety factor of 2.
/// Unused reserve occupies no memory, while growing an array would need twice its memory for a
/// moment.
template <int D>
void reserve(PointRows<D>& rows, std::span<const PointRows<D>> some, Real times,
             RowContent content) {
  std::size_t entries = 0;
  for (const PointRows<D>& part : some) entries += part.particle.size();
  if (times > 1) entries = static_cast<std::size_t>(2 * times * static_cast<Real>(entries));
  reserve(rows, entries, content);
}

template <int D>
void append_rows(PointRows<D>& rows, std::span<const PointRows<D>> parts, RowContent content) {
  std::vector<std::size_t> first{rows.particle.size()};  // [part] number of entries before it
  for (const PointRows<D>& part : parts) {
    const Offset base = rows.start.back();
    for (std::size_t q = 1; q < part.start.size(); ++q) rows.start.push_back(base + part.start[q]);
    first.push_back(first.back() + part.particle.size());
  }
  for_arrays<D>(content, rows.folded, [&](auto array, std::size_t numbers) {
    grow(rows.*array, first.back() * numbers);
    parallel_for(static_cast<Index>(parts.size()), [&](Index k) {
      const auto& some = at(parts, k).*array;
      std::copy(some.begin(), some.end(), (rows.*array).data() + at(first, k) * numbers);
    });
  });
}

}  // namespace

template <int D>
std::size_t PointRows<D>::bytes() const {
  std::size_t sum = start.size() * sizeof(Offset);
  for_arrays<D>({.value = true, .gradient = true, .hessian = true}, folded,
                [&](auto array, std::size_t) { sum += std::span(this->*array).size_bytes(); });
  return sum;
}

template <int D, int Degree>
PointRows<D> build_point_rows(const ParticleSet<D>& particles, std::span<const Vec<D>> points,
                              RowContent content, const std::string& body) {
  const auto n = static_cast<Index>(points.size());
  const Index groups = (n + group_size - 1) / group_size;
  content.value = content.value || (particles.mirrored() && content.gradient);
  constexpr Index block = 1024;  // block by block: separate rows of all groups would take more
                                 // memory
  std::vector<PointRows<D>> part(static_cast<std::size_t>(std::min(block, groups)));
  PointRows<D> rows;
  rows.folded = particles.mirrored();
  rows.start.reserve(points.size() + 1);
  for (Index begin = 0; begin < groups; begin += block) {
    const Index count = std::min(block, groups - begin);
    parallel_for(
        count,
        [&](Index k) {
          const auto first = static_cast<std::size_t>(begin + k) * group_size;
          const auto size = std::min<std::size_t>(group_size, points.size() - first);
          at(part, k) =
              group_rows<D, Degree>(particles, points.subspan(first, size), content, body);
        },
        1);
    if (begin == 0) reserve<D>(rows, part, static_cast<Real>(groups) / count, content);
    append_rows<D>(rows, std::span(part).first(static_cast<std::size_t>(count)), content);
  }
  if (rows.folded)
    for (const Vec<D>& x : points) rows.radius.push_back(x[0]);
  return rows;
}

/// Rows of some of the points. Points are grouped by four as in the rows of all points, so that the
/// bits are the same.
template <int D>
PointRows<D> build_point_rows(const ParticleSet<D>& particles, std::span<const Vec<D>> points,
                              RowContent content, const std::string& body, ItemRange some) {
  const auto n = static_cast<Index>(points.size());
  content.value = content.value || (particles.mirrored() && content.gradient);
  const Index first = some.begin / group_size * group_size,
              last = std::min(n, (some.end + group_size - 1) / group_size * group_size);
  PointRows<D> rows = build_point_rows<D>(
      particles,
      points.subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(last - first)),
      content, body);
  const Offset before = at(rows.start, some.begin - first), end = at(rows.start, some.end - first);
  for_arrays<D>(content, rows.folded, [&](auto array, std::size_t numbers) {
    auto& entries = rows.*array;
    entries.resize(static_cast<std::size_t>(end) * numbers);
    entries.erase(entries.begin(), entries.begin() + before * static_cast<std::ptrdiff_t>(numbers));
  });
  std::vector<Offset> start(static_cast<std::size_t>(some.begin), 0);
  start.reserve(points.size() + 1);
  for (Index q = some.begin; q <= some.end; ++q)
    start.push_back(at(rows.start, q - first) - before);
  start.resize(points.size() + 1, end - before);
  rows.start = std::move(start);
  rows.radius.clear();
  if (rows.folded)
    for (const Vec<D>& x : points) rows.radius.push_back(x[0]);
  return rows;
}

template struct PointRows<2>;
template struct PointRows<3>;
template PointRows<2> build_point_rows(const ParticleSet<2>&, std::span<const Vec<2>>, RowContent,
                                       const std::string&, ItemRange);
template PointRows<3> build_point_rows(const ParticleSet<3>&, std::span<const Vec<3>>, RowContent,
                                       const std::string&, ItemRange);
#define MENISCUS_INSTANTIATE(D, Degree)              \
  template PointRows<D> build_point_rows<D, Degree>( \
      const ParticleSet<D>&, std::span<const Vec<D>>, RowContent, const std::string&);
MENISCUS_INSTANTIATE(2, 1)
MENISCUS_INSTANTIATE(2, 2)
MENISCUS_INSTANTIATE(2, 3)
MENISCUS_INSTANTIATE(3, 1)
MENISCUS_INSTANTIATE(3, 2)
MENISCUS_INSTANTIATE(3, 3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
