// SPDX-License-Identifier: BSD-3-Clause
// Parameters of a nematic in addition to the parameters of its fluid.
#pragma once
#include "body/grid/stress_rules.hpp"

#include <vector>

namespace meniscus {

/// Parameters of the energy of the director h and of its rate in the carried material, h' = w h +
/// lambda d h - nu2 tr(d) h (w spin, d rate of deformation).
struct NematicNumbers {
  Real frank_constant = 0;        ///< K
  Real core_length = 0;           ///< eps
  Real rotational_viscosity = 0;  ///< gamma_1: resistance of h to relaxation, per volume
  Real flow_alignment = 0;        ///< lambda
  Real dilatation_coupling = 0;   ///< nu2
};

/// A nematic body, before its director is a field of the system.
template <int D>
struct NematicBody {
  NematicNumbers numbers;
  bool core_by_cells = false;    ///< the core length follows the size of the cells
  CellRule<D> rule;              ///< integration rule of the body
  std::vector<Real> volume;      ///< [particle] volume for the director
  std::vector<Vec<D>> director;  ///< [particle] initial director
};

}  // namespace meniscus
