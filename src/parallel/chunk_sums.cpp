// SPDX-License-Identifier: BSD-3-Clause
// Chunks of rows, the particles that they touch, and the addition of their sums in ascending order.
#include "parallel/chunk_sums.hpp"

#include <algorithm>
#include <numeric>

namespace meniscus {

namespace {

/// The distinct numbers in `particle`, ascending. All are below `particles`.
std::vector<Index> distinct(std::span<const Index> particle, Index particles) {
  thread_local std::vector<bool> found;
  if (found.size() < static_cast<std::size_t>(particles))
    found.resize(static_cast<std::size_t>(particles));
  std::vector<Index> numbers;
  for (const Index A : particle) {
    if (found[static_cast<std::size_t>(A)]) continue;
    found[static_cast<std::size_t>(A)] = true;
    numbers.push_back(A);
  }
  for (const Index A : numbers) found[static_cast<std::size_t>(A)] = false;
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

}  // namespace

ChunkSums::ChunkSums(std::span<const Offset> start, std::span<const Index> particle,
                     Index particles, const Division& division)
    : division_(division),
      chunks_(chunk_count(static_cast<Index>(start.size()) - 1)),
      particles_(particles),
      pairs_(start.empty() ? 0 : start.back()) {
  find_touched(start, particle);
  if (!ranks().alone()) {
    shared_ = std::make_shared<DividedSums>(own_, touched_, start, particles, division);
    own_ = shared_->own();
    pairs_ = shared_->pairs();
    order_by_particle(shared_->summed(), shared_->summed_particles());
    sums_.resize(static_cast<std::size_t>(shared_->size()));
    return;
  }
  std::vector<ChunkSum> sums;
  for (const Index A : touched_) sums.push_back({A, static_cast<Index>(sums.size())});
  order_by_particle(sums, {0, particles});
  sums_.resize(sums.size());
}

void ChunkSums::find_touched(std::span<const Offset> start, std::span<const Index> particle) {
  const auto rows = static_cast<Index>(start.size()) - 1;
  for (int c = 0; c < chunks_; ++c)
    if (chunk_begin(rows, c) < chunk_begin(rows, c + 1))
      own_.push_back({c, chunk_begin(rows, c), chunk_begin(rows, c + 1), 0, 0});
  std::vector<std::vector<Index>> touched(own_.size());
  parallel_for(
      static_cast<Index>(own_.size()),
      [&](Index c) {
        if (division_.rank_of_item(chunks_, at(own_, c).number) != ranks().rank()) return;
        const Offset begin = at(start, at(own_, c).begin), end = at(start, at(own_, c).end);
        at(touched, c) = distinct(particle.subspan(static_cast<std::size_t>(begin),
                                                   static_cast<std::size_t>(end - begin)),
                                  particles_);
      },
      1);
  for (std::size_t c = 0; c < own_.size(); ++c) {
    own_[c].sum = static_cast<Index>(touched_.size());
    touched_.insert(touched_.end(), touched[c].begin(), touched[c].end());
    own_[c].sum_end = static_cast<Index>(touched_.size());
  }
}

void ChunkSums::order_by_particle(const std::vector<ChunkSum>& sums, ItemRange particles) {
  summed_ = particles;
  sum_start_.assign(static_cast<std::size_t>(particles.end - particles.begin) + 1, 0);
  for (const ChunkSum& s : sums) ++at(sum_start_, s.particle - particles.begin + 1);
  std::partial_sum(sum_start_.begin(), sum_start_.end(), sum_start_.begin());
  std::vector<Index> next = sum_start_;
  sum_of_particle_.resize(sums.size());
  for (const ChunkSum& s : sums)
    at(sum_of_particle_, at(next, s.particle - particles.begin)++) = s.sum;
}

void ChunkSums::add_to(std::span<NodalVector> force) const {
  const Index first = summed_.begin;
  for_chunks(summed_.end - first, [&](Index, Index begin, Index end) {
    for (Index k = begin; k < end; ++k)
      for (Index s = at(sum_start_, k); s < at(sum_start_, k + 1); ++s)
        at(force, first + k) += at(sums_, at(sum_of_particle_, s));
  });
}

void ChunkSums::leave(const ForceVector& force) {
  force_ = force;
  if (!force.pending) return complete();
  if (!is_pending_) force.pending->waiting_.push_back(this);
  is_pending_ = true;
}

void ChunkSums::complete() {
  is_pending_ = false;
  if (shared_ && !division_.is_whole()) shared_->bring_sums(sums_);
  add_to(force_);
}

void PendingSums::complete() {
  for (ChunkSums* sums : waiting_)
    if (sums->is_pending_) sums->complete();
  waiting_.clear();
}

void PendingSums::forget() {
  for (ChunkSums* sums : waiting_) sums->is_pending_ = false;
  waiting_.clear();
}

}  // namespace meniscus
