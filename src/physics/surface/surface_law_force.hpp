// SPDX-License-Identifier: BSD-3-Clause
// Forces of a surface law on the whole surface of a body: the exact gradient of the discrete
// surface energy E = sum_q A_q w(F_q), f_A = -sum_q A_q P(F_q) grad N_A with P = dw/dF (RKPM note
// 4). Needs first derivatives only. Instantiated once per law, at its registration.
#pragma once
#include "physics/surface/surface_rule.hpp"

namespace meniscus {

template <int D, SurfaceLaw L>
class SurfaceForce final : public SurfaceTerm<D, L> {
 public:
  using SurfaceTerm<D, L>::SurfaceTerm;

  std::string_view energy_kind() const override { return "surface"; }

  Report add_force(const Motion& motion, Forces force) override {
    const NodalVector* u = displacements(motion);
    const PointRule<D>& rule = surface_.points;
    chunk_sums_.accumulate(body_.part(force), [&](int, Index begin, Index end, NodalVector* f) {
      for (Index g = begin; g < end; ++g)
        rule.scatter(g, law_.stress(surface_.state(g, surface_.gradients(g, u)), -rule.weight(g)),
                     f);
    });
    return {};
  }
  void add_tangent(const Motion& motion, const Motion& change, Forces force) override {
    const NodalVector *u = displacements(motion), *du = displacements(change);
    const PointRule<D>& rule = surface_.points;
    chunk_sums_.accumulate(body_.part(force), [&](int, Index begin, Index end, NodalVector* f) {
      for (Index g = begin; g < end; ++g) {
        const auto s = surface_.state(g, dual(surface_.gradients(g, u), surface_.gradients(g, du)));
        rule.scatter(g, derivative(law_.stress(s, Dual<Lanes>(-rule.weight(g)))), f);
      }
    });
  }

  std::optional<Real> stored_energy(const Motion& motion) const override {
    const NodalVector* u = displacements(motion);
    return parallel_sum(surface_.groups(), 0.0, [&](Index g) {
      return sum(surface_.points.weight(g) *
                 law_.energy_density(surface_.state(g, surface_.gradients(g, u))));
    });
  }

 private:
  const Lanes* displacements(const Motion& motion) const { return motion.u.data() + body_.first; }

  using SurfaceTerm<D, L>::body_, SurfaceTerm<D, L>::law_, SurfaceTerm<D, L>::surface_,
      SurfaceTerm<D, L>::chunk_sums_;
};

}  // namespace meniscus
