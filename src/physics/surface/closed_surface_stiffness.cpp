// SPDX-License-Identifier: BSD-3-Clause
// The second derivatives of the enclosed volume, for assembled tangents.
#include "physics/surface/closed_surface.hpp"

#include <algorithm>

namespace meniscus {
namespace {

/// The sign of a permutation of 0, 1, 2; 0 if two numbers are equal.
constexpr Real permutation(int i, int j, int k) {
  return (j - i) * (k - i) * (k - j) / 2;
}

}  // namespace

template <int D>
std::vector<Index> ClosedSurface<D>::particles() const {
  std::vector<Index> all(rule_.rows.particle.begin(), rule_.rows.particle.end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  for (Index& A : all) A += body_.first;
  return all;
}

/// The derivatives of x.cof(F) N with the permutation symbol e:
///   d2/dx_k dF_iL = e_ijk e_LMP F_jM N_P,
///   d2/dF_iL dF_jM = e_ijk e_LMP x_k N_P.
template <int D>
void ClosedSurface<D>::add_volume_stiffness(const Placed& placed, Real factor,
                                            StiffnessMatrix& K) const {
  if (!K.is_here()) return;
  elements_.add(rule_, K, [&](Index g, PointModuli<D>& moduli) {
    const Group& points = at(placed.groups, g);
    const Lanes w = factor * share_ * rule_.weight(g);
    std::array<Lanes, 3> x, N{Lanes::zero(), Lanes::zero(), Lanes::zero()};
    for (int k = 0; k < 3; ++k) at(x, k) = w * (at(points.x, k) - at(placed.mean_x, k));
    for (int k = 0; k < D; ++k) at(N, k) = at(N_, g * D + k);
    for (int i = 0; i < D; ++i)
      for (int L = 0; L < D; ++L)
        for (int j = 0; j < 3; ++j)
          for (int M = 0; M < 3; ++M)
            for (int k = 0; k < 3; ++k)
              for (int P = 0; P < 3; ++P) {
                const Real sign = permutation(i, j, k) * permutation(L, M, P);
                if (sign == 0) continue;
                if (k < D) {
                  const Lanes change = sign * w * points.F(j, M) * at(N, P);
                  moduli(k, 0, i, L + 1) += change;
                  moduli(i, L + 1, k, 0) += change;
                }
                if (j < D && M < D) moduli(i, L + 1, j, M + 1) += sign * at(x, k) * at(N, P);
              }
  });
}

#define MENISCUS_INSTANTIATE(D)                                    \
  template std::vector<Index> ClosedSurface<D>::particles() const; \
  template void ClosedSurface<D>::add_volume_stiffness(const Placed&, Real, StiffnessMatrix&) const;
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
