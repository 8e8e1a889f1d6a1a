// SPDX-License-Identifier: BSD-3-Clause
// Contact list: a neighbour (Verlet) list of clusters of four points.
#pragma once
#include "kernel/neighbor_search.hpp"
#include "numbers/box.hpp"
#include "parallel/aligned.hpp"
#include "parallel/parallel.hpp"

namespace meniscus {

/// All pairs of clusters of two clouds with points within `reach` of each other, and some more, as
/// rows in both directions. Partners are in ascending order. If points out of reach add exactly
/// zero, sums over partners have the same bits whenever the list was built.
///
/// The list is built for reach + skin. It is valid while the largest move in the first cloud plus
/// that in the second is at most `skin`.
template <int D>
class ContactList {
 public:
  ContactList(Real reach, Real skin) : reach_(reach), skin_(skin) {}

  /// Rebuilds the list if it is not valid for the positions [cluster][i] of two clouds, whose sizes
  /// must not change. Returns true if it was rebuilt. Does not allocate once the rows have their
  /// final size.
  bool update(std::span<const Lanes> first, std::span<const Lanes> second);

  /// Rebuilds the list unconditionally, for callers that track displacements themselves.
  void build(std::span<const Lanes> first, std::span<const Lanes> second);

  /// The rows of one cloud: cluster c has partner[start[c]] ... partner[start[c + 1] - 1].
  struct Rows {
    std::vector<Offset> start;
    std::vector<Index> partner;
    std::vector<Index> active;  ///< clusters with partners, in ascending order

    std::span<const Index> of(Index cluster) const {
      return {partner.data() + at(start, cluster), partner.data() + at(start, cluster + 1)};
    }
  };
  const Rows& of_first() const { return first_; }
  const Rows& of_second() const { return second_; }
  /// Number of pairs of clusters.
  Offset pairs() const { return first_.start.empty() ? 0 : first_.start.back(); }
  Real reach() const { return reach_; }
  Real skin() const { return skin_; }
  std::int64_t builds() const { return builds_; }
  std::size_t bytes() const;

 private:
  bool valid(std::span<const Lanes> first, std::span<const Lanes> second) const;
  void find_partners(std::span<const Lanes> first, std::span<const Lanes> second);
  Real find_met(const Box<D>& box, std::span<const Lanes> second);
  void find_partners_of(Index clusters, Real radius, std::span<const Lanes> first,
                        std::span<const Lanes> second);
  void take_rows();
  void transpose(Index second_clusters);

  Real reach_, skin_;
  std::int64_t builds_ = 0;
  AlignedVector<Lanes> built_first_, built_second_;  // positions at the last build
  std::vector<Index> met_;                     // clusters of the second cloud that may be near
  std::vector<Vec<D>> centre_;                 // [k of met_] their centres
  std::unique_ptr<NeighborSearch<D>> search_;  // searches these centres
  struct Found {                               // of a chunk of clusters of the first
    std::vector<Index> candidates, partner;
  };
  std::vector<Found> found_;
  Rows first_, second_;
};

}  // namespace meniscus
