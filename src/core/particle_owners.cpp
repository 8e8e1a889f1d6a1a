// SPDX-License-Identifier: BSD-3-Clause
// Owners of the chunks of all particles, and exchanges by them.
#include "meniscus/core/particle_owners.hpp"

#include <algorithm>

namespace meniscus {

ParticleOwners::ParticleOwners(Index n, std::span<const Index> first)
    : n_(n), first_(first.begin(), first.end()) {
  std::vector<Leaf> leaves;
  std::size_t body = 0;
  for (int c = 0; c < chunk_count(n); ++c) {
    const OwnItems chunk{chunk_begin(n, c), chunk_begin(n, c + 1)};
    if (chunk.begin == chunk.end) continue;
    const Index middle = chunk.begin + (chunk.end - chunk.begin) / 2;
    while (body + 1 < first.size() && first[body + 1] <= middle) ++body;
    const Index begin = first[body], end = body + 1 < first.size() ? first[body + 1] : n;
    const int owner = rank_of_row(end - begin, middle - begin);
    if (owner == ranks().rank())
      own_chunks_.push_back(c);
    else
      leaves.push_back({c, owner, c});
    if (!runs_.empty() && runs_.back().owner == owner)
      runs_.back().particles.end = chunk.end;
    else
      runs_.push_back({chunk, owner});
  }
  for (const Run& run : runs_)
    if (run.owner == ranks().rank()) own_.push_back(run.particles);
  chunks_ = ranks().exchange(chunk_count(n), leaves);
}

int ParticleOwners::owner(Index A) const {
  return std::upper_bound(runs_.begin(), runs_.end(), A,
                          [](Index a, const Run& run) { return a < run.particles.end; })
      ->owner;
}

int ParticleOwners::adds_up(Index A) const {
  const auto next = std::upper_bound(first_.begin(), first_.end(), A);
  const Index begin = *(next - 1), end = next == first_.end() ? n_ : *next;
  return rank_of_row(end - begin, A - begin);
}

void ParticleOwners::complete_chunks(void* values, std::size_t bytes_per_value) const {
  chunks_->bring(values, values, bytes_per_value);
}

void ParticleOwners::complete(void* values, std::size_t bytes_per_value) const {
  auto* bytes = static_cast<std::byte*>(values);
  for (const Run& run : runs_) {
    const std::size_t begin = static_cast<std::size_t>(run.particles.begin) * bytes_per_value,
                      end = static_cast<std::size_t>(run.particles.end) * bytes_per_value;
    ranks().hand_out(run.owner, bytes + begin, end - begin);
  }
}

}  // namespace meniscus
