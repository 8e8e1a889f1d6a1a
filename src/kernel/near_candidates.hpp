// SPDX-License-Identifier: BSD-3-Clause
// Selects the particles around a cell whose support reaches the next four of its integration
// points.
#pragma once
#include "kernel/reproducing_kernel.hpp"
#include "parallel/aligned.hpp"

#include <array>
#include <span>
#include <vector>

namespace meniscus {

/// Selects from one list of candidates, batch after batch, four candidates at a time. Buffers are
/// kept.
template <int D>
class NearCandidates {
 public:
  /// Sets the list of candidates, which has to stay alive while select() is called.
  void begin(std::span<const Candidate<D>> candidates);
  std::span<const Candidate<D>> all() const { return all_; }

  /// Finds the candidates whose support reaches one of four kernel places, up to rounding.
  void select(const std::array<Vec<D>, 4>& points);
  std::span<const Candidate<D>> near() const { return std::span(near_).first(count_); }
  /// Their places in the list all().
  std::span<const Index> numbers() const { return std::span(numbers_).first(count_); }

 private:
  std::span<const Candidate<D>> all_;
  AlignedVector<Lanes> place_;   // [four candidates][i]
  AlignedVector<Lanes> square_;  // squared support, [four candidates]
  std::vector<Candidate<D>> near_;
  std::vector<Index> numbers_;
  std::size_t count_ = 0;
};

extern template class NearCandidates<2>;
extern template class NearCandidates<3>;

}  // namespace meniscus
