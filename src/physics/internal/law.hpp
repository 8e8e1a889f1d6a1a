// SPDX-License-Identifier: BSD-3-Clause
// Material laws: plain structs of numbers with pure functions of the deformation.
//
// A law lives in its own file in src/physics/laws/materials, in an anonymous namespace, and ends
// with
//   const bool registered = register_law<MyLaw>();
// It always sees three dimensions (2D is plane strain) and H = F - I, never F, because everything
// near the reference state has to be computed without cancellation: volume_change, green_strain,
// log1p, expm1 and their remainders are made for that.
//
// The functions are templates of the scalar T: Real, Lanes (four stress points at once, the time
// loop), Complex (complex-step derivatives) and Dual (exact tangents). Hence the rules for law
// code:
//   - no comparison, abs, min or max of anything that depends on the argument;
//   - transpose never conjugates; no norm; sqrt only where its argument cannot vanish;
//   - stress and viscous_stress are [[gnu::always_inline]]: as calls they take up to twice as long;
//   - a choice that the whole body shares (an equation of state) may be a branch on a number of the
//     law: inlined into the loop it costs nothing measurable;
//   - laws are defined for J > 0 and do not test it: the caller stops the run at J <= 0.
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

/// L can be evaluated with the scalar T.
template <class L, class T>
concept ElasticIn = requires(const L law, const Tensor<T> H) {
  /// Energy W per reference volume; W(0) = 0.
  { law.energy_density(H) } -> std::same_as<T>;
  /// First Piola stress P = dW/dF, P_iA: i force direction, A normal in the reference.
  { law.stress(H) } -> std::same_as<Tensor<T>>;
};

template <class L, class T>
concept ViscousIn = requires(const L law, const Tensor<T> H, const Tensor<T> F_rate) {
  /// First Piola stress, linear in F_rate = dF/dt, added to stress(H); viscous_stress : F_rate >= 0
  /// is the power turned into heat per reference volume.
  { law.viscous_stress(H, F_rate) } -> std::same_as<Tensor<T>>;
};

/// A law with viscous stress; it says `static constexpr bool viscous = true`, and inviscid() if its
/// numbers are such that this stress is always zero.
template <class L>
concept ViscousLaw = L::viscous && ViscousIn<L, Real> && ViscousIn<L, Lanes> &&
    requires(const L law) {
  { law.inviscid() } -> std::same_as<bool>;
};

/// A viscous law, or what is made of one, where its viscosity is zero: without viscous stress.
template <class L>
struct WithoutViscosity : L {
  static constexpr bool viscous = false;
  template <class Argument>
  explicit WithoutViscosity(const Argument& law) : L(law) {}
};

/// A material law. `density` is the mass per reference volume; p_wave_modulus() is rho c^2 of a
/// plane compression wave at the reference state; rows() are its numbers in the scene, and
/// `meaning` its energy W in the words of `meniscus keys`.
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

/// What is wrong with the numbers of `law` taken together (each alone is in its range already);
/// nothing for laws without a member check().
template <Law L>
std::optional<std::string> check(const L& law) {
  if constexpr (requires {
                  { law.check() } -> std::same_as<std::optional<std::string>>;
                })
    return law.check();
  else
    return {};
}

/// Bulk modulus / shear modulus at the reference state; nothing for laws without a member
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

/// Bulk modulus at the reference state; the modulus of p-waves for laws that do not tell it from
/// that, which for fluids is the same.
template <Law L>
Real bulk_modulus(const L& law) {
  const std::optional<Real> ratio = bulk_over_shear(law);
  return law.p_wave_modulus() * (ratio ? *ratio / (*ratio + 4.0 / 3.0) : 1);
}

/// A law with a member warning(H): why it should not be trusted at H = F - I, e.g. a loss of
/// ellipticity. Asked at output times only.
template <class L>
concept WarningLaw = requires(const L law, const Tensor<Real> H) {
  { law.warning(H) } -> std::same_as<std::optional<std::string>>;
};

/// A law with a direction of its own. `director` is a unit vector of the reference, filled in by
/// whoever applies the law to a body (reference_director.hpp); a law without a body has the one it
/// was made with.
template <class L>
concept DirectedLaw = requires(L law) {
  { law.director } -> std::same_as<std::array<Real, 3>&>;
};

/// A law whose numbers change with time. As read from a scene it is that of the reference state.
template <class L>
concept RampedLaw = requires(const L law, const Tensor<Lanes> H) {
  /// The law at a time.
  { law.at_time(Real{}) } -> std::same_as<L>;
  /// dW/dt of at_time(t) at fixed deformation: what changing the numbers costs.
  { law.energy_rate(H) } -> std::same_as<Lanes>;
  /// From when on nothing changes any more.
  { law.steady_after() } -> std::same_as<Real>;
};

/// A law with a member note(spacing): what a reader of the log should know of its numbers on a body
/// of this mean spacing; one sentence.
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
