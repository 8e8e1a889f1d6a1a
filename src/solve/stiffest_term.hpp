// SPDX-License-Identifier: BSD-3-Clause
// Which force makes the stable step as short as it is, for messages.
#pragma once
#include "solve/system.hpp"

#include <span>
#include <string>

namespace meniscus {

/// Names the term whose force changes most along `mode` [particle] at the state, its share of the
/// stiffness of that mode, and what can be done about it. Empty if no term has a stiffness. Used
/// when a run has to end: costs two evaluations of all forces. All ranks call this.
template <int D>
std::string describe_stiffest_term(System<D>& system, const State& state,
                                   std::span<const NodalVector> mode, Real size);

}  // namespace meniscus
