// SPDX-License-Identifier: BSD-3-Clause
// Material laws: plain structs of parameters with pure functions of the deformation.
//
// A law has its own file in src/physics/laws/materials, in an anonymous namespace, which ends with
//   const bool registered = register_law<MyLaw>();
// Its functions always work in three dimensions (2D is plane strain). Their argument is H = F - I,
// not F, so that nothing cancels near the reference state. volume_change, green_strain, log1p,
// expm1 and their remainders help to avoid cancellation.
//
// The functions are templates of the scalar T. T is Real, Lanes (four stress points at once, in the
// time loop), Complex (complex-step derivatives) or Dual (exact tangents). Hence these rules:
//
//   - no comparison, abs, min or max of anything that depends on the argument;
//   - transpose never conjugates; no norm; sqrt only where its argument cannot vanish;
//   - stress and viscous_stress are [[gnu::always_inline]]: as calls they take up to twice as long;
//   - a choice for the whole body, such as an equation of state, may be a branch on a parameter of
//     the law: it costs nothing measurable;
//   - laws are defined for J > 0 and do not test J: the caller stops the run if J <= 0.
#pragma once
#include "input/input.hpp"
#include "numbers/elementary.hpp"
#include "numbers/tensor.hpp"

#include <array>
#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

namespace meniscus {

/// The law L can be evaluated with the scalar T.
template <class L, class T>
concept ElasticIn = requires(const L law, const Tensor<T> H) {
  /// Energy W per reference volume; W(0) = 0.
  { law.energy_density(H) } -> std::same_as<T>;
  /// First Piola stress P = dW/dF, with P_iA: direction i of the force, reference normal A.
  { law.stress(H) } -> std::same_as<Tensor<T>>;
};

template <class L, class T>
concept ViscousIn = requires(const L law, const Tensor<T> H, const Tensor<T> F_rate) {
  /// First Piola stress, linear in F_rate = dF/dt. It is added to stress(H). viscous_stress :
  /// F_rate >= 0 is the power turned into heat per reference volume.
  { law.viscous_stress(H, F_rate) } -> std::same_as<Tensor<T>>;
};

/// A law with viscous stress. It has `static constexpr bool viscous = true`. inviscid() returns
/// true if this stress is always zero with the parameters of the law.
template <class L>
concept ViscousLaw = L::viscous && ViscousIn<L, Real> && ViscousIn<L, Lanes> &&
    requires(const L law) {
  { law.inviscid() } -> std::same_as<bool>;
};

/// A viscous law, or a class that wraps one, without its viscous stress: for laws whose viscosity
/// is zero.
template <class L>
struct WithoutViscosity : L {
  static constexpr bool viscous = false;
  template <class Argument>
  explicit WithoutViscosity(const Argument& law) : L(law) {}
};

/// A material law. `density` is the mass per reference volume. p_wave_modulus() is rho c^2 of a
/// plane compression wave at the reference state. rows() are the parameters in a scene. `meaning`
/// describes its energy W in `meniscus keys`.
template <class L>
concept Law = std::is_trivially_copyable_v<L> && ElasticIn<L, Real> && ElasticIn<L, Lanes> &&
              ElasticIn<L, Complex> &&(ViscousLaw<L> || !L::viscous) &&
              requires(const L law) {
  { L::type_name } -> std::convertible_to<std::string_view>;
  { L::meaning } -> std::convertible_to<std::string_view>;
  { law.density } -> std::convertible_to<Real>;
  { L::rows() } -> std::same_as<Rows<L>>;
  { law.p_wave_modulus() } -> std::same_as<Real>;
};

/// Describes a problem of the parameters taken together (each alone is in its range). Empty if
/// there is none, or if the law has no member check().
template <Law L>
std::optional<std::string> check(const L& law) {
  if constexpr (requires {
                  { law.check() } -> std::same_as<std::optional<std::string>>;
                })
    return law.check();
  else
    return {};
}

/// Bulk modulus / shear modulus at the reference state. Nodal cells of solids with a large ratio
/// share volume changes, so that they do not lock (locking note 2). Empty for laws without a member
/// bulk_over_shear(), such as fluids.
template <Law L>
std::optional<Real> bulk_over_shear(const L& law) {
  if constexpr (requires {
                  { law.bulk_over_shear() } -> std::same_as<Real>;
                })
    return law.bulk_over_shear();
  else
    return {};
}

/// Bulk modulus at the reference state. Laws without bulk_over_shear() are fluids, whose bulk
/// modulus is the p-wave modulus.
template <Law L>
Real bulk_modulus(const L& law) {
  const std::optional<Real> ratio = bulk_over_shear(law);
  return law.p_wave_modulus() * (ratio ? *ratio / (*ratio + 4.0 / 3.0) : 1);
}

/// A law with a member warning(H). It returns the reason if the law is not reliable at H = F - I,
/// e.g. a loss of ellipticity. Called at output times only.
template <class L>
concept WarningLaw = requires(const L law, const Tensor<Real> H) {
  { law.warning(H) } -> std::same_as<std::optional<std::string>>;
};

/// A law with a direction of its own. `director` is a unit vector in the reference. Code that
/// applies the law to a body sets it (reference_director.hpp); otherwise it keeps its initial
/// value.
template <class L>
concept DirectedLaw = requires(L law) {
  { law.director } -> std::same_as<std::array<Real, 3>&>;
};

/// A law whose parameters change with time. As read from a scene, it is the law of the reference
/// state.
template <class L>
concept RampedLaw = requires(const L law, const Tensor<Lanes> H) {
  /// The law with its parameters at a time.
  { law.at_time(Real{}) } -> std::same_as<L>;
  /// dW/dt of at_time(t) at fixed deformation: the power supplied by the change of the parameters.
  { law.energy_rate(H) } -> std::same_as<Lanes>;
  /// The time after which the parameters are constant.
  { law.steady_after() } -> std::same_as<Real>;
};

/// A law with a member note(spacing). It returns a sentence for the log about its parameters, for a
/// body with this mean spacing.
template <class L>
concept NotingLaw = requires(const L law) {
  { law.note(Real{}) } -> std::same_as<std::optional<std::string>>;
};

/// The law with the typical numbers of its rows.
template <Law L>
L typical_law() {
  L law{};
  for (const Row<L>& row : L::rows())
    if (row.member) law.*row.member = row.typical;
  return law;
}

}  // namespace meniscus
