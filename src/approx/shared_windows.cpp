// SPDX-License-Identifier: BSD-3-Clause
// Which rank does which chunks and adds up the windows over which particles.
#include "meniscus/approx/shared_windows.hpp"

#include <algorithm>

namespace meniscus {
namespace {

std::vector<std::vector<Index>> touched_particles(const std::vector<WindowChunk>& chunks,
                                                  std::span<const Offset> start,
                                                  std::span<const Index> particle) {
  std::vector<std::vector<Index>> touched;
  for (const WindowChunk& chunk : chunks) {
    std::vector<bool> is(static_cast<std::size_t>(std::max(0, chunk.high - chunk.low)), false);
    for (Offset e = at(start, chunk.begin); e < at(start, chunk.end); ++e)
      is[static_cast<std::size_t>(at(particle, e) - chunk.low)] = true;
    std::vector<Index>& all = touched.emplace_back();
    for (Index A = chunk.low; A < chunk.high; ++A)
      if (is[static_cast<std::size_t>(A - chunk.low)]) all.push_back(A);
  }
  return touched;
}

}  // namespace

SharedWindows::SharedWindows(const std::vector<WindowChunk>& chunks, std::span<const Offset> start,
                             std::span<const Index> particle, Index particles) {
  divide(chunks, particles);
  const Touched touched = touched_particles(chunks, start, particle);
  share_windows(chunks, touched);
  share_particles(touched);
  share_rows(chunks);
}

/// Chunks, which have the same number of rows but for one, evenly; the particles half-way between
/// what the chunks on both sides reach.
void SharedWindows::divide(const std::vector<WindowChunk>& chunks, Index particles) {
  const int size = ranks().size();
  const auto count = static_cast<Index>(chunks.size());
  border_.push_back(0);
  for (int rank = 0; rank < size; ++rank) {
    const Index end = count * (rank + 1) / size;
    while (static_cast<Index>(rank_.size()) < end) rank_.push_back(rank);
    const Index middle = rank + 1 == size || end == count ? particles
                         : end == 0                       ? 0
                                    : (at(chunks, end).low + at(chunks, end - 1).high) / 2;
    border_.push_back(std::clamp(middle, border_.back(), particles));
  }
  numbers_ = count > 0 ? chunks.back().number + 1 : 0;
}

/// In the sums of each rank its own windows come first.
void SharedWindows::share_windows(const std::vector<WindowChunk>& chunks, const Touched& touched) {
  const int me = ranks().rank();
  const Index first = at(border_, me), last = at(border_, me + 1);
  std::vector<Offset> root(chunks.size());
  std::vector<Offset> used(border_.size(), 0);
  for (std::size_t k = 0; k < chunks.size(); ++k) {
    root[k] = at(used, rank_[k]);
    at(used, rank_[k]) += window_length(chunks[k]);
  }
  size_ = at(used, me);
  std::vector<Leaf> leaves;
  for (std::size_t k = 0; k < chunks.size(); ++k) {
    WindowChunk chunk = chunks[k];
    const bool mine = rank_[k] == me;
    chunk.sum = root[k];
    if (mine) own_.push_back(chunk);
    WindowChunk part = chunk;
    part.low = std::max(chunk.low, first);
    part.high = std::min(chunk.high, last);
    if (part.low >= part.high) continue;
    part.sum = mine ? chunk.sum + part.low - chunk.low : size_;
    summed_.push_back(part);
    if (mine) continue;
    for (const Index A : touched[k])
      if (first <= A && A < last)
        leaves.push_back({static_cast<Index>(part.sum + A - part.low), rank_[k],
                          static_cast<Index>(root[k] + A - chunk.low)});
    size_ += window_length(part);
  }
  windows_ = ranks().exchange(static_cast<Index>(at(used, me)), leaves);
}

void SharedWindows::share_particles(const Touched& touched) {
  const int me = ranks().rank();
  std::vector<bool> is(static_cast<std::size_t>(border_.back()), false);
  for (const auto& of_chunk : touched)
    for (const Index A : of_chunk) is[static_cast<std::size_t>(A)] = true;
  std::vector<Leaf> leaves;
  for (int rank = 0; rank < ranks().size(); ++rank)
    for (Index A = at(border_, rank); A < at(border_, rank + 1); ++A)
      if (rank != me && is[static_cast<std::size_t>(A)]) leaves.push_back({A, rank, A});
  particles_ = ranks().exchange(border_.back(), leaves);
}

void SharedWindows::share_rows(const std::vector<WindowChunk>& chunks) {
  std::vector<Leaf> of_chunks, of_rows;
  for (std::size_t k = 0; k < chunks.size(); ++k) {
    if (rank_[k] == ranks().rank()) continue;
    foreign_.push_back(chunks[k].number);
    of_chunks.push_back({chunks[k].number, rank_[k], chunks[k].number});
    for (Index row = chunks[k].begin; row < chunks[k].end; ++row)
      of_rows.push_back({row, rank_[k], row});
  }
  chunks_ = ranks().exchange(numbers_, of_chunks);
  rows_ = ranks().exchange(chunks.empty() ? 0 : chunks.back().end, of_rows);
}

}  // namespace meniscus
