// SPDX-License-Identifier: BSD-3-Clause
// Elastic surface of Gurtin and Murdoch with a skin of the St.Venant-Kirchhoff type: w = lambda/2
// (tr Es)^2 + mu tr Es^2, P = Fs (lambda tr Es I + 2 mu Es) (cells note 1). Tension is a separate
// law.
#include "meniscus/physics/surface_registry.hpp"

#include <algorithm>

namespace meniscus {
namespace {

struct GurtinMurdoch {
  static constexpr std::string_view type_name = "gurtin_murdoch",
                                    example = "lambda = 0.4\nmu = 0.3\n";
  Real lambda = 0, mu = 0;

  static Rows<GurtinMurdoch> rows() {
    return {real_row("lambda", &GurtinMurdoch::lambda, dimension::tension, range::any,
                     "modulus of the change of area, of (tr Es)^2/2"),
            real_row("mu", &GurtinMurdoch::mu, dimension::tension, range::any,
                     "shear modulus, of tr Es^2; moduli of an unstable skin need a stiff body")};
  }
  std::optional<Real> unstable_modulus() const {
    if (mu >= 0 && lambda + mu >= 0) return {};
    return std::min(mu, lambda + 2 * mu);
  }

  template <class T>
  T energy_density(const SurfaceState<T>& s) const {
    const Tensor<T> E = surface_strain(s);
    return 0.5 * lambda * trace(E) * trace(E) + mu * contract(E, E);
  }
  template <class T>
  [[gnu::always_inline]] Tensor<T> stress(const SurfaceState<T>& s, T weight) const {
    const Tensor<T> E = surface_strain(s);
    const T twice_mu = 2.0 * mu * weight;
    const Tensor<T> S = add_diagonal(twice_mu * E, lambda * weight * trace(E));
    return in_reference_plane(deformation_gradient(s.H) * S, s);
  }
};

const bool registered = register_surface_law<GurtinMurdoch>(
    "elastic skin, St.Venant-Kirchhoff in the strain of the surface");

}  // namespace
}  // namespace meniscus
