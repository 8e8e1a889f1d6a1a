// SPDX-License-Identifier: BSD-3-Clause
// Forces and tangents of nodal cells that share volume changes.
#include "physics/internal/averaged_stress_force.hpp"

#include <fmt/core.h>

#include <cmath>

namespace meniscus {
namespace {

Dual<Real> first_lane_of(const Dual<Lanes>& x) {
  return {x.v[0], x.d[0]};
}

}  // namespace

template <int D>
AveragedStressForce<D>::AveragedStressForce(const Body<D>& body, CellRule<D> rule,
                                            std::unique_ptr<PointLaws> laws,
                                            std::unique_ptr<AveragedVolumes<D>> volumes)
    : Base(body, std::move(rule), std::move(laws), nullptr, std::move(volumes)),
      coupled_(this->volumes().coupled()),
      own_(this->volumes().gathered(changes_).shares.own()) {
  const auto own = static_cast<std::size_t>(own_.end - own_.begin);
  H_.resize(own);
  stress_.resize(own);
  changes_.resize(coupled_.size());
  pulls_.resize(coupled_.size());
}

template <int D>
void AveragedStressForce<D>::gather_coupled(const Motion& motion) {
  const NodalVector* u = motion.u.data() + this->body().first;
  this->for_own_chunks([&](int, Index begin, Index end) {
    for_coupled(begin, end, [&](Index k, Index cell) {
      Tensor<Lanes>& H = at(H_, k - own_.begin);
      this->rule().gather(cell, u, H, Prefetch::whole);
      at(changes_, k) = cell_mean<D>(volume_change(H))[0];
    });
  });
}

template <int D>
bool AveragedStressForce<D>::project_changes() {
  Real sum = 0;
  for (const Real change : changes_) sum += change;
  volumes().project(changes_);
  return std::isfinite(sum);
}

template <int D>
void AveragedStressForce<D>::add_coupled(Forces force) {
  volumes().project(pulls_);
  this->accumulate(force, [&](int, Index begin, Index end, NodalVector* f) {
    for_coupled(begin, end, [&](Index k, Index cell) {
      const Tensor<Lanes> P =
          at(stress_, k - own_.begin) + Lanes(at(pulls_, k)) * cofactor_of_deformation(H(k));
      this->rule().scatter(cell, -this->rule().weight(cell) * P, f, Prefetch::whole);
    });
  });
}

template <int D>
Index AveragedStressForce<D>::first_failed(Index begin, Index end, const NodalVector* u) const {
  const Index folded = this->first_folded(begin, end, u);
  if (folded != ChunkReport::nowhere) return folded;
  const ItemRange range = volumes().numbers_in(begin, end);
  for (Index k = range.begin; k < range.end; ++k)
    if (!(1 + at(changes_, k) > 0)) return at(coupled_, k);
  return ChunkReport::nowhere;
}

template <int D>
std::optional<Failure> AveragedStressForce<D>::failure_of(Index cell, const Motion& motion) const {
  const Index k = volumes().number(cell);
  const NodalVector* u = motion.u.data() + this->body().first;
  if (k < own_.begin || k >= own_.end || this->first_folded(cell, cell + 1, u) == cell)
    return Base::failure_of(cell, motion);
  return Failure{this->body().first + cell,
                 fmt::format("J = {:.6g} of the pressures that inner cells extend to this cell",
                             1 + at(changes_, k)),
                 true};
}

template <int D>
void AveragedStressForce<D>::add_tangent(const Motion& motion, const Motion& change, Forces force) {
  const Index first = this->body().first;
  const NodalVector *u = motion.u.data() + first, *du = change.u.data() + first;
  dual_H_.resize(H_.size());
  dual_stress_.resize(H_.size());
  dual_changes_.resize(coupled_.size());
  dual_pulls_.resize(coupled_.size());
  this->accumulate(force, [&](int, Index begin, Index end, NodalVector* f) {
    for (Index g = begin; g < end; ++g) {
      const Tensor<Dual<Lanes>> H = this->gradients(g, u, du);
      const Dual<Lanes> J_less_1 = volume_change(H), mean = cell_mean<D>(J_less_1);
      if (const Index k = volumes().number(g); k >= 0) {
        at(dual_H_, k - own_.begin) = H;
        at(dual_changes_, k) = first_lane_of(mean);
        continue;
      }
      const Real own = volumes().own(g);
      const AveragedCell<Dual<Lanes>> cell(H, J_less_1, mean, own);
      const Tensor<Dual<Lanes>> P = this->tangent(g, motion.time, cell.seen);
      const Dual<Lanes> p = cell.mean_stress(P);
      const Tensor<Dual<Lanes>> all =
          cell.stress(H, P, p, own, (1 - own) * cell_mean<D>(p) / cell.shared_J);
      this->rule().scatter(g, -this->rule().weight(g) * derivative(all), f);
    }
  });
  force.gather({volumes().gathered(dual_changes_)}, motion,
               [this](const Motion& at_motion, const Forces& all) {
                 return add_tangent_of_coupled(at_motion, all);
               });
}

template <int D>
Report AveragedStressForce<D>::add_tangent_of_coupled(const Motion& motion, Forces force) {
  volumes().project(dual_changes_);
  parallel_for(own_, [&](Index k) {
    const Index g = at(coupled_, k);
    const Real own = volumes().own(g);
    const Tensor<Dual<Lanes>>& H = at(dual_H_, k - own_.begin);
    const AveragedCell<Dual<Lanes>> cell(H, volume_change(H), Dual<Lanes>(at(dual_changes_, k)),
                                         own);
    const Tensor<Dual<Lanes>> P = this->tangent(g, motion.time, cell.seen);
    const Dual<Lanes> p = cell.mean_stress(P);
    at(dual_stress_, k - own_.begin) = cell.stress(H, P, p, own, Dual<Lanes>(0.0));
    at(dual_pulls_, k) = first_lane_of((1 - own) * cell_mean<D>(p) / cell.shared_J);
  });
  return force.gather(
      {volumes().gathered(dual_pulls_)}, motion, [this](const Motion&, const Forces& all) {
        volumes().project(dual_pulls_);
        this->accumulate(all, [&](int, Index begin, Index end, NodalVector* f) {
          for_coupled(begin, end, [&](Index k, Index g) {
            const Tensor<Dual<Lanes>> P = at(dual_stress_, k - own_.begin) +
                                          Dual<Lanes>(at(dual_pulls_, k)) *
                                              cofactor_of_deformation(at(dual_H_, k - own_.begin));
            this->rule().scatter(g, -this->rule().weight(g) * derivative(P), f);
          });
        });
        return Report();
      });
}

template class AveragedStressForce<2>;
template class AveragedStressForce<3>;

}  // namespace meniscus
