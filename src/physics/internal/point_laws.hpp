// SPDX-License-Identifier: BSD-3-Clause
// The laws at the quadrature points of a body behind a virtual interface, for energies, fields,
// tangents, warnings and everything else outside of explicit steps. Compiled once per law, not for
// each integration rule.
#pragma once
#include "numbers/dual.hpp"
#include "physics/internal/law.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <utility>
#include <vector>

namespace meniscus {

/// A law that depends on a number J_e of the whole body, set by enclose().
template <class L>
concept EnclosedLaw = requires(L law, const Tensor<Lanes> H) {
  law.enclose(Real{});                                     ///< J_e - 1
  law.about(Dual<Real>{});                                 ///< a copy with that J_e - 1
  { law.pull_on_enclosed(H) } -> std::same_as<Lanes>;      ///< dW/dJ_e
  { law.local_stress(H) } -> std::same_as<Tensor<Lanes>>;  ///< stress independent of J_e
};

/// Deformation of a group of quadrature points: H = F - I, dF/dt and J_e - 1, with their changes.
struct DualDeformation {
  Tensor<Dual<Lanes>> H, F_rate;
  Dual<Real> enclosed;
};

/// The stress and, for an EnclosedLaw, dW/dJ_e with their changes.
struct StressChange {
  Tensor<Dual<Lanes>> P;
  Dual<Lanes> pull_on_enclosed;
};

/// Requirements on a law at a group of up to four quadrature points, one per lane; H = F - I.
template <class L>
concept GroupLaw = ElasticIn<L, Lanes> &&(ViscousIn<L, Lanes> || !L::viscous);

class PointLaws {
 public:
  virtual ~PointLaws() = default;

  /// A copy of the laws with J_e - 1 = `enclosed`, where the law is an EnclosedLaw.
  virtual std::unique_ptr<PointLaws> about(Real enclosed) const = 0;
  virtual Lanes energy_density(Index group, Real time, const Tensor<Lanes>& H) const = 0;
  /// Elastic first Piola stress. For an EnclosedLaw the stress at the local J.
  virtual Tensor<Lanes> stress(Index group, Real time, const Tensor<Lanes>& H) const = 0;
  /// The exact tangent. Only viscous laws read F_rate, only an EnclosedLaw reads J_e.
  virtual StressChange tangent(Index group, Real time, const DualDeformation& x) const = 0;
  /// dP_iK/d(dF/dt)_iL of the viscous stress, for each i.
  virtual std::array<Tensor<Lanes>, 3> viscosity(Index group, Real time,
                                                 const Tensor<Lanes>& H) const = 0;
  /// Size of the stress of the reference law without ramps: an active body is stress-free where
  /// they cancel, which gives no scale. The result is at least the stress of a strain of 1e-9,
  /// since round-off gives no scale either.
  virtual Lanes stress_scale(Index group, const Tensor<Lanes>& H) const = 0;
  /// True if warning() can return a warning.
  virtual bool warns() const = 0;
  virtual std::optional<std::string> warning(Index group, Real time,
                                             const Tensor<Real>& H) const = 0;
  /// The time after which no law changes any more.
  virtual Real steady_after() const = 0;
  virtual std::size_t bytes() const = 0;
};

/// One law for the whole body, or one for each group of stress points.
template <GroupLaw L>
class PointLawsOf final : public PointLaws {
 public:
  explicit PointLawsOf(std::vector<L> laws)
      : laws_(std::move(laws)), stride_(laws_.size() > 1 ? 1 : 0) {}

  /// The law of a group, evaluated at `time` if it changes.
  decltype(auto) at(Index group, [[maybe_unused]] Real time) const {
    if constexpr (RampedLaw<L>)
      return reference(group).at_time(time);
    else
      return reference(group);
  }

  void enclose(Real enclosed) requires EnclosedLaw<L> {
    for (L& law : laws_) law.enclose(enclosed);
  }

  std::unique_ptr<PointLaws> about([[maybe_unused]] Real enclosed) const override {
    auto same = std::make_unique<PointLawsOf>(laws_);
    if constexpr (EnclosedLaw<L>) same->enclose(enclosed);
    return same;
  }
  Lanes energy_density(Index group, Real time, const Tensor<Lanes>& H) const override {
    return at(group, time).energy_density(H);
  }
  Tensor<Lanes> stress(Index group, Real time, const Tensor<Lanes>& H) const override {
    if constexpr (EnclosedLaw<L>)
      return reference(group).local_stress(H);
    else
      return at(group, time).stress(H);
  }
  [[gnu::noinline]] StressChange tangent(Index group, Real time,
                                         const DualDeformation& x) const override {
    const auto& law = at(group, time);
    StressChange change{};
    Tensor<Dual<Lanes>>& P = change.P;
    if constexpr (EnclosedLaw<L>) {
      const auto about = law.about(x.enclosed);
      P = about.stress(x.H);
      change.pull_on_enclosed = about.pull_on_enclosed(x.H);
    } else {
      P = law.stress(x.H);
    }
    if constexpr (L::viscous) P = P + law.viscous_stress(x.H, x.F_rate);
    return change;
  }
  [[gnu::cold]] std::array<Tensor<Lanes>, 3> viscosity(
      [[maybe_unused]] Index group, [[maybe_unused]] Real time,
      [[maybe_unused]] const Tensor<Lanes>& H) const override {
    std::array<Tensor<Lanes>, 3> all;
    all.fill(Tensor<Lanes>::zero());
    if constexpr (L::viscous)
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) {
          Tensor<Lanes> rate = Tensor<Lanes>::zero();
          rate(i, k) = Lanes(1.0);
          const Tensor<Lanes> P = at(group, time).viscous_stress(H, rate);
          for (int K = 0; K < 3; ++K) meniscus::at(all, i)(K, k) = P(i, K);
        }
    return all;
  }
  Lanes stress_scale(Index group, const Tensor<Lanes>& H) const override {
    Tensor<Lanes> P;
    if constexpr (EnclosedLaw<L>)
      P = reference(group).local_stress(H);
    else
      P = reference(group).stress(H);
    return max(sqrt(contract(P, P)), Lanes(1e-9 * reference(group).p_wave_modulus()));
  }
  bool warns() const override { return WarningLaw<L>; }
  std::optional<std::string> warning([[maybe_unused]] Index group, [[maybe_unused]] Real time,
                                     [[maybe_unused]] const Tensor<Real>& H) const override {
    if constexpr (WarningLaw<L>)
      return at(group, time).warning(H);
    else
      return {};
  }
  Real steady_after() const override {
    Real last = 0;
    if constexpr (RampedLaw<L>)
      for (const L& law : laws_) last = std::max(last, law.steady_after());
    return last;
  }
  std::size_t bytes() const override { return laws_.size() * sizeof(L); }

 private:
  const L& reference(Index group) const { return laws_[static_cast<std::size_t>(group) * stride_]; }

  std::vector<L> laws_;
  std::size_t stride_;
};

}  // namespace meniscus
