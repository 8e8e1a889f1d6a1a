// SPDX-License-Identifier: BSD-3-Clause
// Compressible neo-Hookean solid, W = mu/2 (I1 - 3 - 2 ln J) + lambda/2 (J - 1)^2 (Fan 2014,
// (4.12)). No loss of ellipticity is known (constitutive note 3.3).
#include "meniscus/physics/law_registry.hpp"
#include "physics/internal/lame_solid.hpp"

namespace meniscus {
namespace {

struct NeoHookean : LameSolid {
  static constexpr std::string_view type_name = "neo_hookean";
  static constexpr std::string_view meaning =
      "W = mu/2 (I1 - 3 - 2 ln J) + lambda/2 (J - 1)^2, I1 = tr F^T F; programs that write "
      "lambda/2 ln^2 J, as FEBio, have another one with the same moduli at small strains";
  static Rows<NeoHookean> rows() { return rows_of<NeoHookean>(); }

  /// Energy per reference volume. With (I1 - 3)/2 = tr H + H:H/2, the first-order parts of (I1 -
  /// 3)/2 and ln J cancel analytically.
  template <class T>
  T energy_density(const Tensor<T>& H) const {
    const T theta = volume_change(H);  // J - 1
    const T isochoric = 0.5 * contract(H, H) - higher_volume_change(H) - log1p_remainder(theta);
    return mu * isochoric + 0.5 * lambda * theta * theta;
  }

  /// P = mu (F - F^-T) + lambda (J - 1) cof F. With F^-T = cof F/J, J = 1 + theta and cof F = (1 +
  /// tr H) I - H^T + cof H, no terms of order one cancel.
  template <class T>
  [[gnu::always_inline]] Tensor<T> stress(const Tensor<T>& H) const {
    const T theta = volume_change(H);
    const T a = mu / (1.0 + theta), b = lambda * theta;
    const T diagonal = a * higher_volume_change(H) + b * (1.0 + trace(H));
    return add_diagonal(T(mu) * H + (a - b) * (transpose(H) - cofactor(H)), diagonal);
  }
};

const bool registered = register_law<NeoHookean>();

}  // namespace
}  // namespace meniscus
