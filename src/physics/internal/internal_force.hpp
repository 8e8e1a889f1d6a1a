// SPDX-License-Identifier: BSD-3-Clause
// The internal force of a body, f_A = - sum_q w_q P(F_q) grad N_A(X_q), in one loop over the
// quadrature points. The material is a template parameter: its stress is computed inside the loop,
// for four quadrature points at a time.
#pragma once
#include "physics/internal/stress_point_force.hpp"

namespace meniscus {

/// `Rule` is CellRule<D> or PointRule<D>. There is one law for the whole body, or one for each
/// group of quadrature points.
template <int D, GroupLaw L, class Rule>
class InternalForce final : public StressPointForce<D, Rule> {
 public:
  /// `surface`: the patches whose enclosed volume the pressure of an EnclosedLaw works on. If it is
  /// null, the volume of the quadrature points is used.
  InternalForce(const Body<D>& body, Rule rule, std::vector<L> laws,
                std::unique_ptr<SurfacePatches<D>> surface = nullptr)
      : StressPointForce<D, Rule>(body, std::move(rule),
                                  std::make_unique<PointLawsOf<L>>(std::move(laws)),
                                  std::move(surface)) {}

  bool viscous() const override { return L::viscous; }
  void expect_viscous_calls() override {
    if constexpr (L::viscous) this->keep_deformations();
  }

  Report add_force(const Motion& motion, Forces force) override {
    if constexpr (EnclosedLaw<L>) {
      if (this->has_surface())
        return force.gather({this->place_surface(motion)}, motion,
                            [this](const Motion& at_motion, const Forces& all) {
                              return add_rows(this->follow_enclosed(), at_motion, all);
                            });
      return add_rows(0, motion, force);
    } else {
      return add_rows(0, motion, force);
    }
  }

  void add_viscous([[maybe_unused]] const Motion& motion, [[maybe_unused]] Forces force) override {
    if constexpr (L::viscous) {
      const auto& laws = static_cast<const PointLawsOf<L>&>(this->laws());
      const Rule& rule = this->rule();
      const NodalVector* v = motion.v.data() + this->body().first;
      this->accumulate(force, [&](int, Index begin, Index end, NodalVector* f) {
        for (Index g = begin; g < end; ++g) {
          Tensor<Lanes> F_rate;
          rule.gather(g, v, F_rate);
          const auto& law = laws.at(g, motion.time);
          rule.scatter(g, -rule.weight(g) * law.viscous_stress(this->kept()[g], F_rate), f);
        }
      });
    }
  }

 private:
  /// Adds the forces of all rows. `enclosed`: J_e - 1 of the surface, for an EnclosedLaw.
  Report add_rows([[maybe_unused]] Real enclosed, const Motion& motion, Forces force) {
    auto& laws = static_cast<PointLawsOf<L>&>(this->laws());
    const Rule& rule = this->rule();
    const NodalVector* u = motion.u.data() + this->body().first;
    [[maybe_unused]] const NodalVector* v = motion.v.data() + this->body().first;
    if constexpr (EnclosedLaw<L>) laws.enclose(enclosed);
    ChunkReports& of_chunks = this->of_chunks();
    ChunkTally<Real>& pulls = this->pulls();
    this->accumulate(force, [&](int chunk, Index begin, Index end, NodalVector* f) {
      Lanes::Mask folded{};
      [[maybe_unused]] KeptDeformations kept(this->kept());
      Lanes heat = Lanes::zero();
      [[maybe_unused]] Lanes work = Lanes::zero(), on_enclosed = Lanes::zero();
      Lanes stored = Lanes::zero();
      for (Index g = begin; g < end; ++g) {
        const Lanes w = rule.weight(g);
        Tensor<Lanes> H;
        rule.gather(g, u, H);
        if constexpr (L::viscous) kept.take(g, H);
        folded |= ~((1.0 + volume_change(H)).v > 0.0);  // also true for NaN
        const auto& law = laws.at(g, motion.time);
        Tensor<Lanes> P = law.stress(H);
        if (force.energies) stored += w * laws.energy_density(g, motion.time, H);
        if constexpr (RampedLaw<L>) work += w * law.energy_rate(H);
        if constexpr (EnclosedLaw<L>) on_enclosed += w * law.pull_on_enclosed(H);
        if constexpr (L::viscous) {
          Tensor<Lanes> F_rate;
          rule.gather(g, v, F_rate);
          const Tensor<Lanes> viscous = law.viscous_stress(H, F_rate);
          heat += w * contract(viscous, F_rate);
          P = P + viscous;
        }
        rule.scatter(g, -w * P, f);
      }
      // `work` is the power that changes the parameters of the law.
      of_chunks[chunk] = {sum(heat), sum(work), sum(stored)};
      if (folded[0] | folded[1] | folded[2] | folded[3])
        of_chunks[chunk].failed = this->first_folded(begin, end, u);
      if constexpr (EnclosedLaw<L>)
        if (this->has_surface()) pulls[chunk] = sum(on_enclosed);
    });
    if constexpr (EnclosedLaw<L>)
      if (this->has_surface())
        return force.gather({of_chunks.gathered(), pulls.gathered_where_rows_are()}, motion,
                            [this](const Motion& at_motion, const Forces& all) {
                              const Real pull = this->pulls().sum(0.0);
                              this->pull_on_surface(pull, all);
                              Report report = this->sum_of(this->of_chunks(), at_motion, all);
                              report += this->hold_on_walls(pull, at_motion, all);
                              return report;
                            });
    return this->report_of(of_chunks, motion, force);
  }
};

}  // namespace meniscus
