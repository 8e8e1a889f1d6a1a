// SPDX-License-Identifier: BSD-3-Clause
// Surface laws: structs of parameters with pure functions of the deformation of a surface. A law
// either gives the surface of a body an energy per area, or resists the rate of its deformation.
//
// A law has a file of its own in src/physics/laws/surfaces, in an anonymous namespace, which ends
// with
//
//   const bool registered = register_surface_law<MyLaw>("short description");
//
// Its functions are templates of the scalar; the rules of material laws (law.hpp) hold.
#pragma once
#include "input/input.hpp"
#include "numbers/elementary.hpp"
#include "numbers/tensor.hpp"

#include <array>
#include <concepts>
#include <optional>
#include <string_view>
#include <type_traits>

namespace meniscus {

/// State of a point of the surface of a body, always in 3D (2D is plane strain).
template <class T>
struct SurfaceState {
  Tensor<T> H;         ///< F - I with F = dx/dX of the body
  Tensor<T> cofactor;  ///< cof F = J F^-T
  std::array<T, 3> N;  ///< outward unit normal of the reference
  std::array<T, 3> m;  ///< cof(F) N = Js n
  T stretch;           ///< Js = |m|, the area ratio da/dA
};

/// energy_density(s) is the energy w per reference area. stress(s, weight) is `weight` times dw/dF,
/// the surface stress P_iK. The factor is a parameter since a law can often multiply one number by
/// it instead of nine.
template <class L>
concept SurfaceLaw = std::is_trivially_copyable_v<L> &&
    requires(const L law, const SurfaceState<Lanes> s) {
  { L::type_name } -> std::convertible_to<std::string_view>;
  { L::rows() } -> std::same_as<Rows<L>>;
  { law.energy_density(s) } -> std::same_as<Lanes>;
  { law.stress(s, Lanes{}) } -> std::same_as<Tensor<Lanes>>;
};

/// stress(s, F_rate, weight) is `weight` times the viscous surface stress P_iK, linear in F_rate =
/// dF/dt. P : F_rate >= 0 is the power turned into heat per reference area.
template <class L>
concept ViscousSurfaceLaw = std::is_trivially_copyable_v<L> &&
    requires(const L law, const SurfaceState<Lanes> s, const Tensor<Lanes> F_rate) {
  { L::type_name } -> std::convertible_to<std::string_view>;
  { L::rows() } -> std::same_as<Rows<L>>;
  { law.stress(s, F_rate, Lanes{}) } -> std::same_as<Tensor<Lanes>>;
};

/// A law whose moduli may make the surface by itself unstable.
template <class L>
concept ModuliSurfaceLaw = requires(const L law) {
  /// The smallest modulus of waves in the surface if the energy is not positive, otherwise empty.
  { law.unstable_modulus() } -> std::same_as<std::optional<Real>>;
};

/// The current tangents e that are dual to the tangents of the reference, e^T F = I - N N: e = (I -
/// n n) F^-T = (cof F - m (m . cof F)/Js^2)/J.
template <class T>
[[gnu::always_inline]] inline Tensor<T> dual_tangents(const SurfaceState<T>& s) {
  const T over_J = 1.0 / (1.0 + volume_change(s.H)), over_square = 1.0 / (s.stretch * s.stretch);
  std::array<T, 3> m_cof;
  for (int K = 0; K < 3; ++K)
    at(m_cof, K) = over_square * (s.m[0] * s.cofactor(0, K) + s.m[1] * s.cofactor(1, K) +
                                  s.m[2] * s.cofactor(2, K));
  return Tensor<T>::map(
      [&](int i, int K) { return over_J * (s.cofactor(i, K) - at(s.m, i) * at(m_cof, K)); });
}

/// x (I - N N).
template <class T>
[[gnu::always_inline]] inline Tensor<T> in_reference_plane(const Tensor<T>& x,
                                                           const SurfaceState<T>& s) {
  return Tensor<T>::map([&](int i, int K) {
    return x(i, K) - (x(i, 0) * s.N[0] + x(i, 1) * s.N[1] + x(i, 2) * s.N[2]) * at(s.N, K);
  });
}

/// Green strain of the surface, Es = (I - N N) E (I - N N), without cancellation.
template <class T>
[[gnu::always_inline]] inline Tensor<T> surface_strain(const SurfaceState<T>& s) {
  return in_reference_plane(transpose(in_reference_plane(green_strain(s.H), s)), s);
}

}  // namespace meniscus
