// SPDX-License-Identifier: BSD-3-Clause
// Surface laws: plain structs of numbers with pure functions of how a surface deforms, which give
// the surface of a body an energy per area.
//
// A law lives in its own file in src/surfaces, in an anonymous namespace, and ends with
//   const bool registered = register_surface_law<MyLaw>("what it is");
// The functions are templates of the scalar, and the rules of material laws (law.hpp) hold.
#pragma once
#include "meniscus/core/elementary.hpp"
#include "meniscus/core/input.hpp"
#include "meniscus/core/tensor.hpp"

#include <array>
#include <concepts>
#include <string_view>
#include <type_traits>

namespace meniscus {

/// A point of the surface of a body: always in three dimensions (2D is plane strain).
template <class T>
struct SurfaceState {
  Tensor<T> H;         ///< F - I, F = dx/dX of the body there
  Tensor<T> cofactor;  ///< cof F = J F^-T
  std::array<T, 3> N;  ///< outward unit normal of the reference
  std::array<T, 3> m;  ///< cof(F) N = Js n
  T stretch;           ///< Js = |m|, the area ratio da/dA
};

/// energy_density(s): energy w per reference area. stress(s, weight): `weight` times dw/dF, the
/// surface stress P_iK; the factor goes in because a law can often multiply one number by it
/// instead of nine.
template <class L>
concept SurfaceLaw = std::is_trivially_copyable_v<L> &&
    requires(const L law, const SurfaceState<Lanes> s) {
  { L::type_name } -> std::convertible_to<std::string_view>;
  { L::rows() } -> std::same_as<Rows<L>>;
  { law.energy_density(s) } -> std::same_as<Lanes>;
  { law.stress(s, Lanes{}) } -> std::same_as<Tensor<Lanes>>;
};

}  // namespace meniscus
