// SPDX-License-Identifier: BSD-3-Clause
// Several ranks in one process, a thread for each. Unit tests use them.
#pragma once
#include <functional>

namespace meniscus {

/// Calls work() once for each of `size` ranks of one run, at the same time. In each call, ranks()
/// returns the rank of the call, collective functions exchange data with the other calls, and loops
/// use one thread. If calls throw, rethrows the exception of the first rank that failed on its own;
/// ranks that wait for it end, too.
void as_ranks(int size, const std::function<void()>& work);

}  // namespace meniscus
