// SPDX-License-Identifier: BSD-3-Clause
// Work of a contact: number of pairs of contact points that its forces visit.
#pragma once
#include "numbers/types.hpp"

#include <cstdint>

namespace meniscus {

/// Base of contact terms beside ForceTerm. It is counted once per force from the sizes of the
/// lists. Between two bodies a pair is visited from both sides.
class ContactVisits {
 public:
  /// Mean number of pairs per force since the term was built; 0 before the first force. A pair
  /// consists of points of two bodies, of a point and a facet, or is a point beside a rigid
  /// partner.
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
