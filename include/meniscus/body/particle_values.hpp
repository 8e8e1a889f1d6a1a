// SPDX-License-Identifier: BSD-3-Clause
// Values of fields at the particles of a body. Each rank computes those of its own rows and knows
// all of them afterwards (scaling note 2.1).
#pragma once
#include "meniscus/body/body.hpp"

#include <memory>
#include <span>

namespace meniscus {

/// [particle] sum_B N_B(X_A) c_B; `c` is that of the body. All ranks call it.
template <int D>
NodalVectors values_at_particles(const Body<D>& body, const NodalVector* c);
/// The same of some particles, ascending.
template <int D>
NodalVectors values_at_particles(const Body<D>& body, const NodalVector* c,
                                 std::span<const Index> which);

/// The rows of all particles on this rank, for what is not divided between ranks: the memory that
/// `Body::at_particles` saves; of a run on one rank, those of the body itself. All ranks call it.
template <int D>
std::shared_ptr<const PointRows<D>> rows_of_all_particles(const Body<D>& body);

}  // namespace meniscus
