// SPDX-License-Identifier: BSD-3-Clause
// Forces of a viscous surface law on the whole surface of a body, f_A = -sum_q A_q P(F_q, F_q')
// grad N_A with P linear in the rate of F (cells note 2).
#pragma once
#include "meniscus/physics/surface_rule.hpp"

namespace meniscus {

template <int D, ViscousSurfaceLaw L>
class SurfaceViscosity final : public ForceTerm {
 public:
  /// `points` Gauss points per direction of every facet.
  SurfaceViscosity(const Body<D>& body, const L& law, int points)
      : body_(body),
        law_(law),
        surface_(body, points),
        windows_(surface_.points.windows(body.size())) {}

  std::string name() const override {
    return std::string(L::type_name) + " of the surface of '" + body_.name + "'";
  }
  bool viscous() const override { return true; }

  Report add_force(const Motion& motion, Forces force) override {
    PerChunk<Real> heat(windows_.chunks(), 0);
    const NodalVector *u = motion.u.data() + body_.first, *v = motion.v.data() + body_.first;
    windows_.accumulate(body_.part(std::span<NodalVector>(force)), [&](int chunk, Index begin,
                                                                       Index end, NodalVector* f) {
      Lanes power = Lanes::zero();
      for (Index g = begin; g < end; ++g) {
        const Tensor<Lanes> F_rate = surface_.gradients(g, v);
        const Tensor<Lanes> P = law_.stress(surface_.state(g, surface_.gradients(g, u)), F_rate,
                                            -surface_.points.weight(g));
        power += -contract(P, F_rate);
        surface_.points.scatter(g, P, f);
      }
      at(heat, chunk) = sum(power);
    });
    Report report;
    for (const Real p : heat) report.heat += p;
    return report;
  }
  /// All of the force is linear in the velocity.
  void add_viscous(const Motion& motion, Forces force) override { add_force(motion, force); }

  std::vector<MeasureSource> measures() const override { return {surface_.area_measure(body_)}; }
  std::size_t bytes() const override { return surface_.bytes() + windows_.bytes(); }
  Offset pairs() const override { return surface_.points.pairs(); }

 private:
  const Body<D>& body_;
  L law_;
  SurfaceRule<D> surface_;
  ForceWindows windows_;
};

}  // namespace meniscus
