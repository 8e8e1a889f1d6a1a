// SPDX-License-Identifier: BSD-3-Clause
// Pairs of facets of two surfaces, and by how many points each pair is summed.
#pragma once
#include "meniscus/physics/contact_list.hpp"
#include "meniscus/physics/contact_points.hpp"
#include "meniscus/physics/facet_grades.hpp"

#include <vector>

namespace meniscus {

/// Edge of a facet whose two Gauss points per direction are this cluster.
template <int D>
Real edge_by_points(const ContactPlaces<D>& places, Index cluster);

/// Which clusters of one grade act on which: those of a facet follow each other, and each of them
/// has all clusters of the partner facets. Without grades every cluster is a facet of its own.
template <int D>
struct FacetRows {
  const typename ContactList<D>::Rows* facets;
  Index clusters_per_facet;
  std::span<const Index> clusters;  ///< of the facets with partners, ascending

  std::span<const Index> partners_of(Index cluster) const {
    return facets->of(cluster / clusters_per_facet);
  }
};

/// Pairs of facets with points within `reach` of each other, as rows in both directions for each
/// grade of points. Both facets of a pair have the grade that it needs at the distance of their
/// coarsest points. That is the same seen from either of them, so that what one does to the other
/// comes back, and depends on the present motion alone.
template <int D>
class FacetPairs {
 public:
  /// `clusters_per_facet` by grade.
  FacetPairs(const FacetGrades& grades, const std::vector<Index>& clusters_per_facet, Real reach);

  /// By the coarsest points of both surfaces, a cluster per facet, in which the list has all pairs
  /// within `reach` + overhang(). Takes no memory while the list stays the same.
  void choose(const ContactList<D>& list, const ContactPlaces<D>& first,
              const ContactPlaces<D>& second);
  /// What points of two facets can be nearer to each other than the coarsest of them, as long as no
  /// facet has grown to more than one and a half times the largest `edge`.
  static Real overhang(Real edge) { return 2 * 1.5 * corner * edge; }

  FacetRows<D> of_first(std::size_t grade) const { return first_[grade].view(); }
  FacetRows<D> of_second(std::size_t grade) const { return second_[grade].view(); }
  std::size_t bytes() const;

 private:
  using Rows = typename ContactList<D>::Rows;
  /// Distance of a corner of a facet from the nearest of its four Gauss points, / edge.
  static constexpr Real corner = 0.3;
  /// Of one surface and grade.
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
  std::vector<Chosen> first_, second_;             // by grade
  std::vector<std::int8_t> grade_;                 // [pair of the list], -1: out of reach
  std::vector<Real> own_edges_, edges_of_others_;  // [facet], of those in the list
};

}  // namespace meniscus
