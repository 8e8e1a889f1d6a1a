// SPDX-License-Identifier: BSD-3-Clause
// Finds the force that limits the stable step, for messages.
#pragma once
#include "solve/system.hpp"

#include <span>
#include <string>

namespace meniscus {

/// Describes the term whose force changes most along `mode` [particle] at the given state: its
/// name, its share of the stiffness of the mode, and a remedy. Empty if no term has a stiffness.
/// For runs that have to end, since it costs two evaluations of all forces. All processes must call
/// this.
template <int D>
std::string describe_stiffest_term(System<D>& system, const State& state,
                                   std::span<const NodalVector> mode, Real size);

}  // namespace meniscus
