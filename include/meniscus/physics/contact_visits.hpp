// SPDX-License-Identifier: BSD-3-Clause
// How much work a contact was: pairs of contact points that it visited.
#pragma once
#include "meniscus/core/types.hpp"

#include <cstdint>

namespace meniscus {

/// Terms of contact have it beside ForceTerm. Counted once per force, from the sizes of the lists
/// that it went through; between two bodies a pair is visited from either side.
class ContactVisits {
 public:
  /// Pairs of points of two bodies, of points and facets of two bodies, or points beside a rigid
  /// partner, that a force visited on average since the term was built; 0 before the first.
  Real pairs_per_force() const {
    return forces_ > 0 ? static_cast<Real>(pairs_) / static_cast<Real>(forces_) : 0;
  }

 protected:
  ~ContactVisits() = default;
  void count(std::int64_t pairs) {
    ++forces_;
    pairs_ += pairs;
  }

 private:
  std::int64_t forces_ = 0, pairs_ = 0;
};

}  // namespace meniscus
