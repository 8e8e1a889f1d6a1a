// SPDX-License-Identifier: BSD-3-Clause
// The internal force of a body: f_A = - sum_q w_q P(F_q) grad N_A(X_q), in one pass over the stress
// points. The material is a template parameter: its stress is computed inside the loop, four stress
// points at a time.
#pragma once
#include "meniscus/body/body.hpp"
#include "meniscus/physics/force_term.hpp"
#include "meniscus/physics/law.hpp"
#include "meniscus/physics/stress_output.hpp"

#include <fmt/format.h>

namespace meniscus {

/// What the loop over stress points needs of a law: the stresses of a group of points.
template <class L>
concept GroupLaw = ElasticIn<L, Lanes> &&(ViscousIn<L, Lanes> || !L::viscous);

/// `Rule` is CellRule<D> or PointRule<D>. One law for the whole body, or one for each group of
/// stress points.
template <int D, GroupLaw L, class Rule>
class InternalForce final : public ForceTerm {
 public:
  InternalForce(const Body<D>& body, Rule rule, std::vector<L> laws)
      : body_(body),
        rule_(std::move(rule)),
        laws_(std::move(laws)),
        law_stride_(laws_.size() > 1 ? 1 : 0),
        spacing_(mean_spacing(body.geometry.grid)),
        windows_(rule_.windows(body.size())) {}

  std::string name() const override { return "internal force of '" + body_.name + "'"; }
  bool viscous() const override { return L::viscous; }
  std::string_view energy_kind() const override { return "strain"; }
  Real steady_after() const override {
    Real last = 0;
    if constexpr (RampedLaw<L>)
      for (const L& law : laws_) last = std::max(last, law.steady_after());
    return last;
  }

  void add_force(const Motion& motion, std::span<Lanes> force) override {
    const Lanes* u = motion.u.data() + body_.first;
    [[maybe_unused]] const Lanes* v = motion.v.data() + body_.first;
    failed_group_ = no_group;
    std::array<Real, chunk_count> power{}, ramp_power{};
    windows_.accumulate(body_span(force), [&](int chunk, Index begin, Index end, Lanes* f) {
      Lanes::Mask folded{};
      Lanes heat = Lanes::zero();
      [[maybe_unused]] Lanes work = Lanes::zero();
      for (Index g = begin; g < end; ++g) {
        const Lanes w = rule_.weight(g);
        Tensor<Lanes> H;
        rule_.gather(g, u, H);
        folded |= ~((1.0 + volume_change(H)).v > 0.0);  // also true for not a number
        const auto& now = law(g, motion.time);
        Tensor<Lanes> P = now.stress(H);
        if constexpr (RampedLaw<L>) work += w * now.energy_rate(H);
        if constexpr (L::viscous) {
          Tensor<Lanes> F_rate;
          rule_.gather(g, v, F_rate);
          const Tensor<Lanes> viscous = now.viscous_stress(H, F_rate);
          heat += w * contract(viscous, F_rate);
          P = P + viscous;
        }
        rule_.scatter(g, -w * P, f);
      }
      at(power, chunk) = sum(heat);
      at(ramp_power, chunk) = sum(work);
      if (folded[0] | folded[1] | folded[2] | folded[3]) note_failure(begin, end, u);
    });
    dissipation_ = ramp_power_ = 0;
    for (const Real p : power) dissipation_ += p;
    for (const Real p : ramp_power) ramp_power_ += p;
    if (failed_group_ != no_group) describe_failure(u);
  }

  std::optional<Real> stored_energy(const Motion& motion) const override {
    const Lanes* u = motion.u.data() + body_.first;
    return parallel_sum(rule_.groups(), 0.0, [&](Index g) {
      return sum(rule_.weight(g) * law(g, motion.time).energy_density(gradients(g, u)));
    });
  }
  Real uncancelled_force(const Motion& motion) const override;
  Real dissipation() const override { return dissipation_; }
  /// What it takes to change the numbers of the law, as of the last add_force().
  Real external_power(const Motion&) const override { return ramp_power_; }

  std::optional<Failure> failure() const override {
    if (failed_group_ == no_group) return std::nullopt;
    return failure_;
  }
  std::optional<std::string> warning(const Motion& motion) const override;

  std::vector<FieldSource> fields() const override {
    std::vector<bool> owns(static_cast<std::size_t>(body_.size()), false);
    for (Index g = 0; g < rule_.groups(); ++g)
      for (int lane = 0; lane < rule_.points_per_group(); ++lane)
        owns[static_cast<std::size_t>(rule_.owner(g, lane))] = true;
    return stress_fields(visitor(), body_.size(), stand_ins<D>(body_.particles.X(), owns));
  }
  std::vector<MeasureSource> measures() const override { return stress_measures(visitor(), D); }

  std::size_t bytes() const override {
    return rule_.bytes() + windows_.bytes() + laws_.size() * sizeof(L);
  }
  Offset pairs() const override { return rule_.pairs(); }

 private:
  static constexpr Index no_group = std::numeric_limits<Index>::max();

