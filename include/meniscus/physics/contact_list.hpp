// SPDX-License-Identifier: BSD-3-Clause
// Contact list: a Verlet list of clusters of four points.
#pragma once
#include "meniscus/approx/neighbor_search.hpp"
#include "meniscus/core/aligned.hpp"
#include "meniscus/core/box.hpp"
#include "meniscus/core/divided.hpp"

namespace meniscus {

/// All pairs of clusters of two clouds of which a point of one lies within `reach` of a point of
/// the other, and some more, as rows in both directions. Partners ascend, so that a sum over them
/// in which points out of reach add exactly zero has the same bits whenever the list was built.
///
/// It is built for reach + skin and holds as long as no point of the first cloud and none of
/// the second have moved by more than `skin` together. Each of the ranks by which it is divided
/// looks at what of the second cloud meets the box around its own clusters of the first.
template <int D>
class ContactList {
 public:
  ContactList(Real reach, Real skin) : reach_(reach), skin_(skin) {}

  /// Brings the list up to date for the places [cluster][i] of two clouds; the counts must not
  /// change. Returns whether it had to be built anew. Takes no memory once the rows have grown to
  /// what they need. All ranks call it, unless they each make their own.
  bool update(std::span<const Lanes> first, std::span<const Lanes> second,
              const Division& division = Division::to_each());

  /// Makes it for these places, whether it holds or not: for those who know themselves how far
  /// points can have moved since.
  void build(std::span<const Lanes> first, std::span<const Lanes> second,
             const Division& division = Division::to_each());

  /// Rows of one cloud: partners of cluster c are partner[start[c]] ... partner[start[c + 1] - 1].
  struct Rows {
    std::vector<Offset> start;
    std::vector<Index> partner;
    std::vector<Index> active;  ///< clusters with partners, ascending

    std::span<const Index> of(Index cluster) const {
      return {partner.data() + at(start, cluster), partner.data() + at(start, cluster + 1)};
    }
  };
  const Rows& of_first() const { return first_; }
  const Rows& of_second() const { return second_; }
  /// Pairs of clusters.
  Offset pairs() const { return first_.start.empty() ? 0 : first_.start.back(); }
  Real reach() const { return reach_; }
  Real skin() const { return skin_; }
  std::int64_t builds() const { return builds_; }
  std::size_t bytes() const;

 private:
  bool valid(std::span<const Lanes> first, std::span<const Lanes> second) const;
  void find_partners(std::span<const Lanes> first, std::span<const Lanes> second,
                     const Division& division);
  Real find_met(const Box<D>& box, std::span<const Lanes> second);
  void find_partners_of(OwnItems own, Real radius, std::span<const Lanes> first,
                        std::span<const Lanes> second);
  void take_rows(OwnItems own, Index clusters, const Division& division);
  void transpose(Index second_clusters);

  Real reach_, skin_;
  std::int64_t builds_ = 0;
  AlignedVector<Lanes> built_first_, built_second_;  // places of the last build
  std::vector<Index> met_;                           // clusters of the second that may be near
  std::vector<Vec<D>> centre_;                       // of these
  std::unique_ptr<NeighborSearch<D>> search_;        // over them
  struct Found {                                     // of a chunk of own clusters of the first
    std::vector<Index> candidates, partner;
  };
  std::vector<Found> found_;
  Rows first_, second_;
};

}  // namespace meniscus
