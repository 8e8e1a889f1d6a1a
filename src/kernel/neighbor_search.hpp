// SPDX-License-Identifier: BSD-3-Clause
// Search in a cloud of points: the one interface for kernel neighbours and contact pairs.
#pragma once
#include "numbers/types.hpp"

#include <memory>
#include <span>
#include <vector>

namespace meniscus {

/// kd-trees over a cloud. Queries are const and may run on several threads at once.
template <int D>
requires SpaceDim<D>
class NeighborSearch {
 public:
  /// One tree over a copy of the points.
  explicit NeighborSearch(std::span<const Vec<D>> points);
  /// Divides the points into blocks of `points_per_tree` consecutive points, with one tree per
  /// block. A tree is built when a query first comes near its block. If the points are sorted by
  /// order_spatially(), a rank therefore builds only the trees around its own rows. The points are
  /// not copied and must stay alive.
  static NeighborSearch in_order(std::span<const Vec<D>> points, Index points_per_tree = 2048);
  ~NeighborSearch();
  NeighborSearch(NeighborSearch&&) noexcept;
  NeighborSearch& operator=(NeighborSearch&&) noexcept;

  /// Indices with |points[i] - x| <= radius, up to rounding of the distance, ascending (a fixed
  /// order of summation).
  void within(const Vec<D>& x, Real radius, std::vector<Index>& found) const;
  /// Like within(), but the indices are not sorted.
  void within_unsorted(const Vec<D>& x, Real radius, std::vector<Index>& found) const;

  /// Distance from x to its k-th nearest point (x itself counts if it is in the cloud). Clouds of
  /// fewer than k points give the distance of the farthest. Infinite if x is not a number: no point
  /// is near it.
  Real distance_of_nearest(const Vec<D>& x, int k) const;

  /// Replaces the tree by one tree over other points.
  void rebuild(std::span<const Vec<D>> points);

  /// Number of trees built so far.
  Index trees() const;

 private:
  class Trees;
  explicit NeighborSearch(std::unique_ptr<Trees> trees);
  std::unique_ptr<Trees> trees_;
};

extern template class NeighborSearch<2>;
extern template class NeighborSearch<3>;

}  // namespace meniscus
