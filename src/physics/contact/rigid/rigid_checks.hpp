// SPDX-License-Identifier: BSD-3-Clause
// Checks the numbers of rigid partners.
#pragma once
#include "meniscus/error.hpp"
#include "physics/contact/contact_law.hpp"

#include <string>

namespace meniscus {

/// A plane and a ball in the plane also know the kernel of space, for bodies of revolution
/// (`revolves`).
template <int D>
void require_kernel(const ContactLaw& law, const std::string& partner, bool revolves = false) {
  if (dimension_of(law.kernel) != D && !(revolves && dimension_of(law.kernel) == 3))
    throw InputError("a rigid " + partner + " in " + std::to_string(D) +
                     " dimensions cannot have the kernel '" + std::string(name_of(law.kernel)) +
                     "'; allowed is " + (D == 3 ? "'space'" : "'integrated' or 'planar'"));
}

inline void require_positive(Real size, const std::string& what) {
  if (!(size > 0)) throw InputError(what + " must be > 0, not " + std::to_string(size));
}

}  // namespace meniscus
