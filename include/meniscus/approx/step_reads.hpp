// SPDX-License-Identifier: BSD-3-Clause
// What a rank reads of the motion in a step: the stepper and each term of a system say their part,
// and from all of them follows which particles the rank follows (scaling note 2.3).
#pragma once
#include "meniscus/approx/force_windows.hpp"
#include "meniscus/core/halo.hpp"

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace meniscus {

class StepReads {
 public:
  using SharedHalo = std::shared_ptr<const Halo>;

  /// Of all bodies together, none of which is read so far.
  explicit StepReads(Index particles) : read_(static_cast<std::size_t>(particles), 0) {}

  /// The particles that the rows of this rank touch, and those over which it adds up windows. Both
  /// are numbered from `first` on. The windows know the halo once it is made.
  void rows(ForceWindows& windows, Index first);
  /// The latter alone, where rows are given what they scatter.
  void sums(ForceWindows& windows, Index first);
  /// These particles, counted from `first` on: as a rule the same on all ranks.
  void particles(std::span<const Index> numbers, Index first);
  /// Those from begin to end.
  void range(Index begin, Index end);
  /// A vector over all particles that steps keep up: of those that are followed.
  void keeps(NodalVectors& vector) { kept_.push_back(&vector); }
  /// Is told the halo when it is made. What it is given stays until then.
  void when_shared(std::function<void(const SharedHalo&)> learn);

  /// Null: every rank reads all. All ranks call this, with what they read in the same order.
  std::shared_ptr<Halo> share(ParticleOwners owners);

 private:
  std::vector<std::uint8_t> read_;      // [particle]
  std::vector<ForceWindows*> windows_;  // each once, in the order in which they were told
  std::vector<NodalVectors*> kept_;
  std::vector<std::function<void(const SharedHalo&)>> learners_;
};

}  // namespace meniscus
