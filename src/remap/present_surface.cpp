// SPDX-License-Identifier: BSD-3-Clause
// Nearest points on patches.
#include "remap/present_surface.hpp"

#include "kernel/row_sums.hpp"
#include "meniscus/error.hpp"
#include "numbers/dense.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace meniscus {

template <int D>
PresentSurface<D>::PresentSurface(const Body<D>& body, const NodalVector* u)
    : gauss_(patch_functions<D>(3)) {
  const SurfacePatches<D> patches(body);
  for (Index q = 0; q < patches.point_count(); ++q) {
    Vec<D> x = patches.reference_place(q);
    const Lanes moved = value_at(patches.rows(), q, u);
    for (int i = 0; i < D; ++i) x[i] += moved[i];
    x_.push_back(x);
  }
  std::vector<std::vector<Index>> around(x_.size());
  for (Index patch = 0; patch < patches.patch_count(); ++patch) {
    patch_.push_back(patches.points_of(patch));
    for (const Index point : patch_.back()) at(around, point).push_back(patch);
  }
  for (Index patch = 0; patch < patches.patch_count(); ++patch) {
    std::set<Index> beside;
    for (const Index point : at(patch_, patch))
      beside.insert(at(around, point).begin(), at(around, point).end());
    beside.erase(patch);
    beside_.emplace_back(beside.begin(), beside.end());
  }
}

/// The nearest point of a patch, by Gauss-Newton steps in the directions that do not lead out of
/// the patch.
template <int D>
typename PresentSurface<D>::Foot PresentSurface<D>::nearest_in(const Vec<D>& p, Index patch) const {
  constexpr int most_steps = 20;
  Foot foot;
  foot.patch = patch;
  for (int step = 0; step < most_steps; ++step) {
    const auto place = patch_place<D>(PatchFunctions<D>(foot.xi), at(patch_, patch), x_);
    foot.x = place.X;
    const Vec<D - 1> pull = place.J.transpose() * (p - place.X);
    Mat<D - 1> metric = place.J.transpose() * place.J;
    Vec<D - 1> right = pull;
    for (int k = 0; k < D - 1; ++k)
      if (std::abs(foot.xi[k]) == 1 && foot.xi[k] * pull[k] > 0) {
        const Real scale = metric(k, k);
        metric.row(k).setZero();
        metric.col(k).setZero();
        metric(k, k) = scale;
        right[k] = 0;
      }
    Vec<D - 1> next = foot.xi + inverse<D - 1>(metric) * right;
    if (!next.allFinite()) break;  // the patch has no area here
    next = next.cwiseMax(-1).cwiseMin(1);
    const bool there = (next - foot.xi).cwiseAbs().maxCoeff() < 1e-12;
    foot.xi = next;
    if (there) break;
  }
  foot.x = patch_place<D>(PatchFunctions<D>(foot.xi), at(patch_, patch), x_).X;
  foot.distance = (p - foot.x).norm();
  return foot;
}

template <int D>
typename PresentSurface<D>::Foot PresentSurface<D>::nearest(const Vec<D>& p, Index patch) const {
  if (!p.allFinite())
    throw SolveError("the new place of a node of the surface is not a finite number");
  Foot best = nearest_in(p, patch);
  // Each visited patch is nearer than all before it, so none is visited twice.
  for (bool nearer = true; nearer;) {
    nearer = false;
    for (const Index other : at(beside_, best.patch)) {
      const Foot foot = nearest_in(p, other);
      if (!(foot.distance < best.distance * (1 - 1e-12))) continue;
      best = foot;
      nearer = true;
      break;
    }
  }
  return best;
}

template <int D>
Real enclosed_volume(const Grid<D>& grid,
                     const std::vector<std::array<Index, PatchFunctions<D>::nodes>>& patches,
                     const std::vector<Vec<D>>& points) {
  Real volume = 0;
  const std::vector<PatchFunctions<D>> gauss = patch_functions<D>(3);
  for (const auto& patch : patches)
    for (const PatchFunctions<D>& f : gauss) {
      const auto place = patch_place<D>(f, patch, points);
      Vec<D> m;
      if constexpr (D == 3)
        m = cross(place.J.col(0), place.J.col(1));
      else
        m = Vec<2>(place.J(1, 0), -place.J(0, 0));
      volume += grid.revolved ? f.weight * std::numbers::pi * place.X[0] * place.X[0] * m[0]
                              : f.weight * place.X.dot(m) / D;
    }
  return volume;
}

#define MENISCUS_INSTANTIATE(D)                                                        \
  template class PresentSurface<D>;                                                    \
  template Real enclosed_volume<D>(                                                    \
      const Grid<D>&, const std::vector<std::array<Index, PatchFunctions<D>::nodes>>&, \
      const std::vector<Vec<D>>&);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
