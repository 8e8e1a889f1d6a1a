// SPDX-License-Identifier: BSD-3-Clause
// Parameters of isotropic solids with Lame's two moduli.
#pragma once
#include "physics/internal/elastic_moduli.hpp"
#include "physics/internal/law.hpp"

namespace meniscus {

/// Base of laws that have no other parameters.
struct LameSolid {
  static constexpr bool viscous = false;
  static constexpr OfModuli of_moduli[] = {{"mu", "{E}/(2*(1 + {nu}))"},
                                           {"lambda", "{E}*{nu}/((1 + {nu})*(1 - 2*{nu}))"}};
  Real density, mu, lambda;

  /// The rows of the law L.
  template <class L>
  static Rows<L> rows_of() {
    return {
        parameter_row<L>("density", &L::density, dimension::density, range::positive,
                         "mass per reference volume", 1.25),
        parameter_row<L>("mu", &L::mu, dimension::pressure, range::positive, "shear modulus", 0.75),
        parameter_row<L>("lambda", &L::lambda, dimension::pressure, range::any,
                         "first Lame parameter", 1.5)};
  }

  std::optional<std::string> check() const {
    if (lambda + 2.0 / 3.0 * mu > 0) return {};
    return "the bulk modulus lambda + 2/3 mu must be positive";
  }

  Real p_wave_modulus() const { return lambda + 2 * mu; }
  Real bulk_over_shear() const { return lambda / mu + 2.0 / 3.0; }
};

}  // namespace meniscus
