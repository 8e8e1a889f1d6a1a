// SPDX-License-Identifier: BSD-3-Clause
// Modified Mooney-Rivlin solid, W = c1 (I1 - 3 I3^(1/3)) + c2 (I2 - 3 I3^(2/3)) + lambda/2 (ln
// I3)^2 (Fan 2014, (4.9)). Shear modulus 2 (c1 + c2), bulk modulus 4 lambda (constitutive
// note 3.2).
#include "meniscus/physics/law_registry.hpp"
#include "physics/internal/elastic_moduli.hpp"

#include <fmt/core.h>

namespace meniscus {
namespace {

struct MooneyRivlin {
  static constexpr std::string_view type_name = "mooney_rivlin";
  static constexpr std::string_view meaning =
      "W = c1 (I1 - 3 I3^(1/3)) + c2 (I2 - 3 I3^(2/3)) + lambda/2 (ln I3)^2, I3 = J^2; not the "
      "form "
      "with I1 J^(-2/3)";
  static constexpr bool viscous = false;
  static constexpr OfModuli of_moduli[] = {{"c1", "{E}/(4*(1 + {nu})) - {c2}"},
                                           {"lambda", "{E}/(12*(1 - 2*{nu}))"}};
  Real density, c1, c2, lambda;

  static Rows<MooneyRivlin> rows() {
    using L = MooneyRivlin;
    return {parameter_row<L>("density", &L::density, dimension::density, range::positive,
                             "mass per reference volume", 1.25),
            parameter_row<L>("c1", &L::c1, dimension::pressure, range::non_negative,
                             "factor of I1; the shear modulus is 2 (c1 + c2)", 0.625),
            parameter_row<L>("c2", &L::c2, dimension::pressure, range::non_negative, "factor of I2",
                             0.125),
            parameter_row<L>("lambda", &L::lambda, dimension::pressure, range::positive,
                             "factor of (ln I3)^2/2; the bulk modulus is 4 lambda", 2.5)};
  }

  std::optional<std::string> check() const {
    if (c1 + c2 > 0) return {};
    return "the shear modulus 2 (c1 + c2) must be positive";
  }

  Real p_wave_modulus() const { return 4 * lambda + 8.0 / 3.0 * (c1 + c2); }
  Real bulk_over_shear() const { return 2 * lambda / (c1 + c2); }

  /// Energy per reference volume. With L = ln J, x = 2 L/3 and g = tr E - L, the first-order parts
  /// cancel analytically: I1 - 3 I3^(1/3) = 2 g - 3 (e^x - 1 - x), I2 - 3 I3^(2/3) = 4 (g + II_E) -
  /// 3 (e^2x - 1 - 2 x).
  template <class T>
  T energy_density(const Tensor<T>& H) const {
    const T theta = volume_change(H), L = log1p(theta), x = (2.0 / 3.0) * L;
    const T g = 0.5 * contract(H, H) - higher_volume_change(H) - log1p_remainder(theta);
    const T second_invariant_of_strain = trace(cofactor(green_strain(H)));
    return c1 * (2.0 * g - 3.0 * exp_remainder(x)) +
           c2 * (4.0 * (g + second_invariant_of_strain) - 3.0 * exp_remainder(2.0 * x)) +
           2.0 * lambda * L * L;
  }

  /// The stress P = 2 F [(c1 + c2 I1) I - c2 C - beta C^-1], beta = c1 I3^(1/3) + 2 c2 I3^(2/3) -
  /// lambda ln I3. It is computed with k = c1 + 2 c2 and b = beta - k as
  ///   P = 2 k (F - F^-T) + 4 c2 F (tr(E) I - E) - 2 b F^-T.
  /// F - F^-T is computed without cancellation, like in neo_hookean.cpp.
  template <class T>
  [[gnu::always_inline]] Tensor<T> stress(const Tensor<T>& H) const {
    const T theta = volume_change(H), L = log1p(theta);
    const T q = expm1((2.0 / 3.0) * L);  // I3^(1/3) - 1
    const Real k = c1 + 2 * c2;
    const T b = c1 * q + 2 * c2 * q * (2.0 + q) - 2 * lambda * L;
    const T two_over_J = 2.0 / (1.0 + theta);
    const T diagonal = two_over_J * (k * higher_volume_change(H) - b * (1.0 + trace(H)));
    const Tensor<T> volumetric = add_diagonal(
        T(2 * k) * H + (two_over_J * (k + b)) * (transpose(H) - cofactor(H)), diagonal);
    const Tensor<T> E = green_strain(H);
    const Tensor<T> D = add_diagonal(T(-4 * c2) * E, 4 * c2 * trace(E));
    return volumetric + (D + H * D);
  }

  /// The volumetric energy 2 lambda (ln J)^2 is convex up to J = e only.
  std::optional<std::string> warning(const Tensor<Real>& H) const {
    const Real J = 1 + volume_change(H);
    if (J < std::numbers::e) return {};
    return fmt::format(
        "the expansion J = {:.3g} is beyond e, where the volumetric energy of mooney_rivlin is no "
        "longer convex: it may lose ellipticity; use neo_hookean",
        J);
  }
};

const bool registered = register_law<MooneyRivlin>();

}  // namespace
}  // namespace meniscus
