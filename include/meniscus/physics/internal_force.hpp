// SPDX-License-Identifier: BSD-3-Clause
// The internal force of a body: f_A = - sum_q w_q P(F_q) grad N_A(X_q), in one pass over the stress
// points. The material is a template parameter: its stress is computed inside the loop, four stress
// points at a time.
#pragma once
#include "meniscus/body/body.hpp"
#include "meniscus/physics/force_term.hpp"
#include "meniscus/physics/law.hpp"

#include <fmt/format.h>

namespace meniscus {

/// `Rule` is CellRule<D> or PointRule<D>. One law for the whole body, or one for each group of
/// stress points.
template <int D, Law L, class Rule>
class InternalForce final : public ForceTerm {
 public:
  InternalForce(const Body<D>& body, Rule rule, std::vector<L> laws)
      : body_(body),
        rule_(std::move(rule)),
        laws_(std::move(laws)),
        law_stride_(laws_.size() > 1 ? 1 : 0),
        windows_(rule_.windows(body.size())) {}

  std::string name() const override { return "internal force of '" + body_.name + "'"; }
  bool viscous() const override { return L::viscous; }
  std::string_view energy_kind() const override { return "strain"; }

  void add_force(const Motion& motion, std::span<Lanes> force) override {
    const Lanes* u = motion.u.data() + body_.first;
    [[maybe_unused]] const Lanes* v = motion.v.data() + body_.first;
    failed_group_ = no_group;
    std::array<Real, chunk_count> power{};
    windows_.accumulate(body_span(force), [&](int chunk, Index begin, Index end, Lanes* f) {
      Lanes::Mask folded{};
      Lanes heat = Lanes::zero();
      for (Index g = begin; g < end; ++g) {
        const Lanes w = rule_.weight(g);
        Tensor<Lanes> H;
        rule_.gather(g, u, H);
        folded |= ~((1.0 + volume_change(H)).v > 0.0);  // also true for not a number
        Tensor<Lanes> P = law(g).stress(H);
        if constexpr (L::viscous) {
          Tensor<Lanes> F_rate;
          rule_.gather(g, v, F_rate);
          const Tensor<Lanes> viscous = law(g).viscous_stress(H, F_rate);
          heat += w * contract(viscous, F_rate);
          P = P + viscous;
        }
        rule_.scatter(g, -w * P, f);
      }
      at(power, chunk) = sum(heat);
      if (folded[0] | folded[1] | folded[2] | folded[3]) note_failure(begin, end, u);
    });
    dissipation_ = 0;
    for (const Real p : power) dissipation_ += p;
    if (failed_group_ != no_group) describe_failure(u);
  }

  std::optional<Real> stored_energy(const Motion& motion) const override {
    const Lanes* u = motion.u.data() + body_.first;
    return parallel_sum(rule_.groups(), 0.0, [&](Index g) {
      Tensor<Lanes> H;
      rule_.gather(g, u, H);
      return sum(rule_.weight(g) * law(g).energy_density(H));
    });
  }
  Real dissipation() const override { return dissipation_; }

  std::optional<Failure> failure() const override {
    if (failed_group_ == no_group) return std::nullopt;
    return failure_;
  }
  std::optional<std::string> warning(const Motion& motion) const override;

  std::vector<FieldSource> fields() const override;
  std::vector<MeasureSource> measures() const override;

  std::size_t bytes() const override {
    return rule_.bytes() + windows_.bytes() + laws_.size() * sizeof(L);
  }
  Offset pairs() const override { return rule_.pairs(); }

 private:
  static constexpr Index no_group = std::numeric_limits<Index>::max();

  const L& law(Index group) const { return laws_[static_cast<std::size_t>(group) * law_stride_]; }
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

  /// Calls f(owner particle, weight, H, law) for all stress points, in order.
  template <class F>
  void for_each_point(const Motion& motion, F&& f) const;
  /// Average over the stress points of each particle's cell, weighted by volume.
  template <class F>
  void average(const Motion& motion, std::span<Real> out, int components, F&& value) const;

