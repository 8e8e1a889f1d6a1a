// SPDX-License-Identifier: BSD-3-Clause
// Marks of particles that are read, and the halo made from them.
#include "parallel/step_reads.hpp"

#include <algorithm>

namespace meniscus {

void StepReads::rows(const ChunkSums& chunk_sums, Index first) {
  chunk_sums.mark_touched(std::span(read_).subspan(static_cast<std::size_t>(first)));
  sums(chunk_sums, first);
}

void StepReads::sums(const ChunkSums& chunk_sums, Index first) {
  chunk_sums.mark_summed(std::span(read_).subspan(static_cast<std::size_t>(first)));
}

void StepReads::particles(std::span<const Index> numbers, Index first) {
  for (const Index A : numbers) at(read_, first + A) = 1;
}

void StepReads::range(Index begin, Index end) {
  std::fill(read_.begin() + begin, read_.begin() + end, std::uint8_t{1});
}

std::shared_ptr<Halo> StepReads::share(ParticleOwners owners) {
  const auto halo = std::make_shared<Halo>(std::move(read_), std::move(owners));
  if (!halo->is_partial()) return nullptr;
  halo->keep(std::move(kept_));
  return halo;
}

}  // namespace meniscus
