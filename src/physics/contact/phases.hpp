// SPDX-License-Identifier: BSD-3-Clause
// The phases of a contact, which a few processes may do alone.
#pragma once
#include "meniscus/physics/force_term.hpp"
#include "parallel/shared_work.hpp"

namespace meniscus {

/// Gathers arrays, unless this process needs none of other processes, and goes on with the next
/// phase of a term, (term.*next)(motion, force).
template <auto next, class Term>
Report go_on(Term& term, const SharedWork& work, std::span<const Gathered> arrays,
             const Motion& motion, const Forces& force) {
  if (work.is_of_few()) return (term.*next)(motion, force);
  return force.gather(arrays, motion,
                      [&term](const Motion& m, const Forces& all) { return (term.*next)(m, all); });
}

}  // namespace meniscus