  const Body<D>& body_;
  Rule rule_;
  std::vector<L> laws_;
  std::size_t law_stride_;
  ForceWindows windows_;
  Real dissipation_ = 0;
  Index failed_group_ = no_group;
  Failure failure_;
};

template <int D, Law L, class Rule>
void InternalForce<D, L, Rule>::note_failure(Index begin, Index end, const Lanes* u) {
  for (Index g = begin; g < end; ++g) {
    Tensor<Lanes> H;
    rule_.gather(g, u, H);
    for (int lane = 0; lane < rule_.points_per_group(); ++lane)
      if (!(1 + volume_change(lane_of(H, lane)) > 0)) {
#pragma omp critical(meniscus_internal_force_failure)
        failed_group_ = std::min(failed_group_, g);
        return;
      }
  }
}

template <int D, Law L, class Rule>
void InternalForce<D, L, Rule>::describe_failure(const Lanes* u) {
  Tensor<Lanes> H;
  rule_.gather(failed_group_, u, H);
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

template <int D, Law L, class Rule>
template <class F>
void InternalForce<D, L, Rule>::for_each_point(const Motion& motion, F&& f) const {
  const Lanes* u = motion.u.data() + body_.first;
  for (Index g = 0; g < rule_.groups(); ++g) {
    Tensor<Lanes> H;
    rule_.gather(g, u, H);
    const Lanes w = rule_.weight(g);
    for (int lane = 0; lane < rule_.points_per_group(); ++lane)
      if (w[lane] > 0) f(rule_.owner(g, lane), w[lane], lane_of(H, lane), law(g));
  }
}

template <int D, Law L, class Rule>
std::optional<std::string> InternalForce<D, L, Rule>::warning(const Motion& motion) const {
  std::optional<std::string> text;
  for_each_point(motion, [&](Index owner, Real, const Tensor<Real>& H, const L& point_law) {
    if (text) return;
    if (const auto cause = meniscus::warning(point_law, H))
      text = fmt::format("body '{}', particle {}: {}", body_.name, body_.first + owner, *cause);
  });
  return text;
}

template <int D, Law L, class Rule>
template <class F>
void InternalForce<D, L, Rule>::average(const Motion& motion, std::span<Real> out, int components,
                                        F&& value) const {
  std::vector<Real> volume(static_cast<std::size_t>(body_.size()), 0.0);
  std::fill(out.begin(), out.end(), 0.0);
  for_each_point(motion, [&](Index owner, Real w, const Tensor<Real>& H, const L& point_law) {
    at(volume, owner) += w;
    const auto x = value(H, point_law);
    for (int c = 0; c < components; ++c) at(out, owner * components + c) += w * at(x, c);
  });
  for (Index A = 0; A < body_.size(); ++A)
    for (int c = 0; c < components; ++c)
      if (at(volume, A) > 0) at(out, A * components + c) /= at(volume, A);
}

template <int D, Law L, class Rule>
std::vector<FieldSource> InternalForce<D, L, Rule>::fields() const {
  const auto cauchy = [](const Tensor<Real>& H, const L& point_law) {
    const Tensor<Real> F = deformation_gradient(H);
    return (1 / (1 + volume_change(H))) * (point_law.stress(H) * transpose(F));
  };
  const auto row_major = [](const Tensor<Real>& x) {
    std::array<Real, 9> a;
    for (int k = 0; k < 9; ++k) at(a, k) = x(k / 3, k % 3);
    return a;
  };
  return {
      {"J", 1, dimension::none, "det F, mean over the particle's cell",
       [this](const Motion& m, std::span<Real> out) {
         average(m, out, 1,
                 [](const Tensor<Real>& H, const L&) { return std::array{1 + volume_change(H)}; });
       }},
      {"F", 9, dimension::none, "deformation gradient, mean over the particle's cell, row-major",
       [this, row_major](const Motion& m, std::span<Real> out) {
         average(m, out, 9, [&](const Tensor<Real>& H, const L&) {
           return row_major(deformation_gradient(H));
         });
       }},
      {"pressure", 1, dimension::pressure, "- tr(sigma)/3 of the elastic Cauchy stress",
       [this, cauchy](const Motion& m, std::span<Real> out) {
         average(m, out, 1, [&](const Tensor<Real>& H, const L& point_law) {
           return std::array{-trace(cauchy(H, point_law)) / 3};
         });
       }},
      {"von_mises", 1, dimension::pressure, "von Mises stress of the elastic Cauchy stress",
       [this, cauchy](const Motion& m, std::span<Real> out) {
         average(m, out, 1, [&](const Tensor<Real>& H, const L& point_law) {
           const Tensor<Real> s = cauchy(H, point_law);
           const Tensor<Real> deviator = s - Tensor<Real>::diagonal(trace(s) / 3);
           return std::array{std::sqrt(1.5 * contract(deviator, deviator))};
         });
       }},
      {"cauchy_stress", 9, dimension::pressure, "elastic Cauchy stress, row-major",
       [this, cauchy, row_major](const Motion& m, std::span<Real> out) {
         average(m, out, 9, [&](const Tensor<Real>& H, const L& point_law) {
           return row_major(cauchy(H, point_law));
         });
       }},
  };
}

template <int D, Law L, class Rule>
std::vector<MeasureSource> InternalForce<D, L, Rule>::measures() const {
  const auto volume = [this](const Motion& m) {
    Real V = 0;
    for_each_point(m, [&](Index, Real w, const Tensor<Real>& H, const L&) {
      V += w * (1 + volume_change(H));
    });
    return V;
  };
  return {
      {"volume", D == 3 ? dimension::volume : dimension::area, "current volume (2D: area)", volume},
      {"min_J", dimension::none, "smallest det F of all stress points",
       [this](const Motion& m) {
         Real least = 1e300;
         for_each_point(m, [&](Index, Real, const Tensor<Real>& H, const L&) {
           least = std::min(least, 1 + volume_change(H));
         });
         return least;
       }},
      {"mean_pressure", dimension::pressure, "pressure, mean over the current volume",
       [this, volume](const Motion& m) {
         Real sum_p = 0;
         for_each_point(m, [&](Index, Real w, const Tensor<Real>& H, const L& point_law) {
           sum_p -= w * contract(point_law.stress(H), deformation_gradient(H)) / 3;
         });
         return sum_p / volume(m);
       }},
  };
}

}  // namespace meniscus
