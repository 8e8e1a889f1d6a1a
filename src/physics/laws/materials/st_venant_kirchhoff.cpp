// SPDX-License-Identifier: BSD-3-Clause
// St.Venant-Kirchhoff solid: linear in the Green strain. For small strains; it loses ellipticity
// already at moderate compression (constitutive note 3.1).
#include "meniscus/physics/law_registry.hpp"
#include "numbers/dense.hpp"
#include "physics/internal/lame_solid.hpp"

#include <fmt/core.h>

namespace meniscus {
namespace {

struct StVenantKirchhoff : LameSolid {
  static constexpr std::string_view type_name = "st_venant_kirchhoff";
  static constexpr std::string_view meaning =
      "W = lambda/2 tr^2 E + mu E:E, E = (F^T F - I)/2; for small strains, unstable in compression";
  static Rows<StVenantKirchhoff> rows() { return rows_of<StVenantKirchhoff>(); }

  /// Energy per reference volume, W = lambda/2 tr^2 E + mu E:E.
  template <class T>
  T energy_density(const Tensor<T>& H) const {
    const Tensor<T> E = green_strain(H);
    return 0.5 * lambda * trace(E) * trace(E) + mu * contract(E, E);
  }

  /// The stress P = F S with S = lambda tr(E) I + 2 mu E.
  template <class T>
  [[gnu::always_inline]] Tensor<T> stress(const Tensor<T>& H) const {
    const Tensor<T> E = green_strain(H);
    const Tensor<T> S = add_diagonal(T(2 * mu) * E, lambda * trace(E));
    return S + H * S;
  }

  /// Warns of lost ellipticity. min eig S + mu min stretch^2 > 0 is sufficient for ellipticity. S,
  /// E and C have the same axes, so the least eigenvalue of E decides; the criterion is exact for
  /// hydrostatic compression.
  std::optional<std::string> warning(const Tensor<Real>& H) const {
    const Tensor<Real> E = green_strain(H);
    Eigen::Matrix3d strain;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) strain(i, j) = E(i, j);
    const Real least = symmetric_eigenvalues<3>(strain)[0];
    if (lambda * trace(E) + mu * (1 + 4 * least) > 0) return {};
    return fmt::format(
        "the compression (least principal stretch {:.3g}, J = {:.3g}) is beyond what "
        "st_venant_kirchhoff can bear: it may lose ellipticity; use neo_hookean",
        std::sqrt(1 + 2 * least), 1 + volume_change(H));
  }
};

const bool registered = register_law<StVenantKirchhoff>();

}  // namespace
}  // namespace meniscus
