// SPDX-License-Identifier: BSD-3-Clause
// Springs and dampers between a body and prescribed positions.
#pragma once
#include "body/body.hpp"
#include "input/ramp.hpp"
#include "meniscus/physics/force_term.hpp"

#include <memory>

namespace meniscus {

/// Springs on the mean displacements u_k = sum_A C_kA u_A, with the energy E = sum K_k |u_k -
/// g_k|^2 / 2. The sum contains only the components that have springs. Dampers add the forces - c_k
/// u_k'.
template <int D>
struct Springs {
  PointRows<D> mean;                     ///< [spring] C_kA
  std::vector<Real> stiffness, damping;  ///< [spring] K_k, c_k
  std::vector<Vec<D>> displacement;      ///< [spring] g_k at the end of the ramp
  Vec<D> components = Vec<D>::Ones();    ///< 1 for components with springs, else 0
  Ramp ramp;
};

template <int D>
std::unique_ptr<ForceTerm> spring(const Body<D>& body, std::string label, Springs<D> springs);

}  // namespace meniscus
