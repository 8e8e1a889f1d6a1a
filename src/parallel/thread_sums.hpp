// SPDX-License-Identifier: BSD-3-Clause
// A buffer per thread for the forces of one chunk, with one vector per particle of a body. A chunk
// uses few of them.
#pragma once
#include "parallel/aligned.hpp"

namespace meniscus {

/// Returns the buffer of the calling thread with at least `particles` vectors. Their values are
/// arbitrary (left from earlier use). The pointer is valid until the thread calls this function
/// with a larger number.
NodalVector* thread_sums(Index particles);

}  // namespace meniscus
