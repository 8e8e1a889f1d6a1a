// SPDX-License-Identifier: BSD-3-Clause
// Viscous surface of Boussinesq and Scriven: sigma = 2 mu d + (kappa - mu) tr(d) p with the rate of
// deformation d = p sym(grad v) p in the surface, p = I - n n; P = Js sigma F^-T (cells note 2).
#include "meniscus/physics/surface_registry.hpp"

namespace meniscus {
namespace {

/// Dimension of surface viscosity, N s/m.
constexpr Dimension surface_viscosity{0, -1, 1};

struct BoussinesqScriven {
  static constexpr std::string_view type_name = "boussinesq_scriven",
                                    example = "shear = 0.05\ndilatational = 0.1\n";
  Real shear = 0, dilatational = 0;

  static Rows<BoussinesqScriven> rows() {
    return {real_row("shear", &BoussinesqScriven::shear, surface_viscosity, range::non_negative,
                     "viscosity against a change of shape of the surface at constant area"),
            real_row("dilatational", &BoussinesqScriven::dilatational, surface_viscosity,
                     range::non_negative,
                     "viscosity against a change of its area; a plane problem "
                     "knows the sum of both only")};
  }

  /// The stress P; uses grad v p = F_rate e^T.
  template <class T>
  [[gnu::always_inline]] Tensor<T> stress(const SurfaceState<T>& s, const Tensor<T>& F_rate,
                                          T weight) const {
    const Tensor<T> e = dual_tangents(s), slope = F_rate * transpose(e);
    const T over_square = 1.0 / (s.stretch * s.stretch);
    const Tensor<T> tangential = Tensor<T>::map([&](int i, int j) {
      const T along_m = s.m[0] * slope(0, j) + s.m[1] * slope(1, j) + s.m[2] * slope(2, j);
      return slope(i, j) - over_square * at(s.m, i) * along_m;
    });
    const T factor = weight * s.stretch;
    const T shearing = shear * factor,
            stretching = (dilatational - shear) * factor * trace(tangential);
    return add_diagonal(shearing * (tangential + transpose(tangential)), stretching) * e;
  }
};

const bool registered =
    register_surface_viscosity<BoussinesqScriven>("viscosity of the surface itself");

}  // namespace
}  // namespace meniscus
