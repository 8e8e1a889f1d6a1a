// SPDX-License-Identifier: BSD-3-Clause
// Membrane of Evans and Skalak 1980 with independent shear and area: w = mu/2 (l1/l2 + l2/l1 - 2) +
// K/2 (l1 l2 - 1)^2 of the principal stretches l1, l2 (membranes note 1).
#include "meniscus/physics/surface_registry.hpp"
#include "physics/surface/membrane_strain.hpp"

namespace meniscus {
namespace {

struct EvansSkalak {
  static constexpr std::string_view type_name = "evans_skalak",
                                    example = "shear_modulus = 0.3\narea_modulus = 0.7\n";
  Real shear_modulus = 0, area_modulus = 0;

  static Rows<EvansSkalak> rows() {
    return {real_row("shear_modulus", &EvansSkalak::shear_modulus, dimension::tension,
                     range::positive, "modulus mu of the change of shape at constant area"),
            real_row("area_modulus", &EvansSkalak::area_modulus, dimension::tension,
                     range::positive, "modulus K of the change of area at constant shape")};
  }

  /// Energy per reference area; l1/l2 + l2/l1 - 2 = [2 tr Es (Js - 1) - 8 det Es]/[Js (1 + Js)].
  template <class T>
  T energy_density(const SurfaceState<T>& s) const {
    const MembraneStrain<T> strain(s);
    const T growth = strain.area_square / (1.0 + s.stretch),
            shape = (2.0 * strain.sum * growth - 8.0 * strain.determinant) /
                    (s.stretch * (1.0 + s.stretch));
    return 0.5 * shear_modulus * shape + 0.5 * area_modulus * growth * growth +
           (shear_modulus + area_modulus) * AreaBarrier::energy(s.stretch);
  }
  /// The part of the shape is mu/Js^3 Fs [2 (1 + tr Es) Es - (tr Es + 2 tr Es^2) I].
  template <class T>
  [[gnu::always_inline]] Tensor<T> stress(const SurfaceState<T>& s, T weight) const {
    const MembraneStrain<T> strain(s);
    const T growth = strain.area_square / (1.0 + s.stretch),
            shape = shear_modulus * weight / (s.stretch * s.stretch * s.stretch);
    return membrane_stress(
        s, strain, 2.0 * shape * (1.0 + strain.sum),
        weight * (area_modulus * growth / s.stretch +
                  (shear_modulus + area_modulus) * AreaBarrier::slope_per_stretch(s.stretch)),
        -shape * (strain.sum + 2.0 * strain.square));
  }
};

const bool registered = register_surface_law<EvansSkalak>(
    "membrane with independent moduli of a change of shape and of a change of area");

}  // namespace
}  // namespace meniscus
