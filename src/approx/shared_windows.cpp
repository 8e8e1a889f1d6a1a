// SPDX-License-Identifier: BSD-3-Clause
// Which rank does which chunks and adds up the windows over which particles.
#include "meniscus/approx/shared_windows.hpp"

#include "meniscus/core/divided.hpp"

#include <algorithm>

namespace meniscus {

SharedWindows::SharedWindows(std::vector<WindowChunk> chunks, std::span<const Offset> start,
                             std::span<const Index> particle, Index particles) {
  find_windows(chunks, start);
  // As all rows of the body, whoever does these: what a rank adds up it has to follow.
  for (int rank = 0; rank <= ranks().size(); ++rank) border_.push_back(first_row(particles, rank));
  numbers_ = chunks.empty() ? 0 : chunks.back().number + 1;
  const Touched of_chunks = touched(chunks, start, particle);
  share_windows(chunks, of_chunks);
  remember_touched(chunks, of_chunks);
  particles_ = exchange_of_forces([](Index) { return true; });
  share_results(chunks);
}

/// Who does which chunk is known before its rows are.
void SharedWindows::find_windows(std::vector<WindowChunk>& chunks, std::span<const Offset> start) {
  struct Reach {
    Index low, high;
    Offset pairs;
  };
  const auto rows = static_cast<Index>(start.size()) - 1;
  const int count = chunk_count(rows);
  std::vector<Reach> reach(static_cast<std::size_t>(count));
  for (const WindowChunk& chunk : chunks) {
    rank_.push_back(rank_of_item(count, chunk.number));
    if (rank_.back() == ranks().rank())
      at(reach, chunk.number) = {chunk.low, chunk.high,
                                 at(start, chunk.end) - at(start, chunk.begin)};
  }
  complete_items(count, reach.data(), sizeof reach[0]);
  for (WindowChunk& chunk : chunks) {
    const Reach& found = at(reach, chunk.number);
    chunk.low = found.low;
    chunk.high = found.high;
    pairs_ += found.pairs;
  }
}

SharedWindows::Touched SharedWindows::touched(const std::vector<WindowChunk>& chunks,
                                              std::span<const Offset> start,
                                              std::span<const Index> particle) const {
  constexpr Index bits = 8;
  Touched of_chunks;
  std::vector<std::uint8_t> packed;
  for (std::size_t k = 0; k < chunks.size(); ++k) {
    const WindowChunk& chunk = chunks[k];
    const Index length = chunk.high - chunk.low;
    packed.assign(static_cast<std::size_t>((length + bits - 1) / bits), 0);
    if (rank_[k] == ranks().rank())
      for (Offset e = at(start, chunk.begin); e < at(start, chunk.end); ++e) {
        const Index A = at(particle, e) - chunk.low;
        at(packed, A / bits) |= static_cast<std::uint8_t>(1u << (A % bits));
      }
    ranks().hand_out(rank_[k], packed.data(), packed.size());
    std::vector<bool>& is = of_chunks.emplace_back(static_cast<std::size_t>(length));
    for (Index A = 0; A < length; ++A)
      is[static_cast<std::size_t>(A)] = (at(packed, A / bits) >> (A % bits)) & 1;
  }
  return of_chunks;
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
    for (Index A = part.low; A < part.high; ++A)
      if (touched[k][static_cast<std::size_t>(A - chunk.low)])
        leaves.push_back({static_cast<Index>(part.sum + A - part.low), rank_[k],
                          static_cast<Index>(root[k] + A - chunk.low)});
    size_ += window_length(part);
  }
  windows_ = ranks().exchange(static_cast<Index>(at(used, me)), leaves);
}

void SharedWindows::remember_touched(const std::vector<WindowChunk>& chunks,
                                     const Touched& touched) {
  touched_.assign(static_cast<std::size_t>(border_.back()), 0);
  for (std::size_t k = 0; k < chunks.size(); ++k) {
    const std::uint8_t bits = by_a_rank | (rank_[k] == ranks().rank() ? by_this_rank : 0);
    for (std::size_t A = 0; A < touched[k].size(); ++A)
      if (touched[k][A]) touched_[static_cast<std::size_t>(chunks[k].low) + A] |= bits;
  }
}

template <class F>
std::unique_ptr<Exchange> SharedWindows::exchange_of_forces(F&& is_wanted) const {
  std::vector<Leaf> leaves;
  for (int rank = 0; rank < ranks().size(); ++rank)
    for (Index A = at(border_, rank); A < at(border_, rank + 1); ++A)
      if (rank != ranks().rank() && at(touched_, A) != 0 && is_wanted(A))
        leaves.push_back({A, rank, A});
  return ranks().exchange(border_.back(), leaves);
}

void SharedWindows::mark_touched(std::span<std::uint8_t> particles) const {
  for (Index A = 0; A < border_.back(); ++A)
    if ((at(touched_, A) & by_this_rank) != 0) at(particles, A) = 1;
}

void SharedWindows::mark_summed(std::span<std::uint8_t> particles) const {
  const int me = ranks().rank();
  for (Index A = at(border_, me); A < at(border_, me + 1); ++A) at(particles, A) = 1;
}

void SharedWindows::keep_to(std::shared_ptr<const Halo> halo, Index first) {
  halo_ = std::move(halo);
  followed_ = exchange_of_forces([&](Index A) { return halo_->follows(first + A); });
}

void SharedWindows::share_results(const std::vector<WindowChunk>& chunks) {
  std::vector<Leaf> leaves;
  for (std::size_t k = 0; k < chunks.size(); ++k) {
    if (rank_[k] == ranks().rank()) continue;
    foreign_.push_back(chunks[k].number);
    leaves.push_back({chunks[k].number, rank_[k], chunks[k].number});
  }
  chunks_ = ranks().exchange(numbers_, leaves);
}

}  // namespace meniscus
