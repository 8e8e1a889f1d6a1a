// SPDX-License-Identifier: BSD-3-Clause
// An optional interface of force terms: values that go on in a run with other loads.
#pragma once
#include "state/archive.hpp"

namespace meniscus {

/// A force term with values that a scene takes over from another run ([initial] from, stages), if a
/// term of the same name was there.
class ContinuedTerm {
 public:
  virtual ~ContinuedTerm() = default;
  /// Takes the values from what a term of this name has saved. The time is 0.
  virtual void continue_from(const Archive&) = 0;
};

}  // namespace meniscus
