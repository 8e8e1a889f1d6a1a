// SPDX-License-Identifier: BSD-3-Clause
// Extents of surfaces that consist of quadratic patches.
#include "measure/surface_extents.hpp"

#include "body/surface/surface_points.hpp"
#include "kernel/row_sums.hpp"
#include "parallel/ranks.hpp"

#include <algorithm>

namespace meniscus {
namespace {

/// Values of a quadratic function at -1, 0, 1.
using Quadratic = std::array<Real, 3>;

/// The position in [-1, 1] at which the function is largest.
Real peak_place(const Quadratic& f) {
  const Real slope = (f[2] - f[0]) / 2, bend = f[0] - 2 * f[1] + f[2];
  if (bend < 0 && std::abs(slope) < -bend) return -slope / bend;
  return f[2] > f[0] ? 1 : -1;
}
Real value_at(const Quadratic& f, Real x) {
  return f[1] + x * ((f[2] - f[0]) / 2 + x * (f[0] - 2 * f[1] + f[2]) / 2);
}

/// The largest value of a quadratic function over [-1, 1].
Real peak(const std::array<Real, 3>& f) {
  return std::max({value_at(f, peak_place(f)), f[0], f[1], f[2]});
}
/// The largest value of a biquadratic function over the square; `f` has the first direction
/// fastest. From the largest of the nine values, it maximises along the two directions in turn.
Real peak(const std::array<Real, 9>& f) {
  constexpr int most_rounds = 30;
  const auto largest = std::max_element(f.begin(), f.end());
  Real y = static_cast<Real>((largest - f.begin()) / 3 - 1), best = *largest;
  for (int round = 0; round < most_rounds; ++round) {
    Quadratic along_x, along_y;
    for (std::size_t i = 0; i < 3; ++i) at(along_x, i) = value_at({f[i], f[3 + i], f[6 + i]}, y);
    const Real x = peak_place(along_x);
    for (std::size_t j = 0; j < 3; ++j)
      at(along_y, j) = value_at({f[3 * j], f[3 * j + 1], f[3 * j + 2]}, x);
    y = peak_place(along_y);
    const Real value = value_at(along_y, y);
    if (!(value > best + 1e-14 * std::abs(value))) break;
    best = value;
  }
  return best;
}

/// The largest value over all patches of a function with the value f(p) at node p. On a patch the
/// function exceeds its nodal values by at most half of their difference.
template <std::size_t nodes, class F>
Real largest_over(const std::vector<std::array<Index, nodes>>& patches, Real largest_of_points,
                  F&& f) {
  Real largest = largest_of_points;
  for (const auto& patch : patches) {
    std::array<Real, nodes> values;
    std::transform(patch.begin(), patch.end(), values.begin(), f);
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    if (*most + (*most - *least) / 2 > largest) largest = std::max(largest, peak(values));
  }
  return largest;
}

}  // namespace

template <int D>
auto SurfaceExtents<D>::points() -> const Points& {
  if (points_) return *points_;
  const Geometry<D>& geometry = body_.geometry;
  const PatchNodes<D> numbered(geometry.grid);
  Points made{numbered.facet, std::vector<Vec<D>>(static_cast<std::size_t>(numbered.count())), {}};
  for (std::size_t patch = 0; patch < made.of_patch.size(); ++patch)
    for (int a = 0; a < nodes; ++a)
      at(made.X, at(at(made.of_patch, patch), a)) =
          surface_point<D>(geometry, at(geometry.grid.facets, patch), patch_node<D>(a));
  on_each_rank([&] {
    made.rows = build_point_rows<D>(body_.particles, made.X, {.value = true}, body_.name,
                                    body_.division.own_rows(numbered.count()));
  });
  points_ = std::move(made);
  return *points_;
}

template <int D>
std::vector<Vec<D>> SurfaceExtents<D>::places(const Motion& motion) {
  const Points& on = points();
  const auto count = static_cast<Index>(on.X.size());
  const NodalVector* u = motion.u.data() + body_.first;
  NodalVectors moved(on.X.size());
  parallel_for(body_.division.own_rows(count),
               [&](Index p) { at(moved, p) = value_at(on.rows, p, u); });
  body_.division.complete_rows(count, moved.data(), sizeof(NodalVector));
  std::vector<Vec<D>> x = on.X;
  for (Index p = 0; p < count; ++p)
    for (int i = 0; i < D; ++i) at(x, p)[i] += at(moved, p)[i];
  return x;
}

template <int D>
Box<D> SurfaceExtents<D>::box(const Motion& motion) {
  const std::vector<Vec<D>> x = places(motion);
  Box<D> box = box_around<D>(x);
  for (int i = 0; i < D; ++i) {
    box.high[i] =
        largest_over(points_->of_patch, box.high[i], [&](Index p) { return at(x, p)[i]; });
    box.low[i] =
        -largest_over(points_->of_patch, -box.low[i], [&](Index p) { return -at(x, p)[i]; });
  }
  if (body_.geometry.grid.revolved) box.low[0] = -box.high[0];
  return box;
}

template class SurfaceExtents<2>;
template class SurfaceExtents<3>;

}  // namespace meniscus
