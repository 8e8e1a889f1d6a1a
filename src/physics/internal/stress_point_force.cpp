// SPDX-License-Identifier: BSD-3-Clause
// Tangent, energy, failures, warnings and output of the internal force.
#include "physics/internal/stress_point_force.hpp"

#include <fmt/core.h>

namespace meniscus {
namespace {

/// H at one stress point.
Tensor<Real> lane_of(const Tensor<Lanes>& H, int lane) {
  return Tensor<Real>::map([&](int i, int j) { return H(i, j)[lane]; });
}

}  // namespace

template <int D, class Rule>
Tensor<Lanes> StressPointForce<D, Rule>::gradients(Index group, const NodalVector* u) const {
  Tensor<Lanes> H;
  rule_.gather(group, u, H);
  return H;
}

/// Adds the tangent. With J_e = V/V0 of the surface, the force is -sum w P grad N - (sum w dW/dJ_e)
/// dV/du / V0.
template <int D, class Rule>
void StressPointForce<D, Rule>::add_tangent(const Motion& motion, const Motion& change,
                                            Forces force) {
  const NodalVector *u = motion.u.data() + body_.first, *du = change.u.data() + body_.first,
                    *v = motion.v.data() + body_.first, *dv = change.v.data() + body_.first;
  const bool viscous = this->viscous();
  Dual<Real> enclosed(0.0);
  if (surface_) {
    surface_->at_time(motion.time);
    enclosed = surface_->measure(Size::volume, u, du) / surface_->reference(Size::volume) - 1.0;
  }
  accumulate(force, [&](int chunk, Index begin, Index end, NodalVector* f) {
    DualDeformation x{Tensor<Dual<Lanes>>::zero(), Tensor<Dual<Lanes>>::zero(), enclosed};
    Dual<Lanes> sum_of_pulls(0.0);
    for (Index g = begin; g < end; ++g) {
      x.H = gradients(g, u, du);
      if (viscous) x.F_rate = gradients(g, v, dv);
      const StressChange stress = laws_->tangent(g, motion.time, x);
      const Lanes w = rule_.weight(g);
      rule_.scatter(g, -w * derivative(stress.P), f);
      sum_of_pulls += w * stress.pull_on_enclosed;
    }
    if (surface_) pull_changes_[chunk] = sum(sum_of_pulls);
  });
  if (!surface_) return;
  force.gather({pull_changes_.gathered_where_rows_are()}, motion,
               [this, u, du](const Motion&, const Forces& all) {
                 const Dual<Real> slope = pull_changes_.sum(Dual<Real>(0.0));
                 surface_->add_gradient_change(Size::volume, u, du,
                                               -slope / surface_->reference(Size::volume),
                                               body_.part(all));
                 return Report();
               });
}

template <int D, class Rule>
void StressPointForce<D, Rule>::add_viscous_diagonal(Forces diagonal) {
  if (!keeps_) return;
  accumulate(diagonal, [&](int, Index begin, Index end, NodalVector* sum) {
    for (Index g = begin; g < end; ++g) {
      const auto viscosity = laws_->viscosity(g, 0, kept()[g]);
      std::array<Tensor<Lanes>, D> weighted;
      for (int i = 0; i < D; ++i) at(weighted, i) = rule_.weight(g) * at(viscosity, i);
      rule_.add_diagonal(g, weighted, sum);
    }
  });
}

template <int D, class Rule>
Real StressPointForce<D, Rule>::energy(const PointLaws& laws, const Motion& motion) const {
  const NodalVector* u = motion.u.data() + body_.first;
  const Shared shared = shared_changes(motion);
  return body_.sum_over_rows(rule_.groups(), 0.0, [&](Index g) {
    const Tensor<Lanes> H = seen(g, gradients(g, u), shared);
    return sum(rule_.weight(g) * laws.energy_density(g, motion.time, H));
  });
}

template <int D, class Rule>
auto StressPointForce<D, Rule>::shared_changes(const Motion& motion) const -> Shared {
  if (!volumes_) return {};
  const NodalVector* u = motion.u.data() + body_.first;
  return {
      volumes_->projected([&](Index g) { return cell_mean<D>(volume_change(gradients(g, u)))[0]; }),
      {}};
}

template <int D, class Rule>
auto StressPointForce<D, Rule>::shared_by_cells(const Motion& motion) const -> Shared {
  Shared shared = shared_changes(motion);
  if (!volumes_) return shared;
  const NodalVector* u = motion.u.data() + body_.first;
  shared.pulls = volumes_->projected([&](Index g) {
    const AveragedCell<Lanes> cell = averaged_cell(g, gradients(g, u), shared);
    const Lanes p = cell.mean_stress(laws_->stress(g, motion.time, cell.seen));
    return (1 - volumes_->own(g)) * cell_mean<D>(p)[0] / cell.shared_J[0];
  });
  return shared;
}

template <int D, class Rule>
AveragedCell<Lanes> StressPointForce<D, Rule>::averaged_cell(Index group, const Tensor<Lanes>& H,
                                                             const Shared& shared) const {
  const Lanes change = volume_change(H);
  const Index k = volumes_->number(group);
  return {H, change, k >= 0 ? Lanes(at(shared.changes, k)) : cell_mean<D>(change),
          volumes_->own(group)};
}

template <int D, class Rule>
Tensor<Lanes> StressPointForce<D, Rule>::stress(Index group, Real time, const Tensor<Lanes>& H,
                                                const Shared& shared) const {
  if (!volumes_) return laws_->stress(group, time, H);
  const AveragedCell<Lanes> cell = averaged_cell(group, H, shared);
  const Real own = volumes_->own(group);
  const Tensor<Lanes> P = laws_->stress(group, time, cell.seen);
  const Lanes p = cell.mean_stress(P);
  const Index k = volumes_->number(group);
  return cell.stress(
      H, P, p, own,
      k >= 0 ? Lanes(at(shared.pulls, k)) : (1 - own) * cell_mean<D>(p) / cell.shared_J);
}

template <int D, class Rule>
std::optional<Real> StressPointForce<D, Rule>::stored_energy(const Motion& motion) const {
  if (!surface_) return energy(*laws_, motion);
  surface_->at_time(motion.time);
  const Real volume = surface_->measure(Size::volume, motion.u.data() + body_.first);
  return energy(*laws_->about(volume / surface_->reference(Size::volume) - 1), motion);
}

template <int D, class Rule>
Real StressPointForce<D, Rule>::uncancelled_force(const Motion& motion) const {
  const NodalVector* u = motion.u.data() + body_.first;
  const Shared shared = shared_changes(motion);
  const Real force = body_.sum_over_rows(rule_.groups(), 0.0, [&](Index g) {
    return sum(rule_.weight(g) * laws_->stress_scale(g, seen(g, gradients(g, u), shared)));
  });
  return force / spacing_;
}

template <int D, class Rule>
Index StressPointForce<D, Rule>::first_folded(Index begin, Index end, const NodalVector* u) const {
  for (Index g = begin; g < end; ++g) {
    const Tensor<Lanes> H = gradients(g, u);
    for (int lane = 0; lane < rule_.points_per_group(); ++lane)
      if (!(1 + volume_change(lane_of(H, lane)) > 0)) return g;
  }
  return ChunkReport::nowhere;
}

template <int D, class Rule>
std::optional<Failure> StressPointForce<D, Rule>::failure_of(Index group,
                                                             const Motion& motion) const {
  if (group < own_.begin || group >= own_.end) return {};
  const Tensor<Lanes> H = gradients(group, motion.u.data() + body_.first);
  int lane = 0;
  while (lane + 1 < rule_.points_per_group() && 1 + volume_change(lane_of(H, lane)) > 0) ++lane;
  const Tensor<Real> F = deformation_gradient(lane_of(H, lane));
  return Failure{
      body_.first + rule_.owner(group, lane),
      fmt::format("J = det F = {:.6g} at a stress point, F = [{:.4g} {:.4g} {:.4g}; {:.4g} {:.4g} "
                  "{:.4g}; {:.4g} {:.4g} {:.4g}]",
                  1 + volume_change(lane_of(H, lane)), F(0, 0), F(0, 1), F(0, 2), F(1, 0), F(1, 1),
                  F(1, 2), F(2, 0), F(2, 1), F(2, 2)),
      true};
}

template <int D, class Rule>
std::optional<std::string> StressPointForce<D, Rule>::warning(const Motion& motion) const {
  if (!laws_->warns()) return {};
  const NodalVector* u = motion.u.data() + body_.first;
  const Shared shared = shared_changes(motion);
  for (Index g = own_.begin; g < own_.end; ++g) {
    const Tensor<Lanes> H = seen(g, gradients(g, u), shared);
    const Lanes w = rule_.weight(g);
    for (int lane = 0; lane < rule_.points_per_group(); ++lane)
      if (w[lane] > 0)
        if (const auto cause = laws_->warning(g, motion.time, lane_of(H, lane)))
          return fmt::format("body '{}', particle {}: {}", body_.name,
                             body_.first + rule_.owner(g, lane), *cause);
  }
  return {};
}

template <int D, class Rule>
void StressPointForce<D, Rule>::visit(const Motion& motion,
                                      const std::function<void(const StressPoint&)>& f) const {
  const NodalVector* u = motion.u.data() + body_.first;
  const Shared shared = shared_by_cells(motion);
  body_.for_rows_in_order(
      rule_.groups(), [&](Index g) { return gradients(g, u); },
      [&](Index g, const Tensor<Lanes>& H) {
        const Tensor<Lanes> P = stress(g, motion.time, H, shared);
        const Lanes J = volumes_ && volumes_->own(g) < 1 ? averaged_cell(g, H, shared).shared_J
                                                         : 1.0 + volume_change(H);
        const Lanes w = rule_.weight(g);
        for (int lane = 0; lane < rule_.points_per_group(); ++lane)
          if (w[lane] > 0) {
            const Index owner = rule_.owner(g, lane);
            f({owner, w[lane], lane_of(H, lane), lane_of(P, lane), J[lane],
               body_.volume_ratio(owner)});
          }
      });
}

template <int D, class Rule>
VisitStressPoints StressPointForce<D, Rule>::visitor() const {
  return [this](const Motion& motion, const std::function<void(const StressPoint&)>& f) {
    visit(motion, f);
  };
}

template <int D, class Rule>
std::vector<FieldSource> StressPointForce<D, Rule>::fields() const {
  std::vector<bool> owns(static_cast<std::size_t>(body_.size()), false);
  for (Index g = 0; g < rule_.groups(); ++g)
    for (int lane = 0; lane < rule_.points_per_group(); ++lane)
      owns[static_cast<std::size_t>(rule_.owner(g, lane))] = true;
  return stress_fields(visitor(), body_.size(), stand_ins<D>(body_.particles.X(), owns));
}

template <int D, class Rule>
std::vector<MeasureSource> StressPointForce<D, Rule>::measures() const {
  std::vector<MeasureSource> measures = stress_measures(visitor(), D);
  if (surface_)
    measures.push_back({"inner_pressure", dimension::pressure,
                        "pressure of the fluid on the surface on which its tension acts",
                        [this](const Motion& motion) { return inner_pressure(motion); }});
  return measures;
}

/// - dE/dV with the volume V that the surface encloses.
template <int D, class Rule>
Real StressPointForce<D, Rule>::inner_pressure(const Motion& motion) const {
  const NodalVector* u = motion.u.data() + body_.first;
  const Real V0 = surface_->reference(Size::volume);
  surface_->at_time(motion.time);
  const Dual<Real> enclosed(surface_->measure(Size::volume, u) / V0 - 1);
  const Real slope = body_.sum_over_rows(rule_.groups(), 0.0, [&](Index g) {
    const Tensor<Dual<Lanes>> H = dual(gradients(g, u), Tensor<Lanes>::zero());
    const StressChange stress =
        laws_->tangent(g, motion.time, {H, Tensor<Dual<Lanes>>::zero(), enclosed});
    return sum(rule_.weight(g) * stress.pull_on_enclosed.v);
  });
  return -slope / V0;
}

template class StressPointForce<2, CellRule<2>>;
template class StressPointForce<3, CellRule<3>>;
template class StressPointForce<2, PointRule<2>>;
template class StressPointForce<3, PointRule<3>>;

}  // namespace meniscus
