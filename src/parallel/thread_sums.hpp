// SPDX-License-Identifier: BSD-3-Clause
// A buffer of each thread for the forces of one chunk: a vector for each particle of a body. A
// chunk touches few of them.
#pragma once
#include "parallel/aligned.hpp"

namespace meniscus {

/// The buffer of the calling thread with at least `particles` vectors, whose values are left from
/// earlier use. Valid until the thread calls this with a larger number.
NodalVector* thread_sums(Index particles);

}  // namespace meniscus
