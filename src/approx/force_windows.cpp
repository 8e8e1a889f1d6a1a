// SPDX-License-Identifier: BSD-3-Clause
// Chunks of rows, their windows of particles, and the ordered sum.
#include "meniscus/approx/force_windows.hpp"

namespace meniscus {

ForceWindows::ForceWindows(std::span<const Offset> start, std::span<const Index> particle,
                           Index particles) {
  const auto rows = static_cast<Index>(start.size()) - 1;
  Offset size = 0;
  for (int c = 0; c < chunk_count(rows); ++c) {
    WindowChunk chunk{c, chunk_begin(rows, c), chunk_begin(rows, c + 1), particles, 0, size};
    if (chunk.begin == chunk.end) continue;
    for (Offset e = at(start, chunk.begin); e < at(start, chunk.end); ++e) {
      chunk.low = std::min(chunk.low, at(particle, e));
      chunk.high = std::max(chunk.high, at(particle, e) + 1);
    }
    chunk.high = std::max(chunk.high, chunk.low);
    size += window_length(chunk);
    own_.push_back(chunk);
  }
  chunks_ = own_.empty() ? 0 : own_.back().number + 1;
  summed_ = own_;
  pairs_ = start.empty() ? 0 : start.back();
  if (!ranks().alone()) {
    shared_ = std::make_shared<SharedWindows>(own_, start, particle, particles);
    own_ = shared_->own();
    summed_ = shared_->summed();
    pairs_ = shared_->pairs();
    size = shared_->size();
  }
  sums_.resize(static_cast<std::size_t>(size));
}

void ForceWindows::add_to(std::span<NodalVector> force) const {
  for_chunks(static_cast<Index>(force.size()), [&](Index, Index begin, Index end) {
    for (const WindowChunk& chunk : summed_) {
      const Index first = std::max(begin, chunk.low), last = std::min(end, chunk.high);
      const NodalVector* sum = sums_.data() + (chunk.sum - chunk.low);
      for (Index A = first; A < last; ++A) at(force, A) += sum[A];
    }
  });
}

}  // namespace meniscus
