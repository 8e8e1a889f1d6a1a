// SPDX-License-Identifier: BSD-3-Clause
// Number of pairs that forces visit.
#pragma once
#include "meniscus/physics/force_term.hpp"

#include <memory>
#include <span>

namespace meniscus::study {

/// Pairs of all terms, per particle.
inline Real pairs_per_particle(std::span<const std::unique_ptr<ForceTerm>> terms, Index particles) {
  Offset pairs = 0;
  for (const auto& term : terms) pairs += term->pairs();
  return static_cast<Real>(pairs) / particles;
}

}  // namespace meniscus::study
