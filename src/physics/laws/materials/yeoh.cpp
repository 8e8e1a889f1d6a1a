// SPDX-License-Identifier: BSD-3-Clause
// Yeoh's rubber, a polynomial of the isochoric first invariant (Yeoh 1993). With c2 = c3 = 0 it is
// the isochoric neo-Hookean solid.
//
//   W = c1 (I - 3) + c2 (I - 3)^2 + c3 (I - 3)^3 + K/2 (J - 1)^2,   I = J^(-2/3) tr F^T F
#include "meniscus/physics/law_registry.hpp"
#include "physics/internal/elastic_moduli.hpp"

namespace meniscus {
namespace {

struct Yeoh {
  static constexpr std::string_view type_name = "yeoh";
  static constexpr std::string_view meaning =
      "W = c1 (I - 3) + c2 (I - 3)^2 + c3 (I - 3)^3 + K/2 (J - 1)^2, I = J^(-2/3) tr F^T F; the "
      "isochoric neo-Hookean solid without c2 and c3";
  static constexpr bool viscous = false;
  static constexpr OfModuli of_moduli[] = {{"c1", "{E}/(4*(1 + {nu}))"},
                                           {"bulk_modulus", "{E}/(3*(1 - 2*{nu}))"}};
  Real density, c1, c2, c3, bulk_modulus;

  static Rows<Yeoh> rows() {
    using L = Yeoh;
    return {parameter_row<L>("density", &L::density, dimension::density, range::positive,
                             "mass per reference volume", 1.25),
            parameter_row<L>("c1", &L::c1, dimension::pressure, range::positive,
                             "half of the shear modulus", 0.375),
            parameter_row<L>("c2", &L::c2, dimension::pressure, range::any, "factor of (I - 3)^2",
                             0.02, 0.0),
            parameter_row<L>("c3", &L::c3, dimension::pressure, range::any, "factor of (I - 3)^3",
                             0.005, 0.0),
            parameter_row<L>("bulk_modulus", &L::bulk_modulus, dimension::pressure, range::positive,
                             "K", 1.5)};
  }

  Real p_wave_modulus() const { return bulk_modulus + 8.0 / 3.0 * c1; }
  Real bulk_over_shear() const { return bulk_modulus / (2 * c1); }

  /// J - 1, s - 1 with s = J^(-2/3), tr E, and I - 3. With x = ln s and tr E - ln J = H:H/2 - ...,
  /// I - 3 = 2 (tr E - ln J) + 3 (e^x - 1 - x) + 2 tr E (e^x - 1) has no parts of first order.
  template <class T>
  struct Invariant {
    T change, less_1, strain, value;
    [[gnu::always_inline]] explicit Invariant(const Tensor<T>& H)
        : change(volume_change(H)), strain(trace(green_strain(H))) {
      const T x = (-2.0 / 3.0) * log1p(change);
      less_1 = expm1(x);
      value = 2.0 * (0.5 * contract(H, H) - higher_volume_change(H) - log1p_remainder(change)) +
              3.0 * exp_remainder(x) + 2.0 * strain * less_1;
    }
  };

  template <class T>
  T energy_density(const Tensor<T>& H) const {
    const Invariant<T> I(H);
    return I.value * (c1 + I.value * (c2 + c3 * I.value)) +
           0.5 * bulk_modulus * I.change * I.change;
  }

  /// P = 2 W' s [F - (1 + 2/3 tr E) F^-T] + K (J - 1) cof F, W' = dW/dI. With F^-T = ((1 + tr H) I
  /// - H^T + cof H)/J no terms of order one cancel.
  template <class T>
  [[gnu::always_inline]] Tensor<T> stress(const Tensor<T>& H) const {
    const Invariant<T> I(H);
    const T slope = 2.0 * (1.0 + I.less_1) * (c1 + I.value * (2 * c2 + 3 * c3 * I.value));
    const T strain = (2.0 / 3.0) * I.strain, over_J = 1.0 / (1.0 + I.change);
    const T a = slope * (1.0 + strain) * over_J, b = bulk_modulus * I.change;
    const T diagonal = slope * over_J * (higher_volume_change(H) - strain * (1.0 + trace(H))) +
                       b * (1.0 + trace(H));
    return add_diagonal(slope * H + (a - b) * (transpose(H) - cofactor(H)), diagonal);
  }
};

const bool registered = register_law<Yeoh>();

}  // namespace
}  // namespace meniscus
