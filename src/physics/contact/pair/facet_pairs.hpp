// SPDX-License-Identifier: BSD-3-Clause
// Pairs of facets of two surfaces, and the number of points for each pair.
#pragma once
#include "physics/contact/pair/contact_list.hpp"
#include "physics/contact/points/contact_points.hpp"
#include "physics/contact/points/facet_grades.hpp"

#include <vector>

namespace meniscus {

/// Length of the edge of a facet, if this cluster contains its two Gauss points per direction.
template <int D>
Real edge_by_points(const ContactPlaces<D>& places, Index cluster);

/// The interactions between clusters of one grade. Clusters of a facet follow each other, and each
/// has all clusters of the partner facets as partners. Without grades every cluster counts as a
/// facet.
template <int D>
struct FacetRows {
  const typename ContactList<D>::Rows* facets;
  Index clusters_per_facet;
  std::span<const Index> clusters;  ///< clusters of the facets with partners, ascending

  std::span<const Index> partners_of(Index cluster) const {
    return facets->of(cluster / clusters_per_facet);
  }
};

/// Pairs of facets with points within `reach` of each other, as rows in both directions for each
/// grade of points. Both facets of a pair have the grade for the distance of their coarsest points.
/// The grade is the same seen from either facet, so that action equals reaction. It depends on the
/// current motion only.
template <int D>
class FacetPairs {
 public:
  /// `clusters_per_facet`: [grade].
  FacetPairs(const FacetGrades& grades, const std::vector<Index>& clusters_per_facet, Real reach);

  /// Chooses grades by the coarsest points of both surfaces, one cluster per facet. `list` has to
  /// contain all pairs within `reach` + overhang(). Does not allocate while the list stays the
  /// same.
  void choose(const ContactList<D>& list, const ContactPlaces<D>& first,
              const ContactPlaces<D>& second);
  /// Upper bound for how much nearer points of two facets can be than their coarsest points, as
  /// long as no facet is larger than 1.5 times the largest `edge`.
  static Real overhang(Real edge) { return 2 * 1.5 * corner * edge; }

  FacetRows<D> of_first(std::size_t grade) const { return first_[grade].view(); }
  FacetRows<D> of_second(std::size_t grade) const { return second_[grade].view(); }
  std::size_t bytes() const;

 private:
  using Rows = typename ContactList<D>::Rows;
  /// Distance of a corner of a facet from the nearest of its four Gauss points, divided by the
  /// edge.
  static constexpr Real corner = 0.3;
  /// The rows of one surface and grade.
  struct Chosen {
    Rows facets;
    Index clusters_per_facet;
    std::vector<Index> clusters;

    FacetRows<D> view() const { return {&facets, clusters_per_facet, clusters}; }
  };

  void choose(const Rows& listed, const ContactPlaces<D>& own, const ContactPlaces<D>& others,
              std::vector<Chosen>& chosen);
  void take_edges(const Rows& listed, const ContactPlaces<D>& places, std::vector<Real>& edges);
  void sort_by_grade(const Rows& listed, std::vector<Chosen>& chosen) const;

  FacetGrades grades_;
  Real reach_;
  std::vector<Chosen> first_, second_;             // [grade]
  std::vector<std::int8_t> grade_;                 // [pair of the list] grade; -1: out of reach
  std::vector<Real> own_edges_, edges_of_others_;  // [facet] edges of the facets in the list
};

}  // namespace meniscus
