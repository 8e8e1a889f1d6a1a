// SPDX-License-Identifier: BSD-3-Clause
// Forces of a viscous surface law on the whole surface of a body, f_A = -sum_q A_q P(F_q, F_q')
// grad N_A with P linear in the rate of F (cells note 2).
#pragma once
#include "physics/surface/surface_rule.hpp"

namespace meniscus {

template <int D, ViscousSurfaceLaw L>
class SurfaceViscosity final : public SurfaceTerm<D, L> {
 public:
  using SurfaceTerm<D, L>::SurfaceTerm;

  bool viscous() const override { return true; }

  Report add_force(const Motion& motion, Forces force) override {
    add_viscous(motion, force);
    return this->report_of(of_chunks_, motion, force);
  }
  /// The whole force is linear in the velocity.
  void add_viscous(const Motion& motion, Forces force) override {
    const NodalVector *u = motion.u.data() + body_.first, *v = motion.v.data() + body_.first;
    chunk_sums_.accumulate(
        body_.part(force), [&](int chunk, Index begin, Index end, NodalVector* f) {
          Lanes power = Lanes::zero();
          for (Index g = begin; g < end; ++g) {
            const Tensor<Lanes> F_rate = surface_.gradients(g, v);
            const Tensor<Lanes> P = law_.stress(surface_.state(g, surface_.gradients(g, u)), F_rate,
                                                -surface_.points.weight(g));
            power += -contract(P, F_rate);
            surface_.points.scatter(g, P, f);
          }
          of_chunks_[chunk].heat = sum(power);
        });
  }

 private:
  using SurfaceTerm<D, L>::body_, SurfaceTerm<D, L>::law_, SurfaceTerm<D, L>::surface_,
      SurfaceTerm<D, L>::chunk_sums_;
  ChunkReports of_chunks_ = chunk_sums_.template tally<ChunkReport>();
};

}  // namespace meniscus
