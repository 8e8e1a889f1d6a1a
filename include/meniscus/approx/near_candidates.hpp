// SPDX-License-Identifier: BSD-3-Clause
// Which of the candidates around a cell reach the next four of its integration points.
#pragma once
#include "meniscus/approx/reproducing_kernel.hpp"
#include "meniscus/core/aligned.hpp"

#include <array>
#include <span>
#include <vector>

namespace meniscus {

/// Chooses batch by batch from the same candidates, four of them at a time. Keeps its buffers.
template <int D>
class NearCandidates {
 public:
  /// The candidates, which stay where they are as long as select() is called.
  void begin(std::span<const Candidate<D>> candidates);
  std::span<const Candidate<D>> all() const { return all_; }

  /// Finds those whose support reaches one of four kernel places, up to rounding of the distance.
  void select(const std::array<Vec<D>, 4>& points);
  std::span<const Candidate<D>> near() const { return std::span(near_).first(count_); }
  /// Their numbers among all.
  std::span<const Index> numbers() const { return std::span(numbers_).first(count_); }

 private:
  std::span<const Candidate<D>> all_;
  AlignedVector<Lanes> place_;   // [four candidates][i]
  AlignedVector<Lanes> square_;  // [four candidates] of the support
  std::vector<Candidate<D>> near_;
  std::vector<Index> numbers_;
  std::size_t count_ = 0;
};

extern template class NearCandidates<2>;
extern template class NearCandidates<3>;

}  // namespace meniscus
