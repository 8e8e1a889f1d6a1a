// SPDX-License-Identifier: BSD-3-Clause
// The halo of a system.
#include "parallel/followed_particles.hpp"

namespace meniscus {

void FollowedParticles::follow(StepReads reads, const ParticleOwners& owners) {
  halo_ = reads.share(owners);
  reason_ = halo_ ? "" : "forces that read all particles on every rank";
}

void FollowedParticles::set_owners(const ParticleOwners& owners) {
  if (ranks().alone() || everyone_) return;
  const auto all = static_cast<std::size_t>(owners.particles());
  everyone_ = std::make_unique<Halo>(std::vector<std::uint8_t>(all, 1), owners);
}

}  // namespace meniscus
