// SPDX-License-Identifier: BSD-3-Clause
// Assigns chunks and sums over particles to ranks.
#include "parallel/divided_sums.hpp"

#include <algorithm>

namespace meniscus {

DividedSums::DividedSums(std::vector<RowChunk> chunks, std::span<const Index> touched,
                         std::span<const Offset> start, Index particles, const Division& division) {
  // The particles are divided like the rows of the body: a rank follows the particles that it adds
  // up.
  for (int rank = 0; rank <= ranks().size(); ++rank)
    border_.push_back(division.first_row(particles, rank));
  const Touched by_chunks = touched_by_chunks(chunks, touched, start, division);
  exchange_of_sums(chunks, by_chunks);
  remember_touched(by_chunks);
}

/// Gathers the particles that chunks touch. The rank of each chunk is known before its rows are.
DividedSums::Touched DividedSums::touched_by_chunks(const std::vector<RowChunk>& chunks,
                                                    std::span<const Index> touched,
                                                    std::span<const Offset> start,
                                                    const Division& division) {
  struct Size {
    Index sums;
    Offset pairs;
  };
  const int count = chunk_count(static_cast<Index>(start.size()) - 1);
  std::vector<Size> size(static_cast<std::size_t>(count));
  for (const RowChunk& chunk : chunks) {
    rank_.push_back(division.rank_of_item(count, chunk.number));
    if (rank_.back() == ranks().rank())
      at(size, chunk.number) = {chunk.sum_end - chunk.sum,
                                at(start, chunk.end) - at(start, chunk.begin)};
  }
  division.complete_items(count, size.data(), sizeof size[0]);
  Touched by_chunks;
  for (std::size_t k = 0; k < chunks.size(); ++k) {
    const Size& found = at(size, chunks[k].number);
    pairs_ += found.pairs;
    std::vector<Index>& particles = by_chunks.emplace_back(static_cast<std::size_t>(found.sums));
    if (rank_[k] == ranks().rank())
      std::copy_n(touched.begin() + chunks[k].sum, found.sums, particles.begin());
    ranks().hand_out(rank_[k], particles.data(), particles.size() * sizeof(Index));
  }
  return by_chunks;
}

/// Sums of a rank are numbered with its own chunks first, then received ones.
void DividedSums::exchange_of_sums(const std::vector<RowChunk>& chunks, const Touched& touched) {
  const int me = ranks().rank();
  const ItemRange particles = summed_particles();
  std::vector<Index> root(chunks.size());
  std::vector<Index> used(border_.size(), 0);
  for (std::size_t k = 0; k < chunks.size(); ++k) {
    root[k] = at(used, rank_[k]);
    at(used, rank_[k]) += static_cast<Index>(touched[k].size());
  }
  size_ = at(used, me);
  std::vector<Leaf> leaves;
  for (std::size_t k = 0; k < chunks.size(); ++k) {
    const bool mine = rank_[k] == me;
    if (mine) {
      own_.push_back(chunks[k]);
      own_.back().sum = root[k];
      own_.back().sum_end = root[k] + static_cast<Index>(touched[k].size());
    }
    const auto first = std::lower_bound(touched[k].begin(), touched[k].end(), particles.begin);
    const auto last = std::lower_bound(first, touched[k].end(), particles.end);
    for (auto A = first; A != last; ++A) {
      const Index sum = root[k] + static_cast<Index>(A - touched[k].begin());
      summed_.push_back({*A, mine ? sum : size_});
      if (!mine) leaves.push_back({size_++, rank_[k], sum});
    }
  }
  chunk_sums_ = ranks().exchange(at(used, me), leaves);
}

void DividedSums::remember_touched(const Touched& touched) {
  touched_.assign(static_cast<std::size_t>(border_.back()), 0);
  for (std::size_t k = 0; k < touched.size(); ++k)
    if (rank_[k] == ranks().rank())
      for (const Index A : touched[k]) at(touched_, A) = 1;
}

void DividedSums::mark_touched(std::span<std::uint8_t> particles) const {
  for (Index A = 0; A < border_.back(); ++A)
    if (at(touched_, A)) at(particles, A) = 1;
}

void DividedSums::mark_summed(std::span<std::uint8_t> particles) const {
  const ItemRange summed = summed_particles();
  std::fill(particles.begin() + summed.begin, particles.begin() + summed.end, std::uint8_t{1});
}

}  // namespace meniscus
