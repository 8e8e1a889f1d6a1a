// SPDX-License-Identifier: BSD-3-Clause
// A buffer of each thread, which is kept.
#include "parallel/thread_sums.hpp"

namespace meniscus {

NodalVector* thread_sums(Index particles) {
  thread_local UnsetVector<NodalVector> sums;  // pages that are not touched take no memory
  if (sums.size() < static_cast<std::size_t>(particles)) {
    sums.clear();
    sums.resize(static_cast<std::size_t>(particles));
  }
  return sums.data();
}

}  // namespace meniscus
