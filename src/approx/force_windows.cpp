// SPDX-License-Identifier: BSD-3-Clause
// Chunks of rows, their windows of particles, and the ordered sum.
#include "meniscus/approx/force_windows.hpp"

namespace meniscus {

ForceWindows::ForceWindows(std::span<const Offset> start, std::span<const Index> particle,
                           Index particles) {
  const auto rows = static_cast<Index>(start.size()) - 1;
  for (int c = 0; c < chunk_count(rows); ++c) {
    Chunk chunk{c, chunk_begin(rows, c), chunk_begin(rows, c + 1), particles, 0, {}};
    if (chunk.begin == chunk.end) continue;
    for (Offset e = at(start, chunk.begin); e < at(start, chunk.end); ++e) {
      chunk.low = std::min(chunk.low, at(particle, e));
      chunk.high = std::max(chunk.high, at(particle, e) + 1);
    }
    chunk.sum.resize(static_cast<std::size_t>(std::max(0, chunk.high - chunk.low)));
    chunks_.push_back(std::move(chunk));
  }
}

void ForceWindows::add_to(std::span<NodalVector> force) const {
  for_chunks(static_cast<Index>(force.size()), [&](Index, Index begin, Index end) {
    for (const Chunk& chunk : chunks_) {
      const Index first = std::max(begin, chunk.low), last = std::min(end, chunk.high);
      for (Index A = first; A < last; ++A) at(force, A) += at(chunk.sum, A - chunk.low);
    }
  });
}

std::size_t ForceWindows::bytes() const {
  std::size_t n = 0;
  for (const Chunk& chunk : chunks_) n += chunk.sum.size() * sizeof(Lanes);
  return n;
}

}  // namespace meniscus
