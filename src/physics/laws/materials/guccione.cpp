// SPDX-License-Identifier: BSD-3-Clause
// Guccione's law of heart muscle: exponential, stiffer along fibres (Guccione, McCulloch and
// Waldman 1991).
//
//   W = C/2 (e^Q - 1) + K/2 (J - 1)^2,   E Green's strain, f the fibre,
//   Q = bf Eff^2 + bt (Ess^2 + Enn^2 + 2 Esn^2) + 2 bfs (Efs^2 + Efn^2)
#include "meniscus/physics/law_registry.hpp"

#include <algorithm>

namespace meniscus {
namespace {

struct Guccione {
  static constexpr std::string_view type_name = "guccione";
  static constexpr std::string_view meaning =
      "W = C/2 (e^Q - 1) + K/2 (J - 1)^2, Q = bf Eff^2 + bt (Ess^2 + Enn^2 + 2 Esn^2) + 2 bfs "
      "(Efs^2 + Efn^2) of the Green strain, f along the reference director; heart muscle";
  static constexpr bool viscous = false;
  Real density, stiffness, along, across, shear, bulk_modulus;
  std::array<Real, 3> director{0, 0, 1};  ///< f

  static Rows<Guccione> rows() {
    using L = Guccione;
    return {parameter_row<L>("density", &L::density, dimension::density, range::positive,
                             "mass per reference volume", 1.25),
            parameter_row<L>("stiffness", &L::stiffness, dimension::pressure, range::positive, "C",
                             0.5),
            parameter_row<L>("along", &L::along, dimension::none, range::positive,
                             "bf, of the stretch of fibres", 1.5),
            parameter_row<L>("across", &L::across, dimension::none, range::positive,
                             "bt, of strains across them", 0.5),
            parameter_row<L>("shear", &L::shear, dimension::none, range::positive,
                             "bfs, of shear along them; the shear modulus is C bfs/2", 0.75),
            parameter_row<L>("bulk_modulus", &L::bulk_modulus, dimension::pressure, range::positive,
                             "K", 1.5)};
  }

  /// Along the fibres or across them, whichever is larger.
  Real p_wave_modulus() const { return bulk_modulus + stiffness * std::max(along, across); }
  Real bulk_over_shear() const {
    return (bulk_modulus + stiffness * (along + 2 * across) / 9) /
           (0.5 * stiffness * std::min(across, shear));
  }

  /// The exponent and what its derivatives need. With |E f|^2 = Eff^2 + Efs^2 + Efn^2,
  /// Q = bt E:E + (bf + bt - 2 bfs) Eff^2 + 2 (bfs - bt) |E f|^2.
  template <class T>
  struct Exponent {
    Tensor<T> E;
    std::array<T, 3> Ef;
    T Eff, Q;
    [[gnu::always_inline]] Exponent(const Guccione& law, const Tensor<T>& H) : E(green_strain(H)) {
      const std::array<Real, 3>& f = law.director;
      for (int i = 0; i < 3; ++i) at(Ef, i) = E(i, 0) * f[0] + E(i, 1) * f[1] + E(i, 2) * f[2];
      Eff = Ef[0] * f[0] + Ef[1] * f[1] + Ef[2] * f[2];
      Q = law.across * contract(E, E) + (law.along + law.across - 2 * law.shear) * (Eff * Eff) +
          2 * (law.shear - law.across) * (Ef[0] * Ef[0] + Ef[1] * Ef[1] + Ef[2] * Ef[2]);
    }
  };

  template <class T>
  T energy_density(const Tensor<T>& H) const {
    const T theta = volume_change(H);
    return 0.5 * stiffness * expm1(Exponent<T>(*this, H).Q) + 0.5 * bulk_modulus * theta * theta;
  }

  /// P = F C e^Q [bt E + (bf + bt - 2 bfs) Eff f f + (bfs - bt) (f Ef + Ef f)] + K (J - 1) cof F.
  template <class T>
  [[gnu::always_inline]] Tensor<T> stress(const Tensor<T>& H) const {
    const Exponent<T> x(*this, H);
    const T scale = stiffness * (1.0 + expm1(x.Q));
    const T of_fibre = (along + across - 2 * shear) * x.Eff;
    const Tensor<T> S = Tensor<T>::map([&](int i, int j) {
      const Real fi = at(director, i), fj = at(director, j);
      return scale * (across * x.E(i, j) + fi * fj * of_fibre +
                      (shear - across) * (fi * at(x.Ef, j) + fj * at(x.Ef, i)));
    });
    const T pressure = bulk_modulus * volume_change(H);
    return S + H * S + pressure * cofactor_of_deformation(H);
  }
};

const bool registered = register_law<Guccione>();

}  // namespace
}  // namespace meniscus
