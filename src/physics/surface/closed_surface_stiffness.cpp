// SPDX-License-Identifier: BSD-3-Clause
// The second derivatives of the enclosed volume, for assembled tangents.
#include "physics/surface/closed_surface.hpp"

#include <algorithm>
#include <optional>

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
    Lanes per_radius = Lanes::zero();
    for (int lane = 0; rule_.rows.folded && lane < rule_.count(g); ++lane)
      per_radius.set(lane, 1 / at(rule_.rows.radius, g * 4 + lane));
    // F_iL as number b of component a: in a body of revolution F_22 = x_0 / X_0.
    struct Number {
      int component, number;
      Lanes factor;
    };
    const auto number_of = [&](int i, int L) -> std::optional<Number> {
      if (i < D && L < D) return Number{i, L + 1, Lanes(1.0)};
      if (rule_.rows.folded && i == 2 && L == 2) return Number{0, 0, per_radius};
      return std::nullopt;
    };
    for (int i = 0; i < 3; ++i)
      for (int L = 0; L < 3; ++L) {
        const auto first = number_of(i, L);
        if (!first) continue;
        for (int j = 0; j < 3; ++j)
          for (int M = 0; M < 3; ++M) {
            const auto second = number_of(j, M);
            for (int k = 0; k < 3; ++k)
              for (int P = 0; P < 3; ++P) {
                const Real sign = permutation(i, j, k) * permutation(L, M, P);
                if (sign == 0) continue;
                if (k < D) {
                  const Lanes change = sign * w * points.F(j, M) * at(N, P) * first->factor;
                  moduli(k, 0, first->component, first->number) += change;
                  moduli(first->component, first->number, k, 0) += change;
                }
                if (second)
                  moduli(first->component, first->number, second->component, second->number) +=
                      sign * at(x, k) * at(N, P) * first->factor * second->factor;
              }
          }
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
