// SPDX-License-Identifier: BSD-3-Clause
// What a nematic is beside a fluid.
#pragma once
#include "meniscus/approx/stress_rules.hpp"

#include <vector>

namespace meniscus {

/// In the rate of the director h that the material carries, h' = w h + lambda d h - nu2 tr(d) h
/// (w spin, d rate of deformation), and in its energy.
struct NematicNumbers {
  Real frank_constant = 0;        ///< K
  Real core_length = 0;           ///< eps
  Real rotational_viscosity = 0;  ///< gamma_1: resistance of h to relaxation, per volume
  Real flow_alignment = 0;        ///< lambda
  Real dilatation_coupling = 0;   ///< nu2
};

/// The nematic of a body, before its director is a field of the system.
template <int D>
struct NematicBody {
  NematicNumbers numbers;
  CellRule<D> rule;              ///< of the body
  std::vector<Real> volume;      ///< of each particle, that its director has
  std::vector<Vec<D>> director;  ///< at the start, at each particle
};

}  // namespace meniscus
