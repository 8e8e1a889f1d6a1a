// SPDX-License-Identifier: BSD-3-Clause
// What forces visit.
#pragma once
#include "meniscus/physics/force_term.hpp"

#include <memory>
#include <span>

namespace meniscus::study {

/// Of all terms.
inline Real pairs_per_particle(std::span<const std::unique_ptr<ForceTerm>> terms, Index particles) {
  Offset pairs = 0;
  for (const auto& term : terms) pairs += term->pairs();
  return static_cast<Real>(pairs) / particles;
}

}  // namespace meniscus::study
