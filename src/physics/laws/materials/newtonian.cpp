// SPDX-License-Identifier: BSD-3-Clause
// Compressible Newtonian fluid: mean stress U'(J) by an equation of state, viscous Cauchy stress
// 2 mu d + lambda_v tr(d) I (constitutive note 2).
#include "meniscus/physics/law_registry.hpp"

#include <array>

namespace meniscus {
namespace {

/// Equations of state: energy per reference volume U and mean stress sigma_m = -p = U'(J). U''(1) =
/// kappa in each:
///   linear  U = kappa/2 (J - 1)^2;                             sigma_m = kappa (J - 1);
///   log     U = kappa (J ln J - J + 1);                        sigma_m = kappa ln J;
///   tait    U = kappa/n [(J^(1-n) - 1)/(n - 1) + J - 1];       sigma_m = -kappa/n (J^-n - 1).
enum class EquationOfState { linear, log, tait };
constexpr std::array<const char*, 3> equation_names{"linear", "log", "tait"};

struct Newtonian {
  static constexpr std::string_view type_name = "newtonian";
  static constexpr std::string_view meaning =
      "a viscous liquid; U(J) = kappa/2 (J - 1)^2 (linear), kappa (J ln J - J + 1) (log), or that "
      "of Tait, and the Cauchy stress 2 mu d + (bulk_viscosity - 2/3 mu) tr(d) I";
  static constexpr bool viscous = true;
  Real density, bulk_modulus, exponent, viscosity, bulk_viscosity;
  EquationOfState equation_of_state = EquationOfState::log;

  static Rows<Newtonian> rows() {
    using L = Newtonian;
    return {
        parameter_row<L>("density", &L::density, dimension::density, range::positive,
                         "mass per reference volume", 1.25),
        parameter_row<L>("bulk_modulus", &L::bulk_modulus, dimension::pressure, range::positive,
                         "kappa of the equation of state; density c^2", 2.5),
        equation_row(),
        parameter_row<L>("exponent", &L::exponent, dimension::none, {1, unbounded, true},
                         "n of the equation of state tait, about 7 for water", 7, 7),
        parameter_row<L>("viscosity", &L::viscosity, dimension::viscosity, range::non_negative,
                         "shear viscosity mu", 0.5),
        parameter_row<L>("bulk_viscosity", &L::bulk_viscosity, dimension::viscosity,
                         range::non_negative, "lambda_v + 2/3 mu; 0 is a Stokes fluid", 0.25, 0)};
  }

  Real p_wave_modulus() const { return bulk_modulus; }
  bool inviscid() const { return viscosity == 0 && bulk_viscosity == 0; }

  /// U(1 + theta).
  template <class T>
  T volumetric_energy(T theta) const {
    switch (equation_of_state) {
      case EquationOfState::linear:
        return 0.5 * bulk_modulus * theta * theta;
      case EquationOfState::log:
        return bulk_modulus * (theta * log1p(theta) + log1p_remainder(theta));
      case EquationOfState::tait:
        break;
    }
    const Real m = exponent - 1;
    return bulk_modulus / exponent *
           (exp_remainder(-m * log1p(theta)) / m - log1p_remainder(theta));
  }

  /// U'(1 + theta). All points of a body take the same branch.
  template <class T>
  [[gnu::always_inline]] T mean_stress(T theta) const {
    switch (equation_of_state) {
      case EquationOfState::linear:
        return bulk_modulus * theta;
      case EquationOfState::log:
        return bulk_modulus * log1p(theta);
      case EquationOfState::tait:
        break;
    }
    return -bulk_modulus / exponent * expm1(-exponent * log1p(theta));
  }

  /// The exponent m in U'' = kappa J^(m - 2).
  Real volumetric_degree() const {
    switch (equation_of_state) {
      case EquationOfState::linear:
        return 2;
      case EquationOfState::log:
        return 1;
      case EquationOfState::tait:
        break;
    }
    return 1 - exponent;
  }

  template <class T>
  T energy_density(const Tensor<T>& H) const {
    return volumetric_energy(volume_change(H));
  }

  /// P = U'(J) cof F.
  template <class T>
  [[gnu::always_inline]] Tensor<T> stress(const Tensor<T>& H) const {
    return mean_stress(volume_change(H)) * cofactor_of_deformation(H);
  }

  /// P = sigma_v cof F with d from l = dF/dt F^-1 = M/J, M = dF/dt (cof F)^T.
  template <class T>
  [[gnu::always_inline]] Tensor<T> viscous_stress(const Tensor<T>& H,
                                                  const Tensor<T>& F_rate) const {
    const Tensor<T> cof_F = cofactor_of_deformation(H);
    const Tensor<T> M = F_rate * transpose(cof_F);
    const T over_J = 1.0 / (1.0 + volume_change(H));
    const T shear = viscosity * over_J,
            dilatation = (bulk_viscosity - 2.0 / 3.0 * viscosity) * over_J;
    return add_diagonal(shear * (M + transpose(M)), dilatation * trace(M)) * cof_F;
  }

 private:
  static Row<Newtonian> equation_row() {
    Row<Newtonian> row;
    row.key = "equation_of_state";
    row.type = "text";
    row.unit = "";
    row.range = "linear | log | tait";
    row.fallback = "log";
    row.meaning = "how the pressure depends on J; equal to first order";
    row.read = [](Newtonian& fluid, const Block& block) {
      const std::vector<std::string> names(equation_names.begin(), equation_names.end());
      const std::string name = block.choice("equation_of_state", names, "log");
      for (std::size_t i = 0; i < names.size(); ++i)
        if (names[i] == name) fluid.equation_of_state = static_cast<EquationOfState>(i);
    };
    return row;
  }
};

const bool registered = register_law<Newtonian>();

}  // namespace
}  // namespace meniscus
