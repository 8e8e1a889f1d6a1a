// SPDX-License-Identifier: BSD-3-Clause
// A material law of another program: W = lambda/2 tr^2 E + mu E:E, as st_venant_kirchhoff, with
// which its results are compared.
#include <meniscus/physics/law_registry.hpp>

namespace {

using namespace meniscus;

struct OwnSolid {
  static constexpr std::string_view type_name = "own_solid";
  static constexpr std::string_view meaning = "W = lambda/2 tr^2 E + mu E:E";
  static constexpr bool viscous = false;
  Real density, mu, lambda;

  static Rows<OwnSolid> rows() {
    return {parameter_row<OwnSolid>("density", &OwnSolid::density, dimension::density,
                                    range::positive, "mass per reference volume", 1),
            parameter_row<OwnSolid>("mu", &OwnSolid::mu, dimension::pressure, range::positive,
                                    "shear modulus", 1),
            parameter_row<OwnSolid>("lambda", &OwnSolid::lambda, dimension::pressure, range::any,
                                    "first Lame parameter", 1)};
  }

  template <class T>
  T energy_density(const Tensor<T>& H) const {
    const Tensor<T> E = green_strain(H);
    return 0.5 * lambda * trace(E) * trace(E) + mu * contract(E, E);
  }
  template <class T>
  Tensor<T> stress(const Tensor<T>& H) const {
    const Tensor<T> E = green_strain(H);
    const Tensor<T> S = add_diagonal(T(2 * mu) * E, lambda * trace(E));
    return S + H * S;
  }
  Real p_wave_modulus() const { return lambda + 2 * mu; }
  Real bulk_over_shear() const { return lambda / mu + 2.0 / 3.0; }
};

const bool registered = register_law<OwnSolid>();

}  // namespace
