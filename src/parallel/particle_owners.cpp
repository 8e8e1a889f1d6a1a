// SPDX-License-Identifier: BSD-3-Clause
// The owners of the chunks of all particles, and exchanges between them.
#include "parallel/particle_owners.hpp"

#include <algorithm>

namespace meniscus {

ParticleOwners::ParticleOwners(Index n, std::vector<Index> first, std::vector<Division> division)
    : n_(n), first_(std::move(first)), division_(std::move(division)) {
  for (int c = 0; c < chunk_count(n); ++c) {
    const OwnItems chunk{chunk_begin(n, c), chunk_begin(n, c + 1)};
    const int owner =
        chunk.begin < chunk.end ? adds_up(chunk.begin + (chunk.end - chunk.begin) / 2) : 0;
    chunks_.add(owner);
    if (chunk.begin == chunk.end) continue;
    if (owner == ranks().rank()) own_chunks_.push_back(c);
    if (!runs_.empty() && runs_.back().owner == owner)
      runs_.back().particles.end = chunk.end;
    else
      runs_.push_back({chunk, owner});
  }
  for (const Run& run : runs_)
    if (run.owner == ranks().rank()) own_.push_back(run.particles);
}

int ParticleOwners::owner(Index A) const {
  return std::upper_bound(runs_.begin(), runs_.end(), A,
                          [](Index a, const Run& run) { return a < run.particles.end; })
      ->owner;
}

int ParticleOwners::adds_up(Index A) const {
  const auto next = std::upper_bound(first_.begin(), first_.end(), A);
  const Index begin = *(next - 1), end = next == first_.end() ? n_ : *next;
  return division_[static_cast<std::size_t>(next - first_.begin()) - 1].rank_of_row(end - begin,
                                                                                    A - begin);
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
