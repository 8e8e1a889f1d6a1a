// SPDX-License-Identifier: BSD-3-Clause
// Elastic surface of the neo-Hookean type, for large strains: w = mu/2 (tr Cs - 2 - 2 ln Js) +
// lambda/2 (ln Js)^2, P = mu Fs + (lambda ln Js - mu) e (cells note 1). Tension is a separate law.
#include "meniscus/physics/surface_registry.hpp"

#include <algorithm>

namespace meniscus {
namespace {

struct NeoHookeanSkin {
  static constexpr std::string_view type_name = "neo_hookean_skin",
                                    example = "lambda = 0.4\nmu = 0.3\n";
  Real lambda = 0, mu = 0;

  static Rows<NeoHookeanSkin> rows() {
    return {real_row("lambda", &NeoHookeanSkin::lambda, dimension::tension, range::any,
                     "modulus of the change of area, of (ln Js)^2/2"),
            real_row("mu", &NeoHookeanSkin::mu, dimension::tension, range::any,
                     "shear modulus; moduli of an unstable skin need a stiff body")};
  }
  std::optional<Real> unstable_modulus() const {
    if (mu >= 0 && lambda + mu >= 0) return {};
    return std::min(mu, lambda + 2 * mu);
  }

  /// Energy per reference area; uses tr Cs - 2 = 2 tr Es.
  template <class T>
  T energy_density(const SurfaceState<T>& s) const {
    const T log_stretch = log1p(s.stretch - 1.0);
    return mu * (trace(surface_strain(s)) - log_stretch) + 0.5 * lambda * log_stretch * log_stretch;
  }
  template <class T>
  [[gnu::always_inline]] Tensor<T> stress(const SurfaceState<T>& s, T weight) const {
    const T along_F = mu * weight, along_e = weight * (lambda * log1p(s.stretch - 1.0) - mu);
    return along_F * in_reference_plane(deformation_gradient(s.H), s) + along_e * dual_tangents(s);
  }
};

const bool registered =
    register_surface_law<NeoHookeanSkin>("elastic skin for large strains, neo-Hookean");

}  // namespace
}  // namespace meniscus
