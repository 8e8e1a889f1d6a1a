// SPDX-License-Identifier: BSD-3-Clause
// What the numbers of a contact mean beside those of its bodies.
#pragma once
#include "meniscus/scene/assembly.hpp"

#include <string>
#include <vector>

namespace meniscus {

/// A contact as it begins.
template <int D>
struct BeginningContact {
  std::string name;
  std::vector<std::string> bodies;   ///< two, or one that touches a rigid partner
  Vec<D> partner_velocity;           ///< of the rigid one
  Real adhesion, greatest_pressure;  ///< of flat surfaces
};

/// Notes the pressure rho c v of an impact at the speed of the start beside the largest that the
/// contact holds, and the elastocapillary number W/(mu R) of its solids; warns where it is
/// overcome.
template <int D>
void advise(const BeginningContact<D>& contact, Assembly<D>& assembly);

}  // namespace meniscus
