// SPDX-License-Identifier: BSD-3-Clause
// The internal force of a solid on nodal cells that share volume changes (locking note). The law is
// a template parameter, as in internal_force.hpp.
#pragma once
#include "physics/internal/averaged_stress_force.hpp"

namespace meniscus {

template <int D, GroupLaw L>
class AveragedForce final : public AveragedStressForce<D> {
 public:
  /// One law for the whole body, or one for each cell.
  AveragedForce(const Body<D>& body, CellRule<D> rule, std::vector<L> laws,
                std::unique_ptr<AveragedVolumes<D>> volumes)
      : AveragedStressForce<D>(body, std::move(rule),
                               std::make_unique<PointLawsOf<L>>(std::move(laws)),
                               std::move(volumes)) {}

  Report add_force(const Motion& motion, Forces force) override {
    this->gather_coupled(motion);
    return force.gather({this->volumes().gathered(this->changes())}, motion,
                        [this](const Motion& at_motion, const Forces& all) {
                          return add_stresses(at_motion, all);
                        });
  }

 private:
  /// The second phase: the forces of cells that share with no other cell, and the stresses of
  /// coupled cells.
  Report add_stresses(const Motion& motion, Forces force) {
    const bool finite = this->project_changes();
    const CellRule<D>& rule = this->rule();
    const AveragedVolumes<D>& volumes = this->volumes();
    const auto& laws = static_cast<const PointLawsOf<L>&>(this->laws());
    const NodalVector* u = motion.u.data() + this->body().first;
    this->accumulate(force, [&](int chunk, Index begin, Index end, NodalVector* f) {
      Lanes::Mask folded{};
      Lanes work = Lanes::zero(), stored = Lanes::zero();
      for (Index g = begin; g < end; ++g) {
        const Lanes w = rule.weight(g);
        const Real own = volumes.own(g);
        const Index k = volumes.number(g);
        Tensor<Lanes> H;
        if (k < 0)
          rule.gather(g, u, H);
        else
          H = Tensor<Lanes>::map([&](int i, int j) { return this->H(k)(i, j); });
        const Lanes change = volume_change(H);
        const Lanes shared = k < 0 ? cell_mean<D>(change) : Lanes(at(this->changes(), k));
        const AveragedCell<Lanes> cell(H, change, shared, own);
        folded |= ~(cell.J.v > 0.0);  // also true for NaN
        // A cell that has folded makes the shared volume changes NaN everywhere.
        if (finite) folded |= ~(cell.shared_J.v > 0.0);
        const auto& law = laws.at(g, motion.time);
        const Tensor<Lanes> of_law = law.stress(cell.seen);
        if (force.energies) stored += w * laws.energy_density(g, motion.time, cell.seen);
        if constexpr (RampedLaw<L>) work += w * law.energy_rate(cell.seen);
        const Lanes p = cell.mean_stress(of_law);
        const Lanes pull = (1 - own) * cell_mean<D>(p) / cell.shared_J;
        const Tensor<Lanes> P = cell.stress(H, of_law, p, own, k < 0 ? pull : Lanes::zero());
        if (k < 0)
          rule.scatter(g, -w * P, f);
        else
          this->keep(k, P, pull[0]);
      }
      this->of_chunks()[chunk] = {0, sum(work), sum(stored)};
      if (folded[0] | folded[1] | folded[2] | folded[3])
        this->of_chunks()[chunk].failed = this->first_failed(begin, end, u);
    });
    return force.gather({volumes.gathered(this->pulls()), this->of_chunks().gathered()}, motion,
                        [this](const Motion& at_motion, const Forces& all) {
                          this->add_coupled(all);
                          return this->sum_of(this->of_chunks(), at_motion, all);
                        });
  }
};

}  // namespace meniscus
