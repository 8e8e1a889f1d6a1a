// SPDX-License-Identifier: BSD-3-Clause
// Membrane of a red blood cell or capsule that resists a change of its area: Skalak et al. 1973, w
// = G/4 (I1^2 + 2 I1 - 2 I2 + C I2^2) with I1 = l1^2 + l2^2 - 2 and I2 = l1^2 l2^2 - 1 of the
// principal stretches. In the strain of the surface w = G [tr Es^2 + C/4 I2^2] (membranes note 1).
#include "meniscus/physics/surface_registry.hpp"
#include "physics/surface/membrane_strain.hpp"

namespace meniscus {
namespace {

struct Skalak {
  static constexpr std::string_view type_name = "skalak", example = "shear_modulus = 0.3\nC = 1\n";
  Real shear_modulus = 0, C = 0;

  static Rows<Skalak> rows() {
    return {real_row("shear_modulus", &Skalak::shear_modulus, dimension::tension, range::positive,
                     "shear modulus G of small strains"),
            real_row("C", &Skalak::C, dimension::none, {-0.5, unbounded, true},
                     "number C: the modulus of the change of area is G (1 + 2 C)", 1.0)};
  }

  template <class T>
  T energy_density(const SurfaceState<T>& s) const {
    const MembraneStrain<T> strain(s);
    return shear_modulus * (strain.square + 0.25 * C * strain.area_square * strain.area_square +
                            AreaBarrier::energy(s.stretch));
  }
  template <class T>
  [[gnu::always_inline]] Tensor<T> stress(const SurfaceState<T>& s, T weight) const {
    const MembraneStrain<T> strain(s);
    const T G = shear_modulus * weight;
    return membrane_stress(s, strain, 2.0 * G,
                           G * (C * strain.area_square + AreaBarrier::slope_per_stretch(s.stretch)),
                           T(0.0));
  }
};

const bool registered = register_surface_law<Skalak>(
    "membrane of a red blood cell or capsule: shear and, stiffer at large strains, area");

}  // namespace
}  // namespace meniscus
