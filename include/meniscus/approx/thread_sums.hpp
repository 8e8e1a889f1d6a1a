// SPDX-License-Identifier: BSD-3-Clause
// Where a thread adds up the forces of the rows of a chunk: a vector per particle of a body, of
// which it touches few.
#pragma once
#include "meniscus/core/aligned.hpp"

namespace meniscus {

/// Sums of the calling thread for that many particles, as it left them. Those of a body are valid
/// until the thread asks for more particles.
NodalVector* thread_sums(Index particles);

}  // namespace meniscus