  /// The law of a group of stress points, at a time if it changes.
  decltype(auto) law(Index group, [[maybe_unused]] Real time) const {
    if constexpr (RampedLaw<L>)
      return reference_law(group).at_time(time);
    else
      return reference_law(group);
  }
  const L& reference_law(Index group) const {
    return laws_[static_cast<std::size_t>(group) * law_stride_];
  }
  std::span<Lanes> body_span(std::span<Lanes> all) const {
    return all.subspan(static_cast<std::size_t>(body_.first),
                       static_cast<std::size_t>(body_.size()));
  }
  /// H at one stress point.
  static Tensor<Real> lane_of(const Tensor<Lanes>& H, int lane) {
    return Tensor<Real>::map([&](int i, int j) { return H(i, j)[lane]; });
  }

  /// Keeps the smallest failed group number, whatever the order of the threads.
  void note_failure(Index begin, Index end, const Lanes* u);
  void describe_failure(const Lanes* u);

  /// gather() in one place only: what is not the time loop need not be inlined.
  [[gnu::noinline]] Tensor<Lanes> gradients(Index group, const Lanes* field) const {
    Tensor<Lanes> gradient;
    rule_.gather(group, field, gradient);
    return gradient;
  }
  void visit(const Motion& motion, const std::function<void(const StressPoint&)>& f) const;
  VisitStressPoints visitor() const {
    return [this](const Motion& motion, const std::function<void(const StressPoint&)>& f) {
      visit(motion, f);
    };
  }

  const Body<D>& body_;
  Rule rule_;
  std::vector<L> laws_;
  std::size_t law_stride_;
  Real spacing_;
  ForceWindows windows_;
  Real dissipation_ = 0, ramp_power_ = 0;
  Index failed_group_ = no_group;
  Failure failure_;
};

template <int D, GroupLaw L, class Rule>
void InternalForce<D, L, Rule>::note_failure(Index begin, Index end, const Lanes* u) {
  for (Index g = begin; g < end; ++g) {
    const Tensor<Lanes> H = gradients(g, u);
    for (int lane = 0; lane < rule_.points_per_group(); ++lane)
      if (!(1 + volume_change(lane_of(H, lane)) > 0)) {
#pragma omp critical(meniscus_internal_force_failure)
        failed_group_ = std::min(failed_group_, g);
        return;
      }
  }
}

template <int D, GroupLaw L, class Rule>
void InternalForce<D, L, Rule>::describe_failure(const Lanes* u) {
  const Tensor<Lanes> H = gradients(failed_group_, u);
  for (int lane = 0; lane < rule_.points_per_group(); ++lane) {
    const Tensor<Real> H_point = lane_of(H, lane), F = deformation_gradient(H_point);
    const Real J = 1 + volume_change(H_point);
    if (J > 0) continue;
    failure_ = {
        body_.first + rule_.owner(failed_group_, lane),
        fmt::format("J = det F = {:.6g} at a stress point, F = [{:.4g} {:.4g} {:.4g}; {:.4g} "
                    "{:.4g} {:.4g}; {:.4g} {:.4g} {:.4g}]",
                    J, F(0, 0), F(0, 1), F(0, 2), F(1, 0), F(1, 1), F(1, 2), F(2, 0), F(2, 1),
                    F(2, 2))};
    return;
  }
}

template <int D, GroupLaw L, class Rule>
void InternalForce<D, L, Rule>::visit(const Motion& motion,
                                      const std::function<void(const StressPoint&)>& f) const {
  const Lanes* u = motion.u.data() + body_.first;
  for (Index g = 0; g < rule_.groups(); ++g) {
    const Tensor<Lanes> H = gradients(g, u), P = law(g, motion.time).stress(H);
    const Lanes w = rule_.weight(g);
    for (int lane = 0; lane < rule_.points_per_group(); ++lane)
      if (w[lane] > 0) f({rule_.owner(g, lane), w[lane], lane_of(H, lane), lane_of(P, lane)});
  }
}

template <int D, GroupLaw L, class Rule>
Real InternalForce<D, L, Rule>::uncancelled_force(const Motion& motion) const {
  // Without what ramps add: an active body is free of stress where that cancels. Stresses of
  // round-off are no scale: those of a strain of 1e-9 count at least.
  const Lanes* u = motion.u.data() + body_.first;
  const Real force = parallel_sum(rule_.groups(), 0.0, [&](Index g) {
    const L& passive = reference_law(g);
    const Tensor<Lanes> P = passive.stress(gradients(g, u));
    return sum(rule_.weight(g) * max(sqrt(contract(P, P)), Lanes(1e-9 * passive.p_wave_modulus())));
  });
  return force / spacing_;
}

template <int D, GroupLaw L, class Rule>
std::optional<std::string> InternalForce<D, L, Rule>::warning(const Motion& motion) const {
  if constexpr (WarningLaw<L>) {
    const Lanes* u = motion.u.data() + body_.first;
    for (Index g = 0; g < rule_.groups(); ++g) {
      const Tensor<Lanes> H = gradients(g, u);
      const Lanes w = rule_.weight(g);
      for (int lane = 0; lane < rule_.points_per_group(); ++lane)
        if (w[lane] > 0)
          if (const auto cause = law(g, motion.time).warning(lane_of(H, lane)))
            return fmt::format("body '{}', particle {}: {}", body_.name,
                               body_.first + rule_.owner(g, lane), *cause);
    }
  }
  return {};
}

}  // namespace meniscus
