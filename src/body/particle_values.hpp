// SPDX-License-Identifier: BSD-3-Clause
// Values of fields at the particles of a body. Each rank computes the values of its own rows; then
// all are gathered (scaling note 2.1).
#pragma once
#include "body/body.hpp"

#include <memory>
#include <span>

namespace meniscus {

/// sum_B N_B(X_A) c_B at each particle, [particle]. `c` has the coefficients of the body. All ranks
/// have to call this.
template <int D>
NodalVectors values_at_particles(const Body<D>& body, const NodalVector* c);
/// Like the function above for some particles in ascending order, [place in `which`].
template <int D>
NodalVectors values_at_particles(const Body<D>& body, const NodalVector* c,
                                 std::span<const Index> which);

/// The rows of all particles on each rank, for computations that are not divided between ranks. On
/// one rank these are the rows Body::at_particles; on several they take the memory that the
/// division saves. All ranks have to call this.
template <int D>
std::shared_ptr<const PointRows<D>> rows_of_all_particles(const Body<D>& body);

}  // namespace meniscus
