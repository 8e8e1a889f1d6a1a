// SPDX-License-Identifier: BSD-3-Clause
// Chooses the grade of every pair of facets.
#include "physics/contact/pair/facet_pairs.hpp"

#include "parallel/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace meniscus {
namespace {

/// Smallest distance between points of two clusters, bitwise the same in both orders.
template <int D>
Real least_distance(const Lanes* x, const Lanes* y) {
  Lanes nearest = unbounded;
  for (int lane = 0; lane < Lanes::width; ++lane) {
    Lanes square = Lanes::zero();
    for (int i = 0; i < D; ++i) square += (x[i] - y[i][lane]) * (x[i] - y[i][lane]);
    nearest = min(square, nearest);
  }
  return std::sqrt(std::min(std::min(nearest[0], nearest[1]), std::min(nearest[2], nearest[3])));
}

}  // namespace

template <int D>
Real edge_by_points(const ContactPlaces<D>& places, Index cluster) {
  Real square = 0;  // square of the largest distance
  for (int a = 0; a < Lanes::width; ++a)
    for (int b = 0; b < a; ++b) {
      Real between = 0;
      for (int i = 0; i < D; ++i) {
        const Real r = places.x_of(cluster)[i][a] - places.x_of(cluster)[i][b];
        between += r * r;
      }
      square = std::max(square, between);
    }
  return std::sqrt(3 * square / (D - 1));
}

template <int D>
FacetPairs<D>::FacetPairs(const FacetGrades& grades, const std::vector<Index>& clusters_per_facet,
                          Real reach)
    : grades_(grades), reach_(reach) {
  for (const Index clusters : clusters_per_facet) {
    first_.push_back({{}, clusters, {}});
    second_.push_back(first_.back());
  }
}

template <int D>
void FacetPairs<D>::choose(const ContactList<D>& list, const ContactPlaces<D>& first,
                           const ContactPlaces<D>& second) {
  take_edges(list.of_first(), first, own_edges_);
  take_edges(list.of_second(), second, edges_of_others_);
  choose(list.of_first(), first, second, first_);
  std::swap(own_edges_, edges_of_others_);
  choose(list.of_second(), second, first, second_);
  std::swap(own_edges_, edges_of_others_);
}

template <int D>
void FacetPairs<D>::take_edges(const Rows& listed, const ContactPlaces<D>& places,
                               std::vector<Real>& edges) {
  edges.resize(listed.start.size() - 1);
  for (const Index facet : listed.active) at(edges, facet) = edge_by_points(places, facet);
}

template <int D>
void FacetPairs<D>::choose(const Rows& listed, const ContactPlaces<D>& own,
                           const ContactPlaces<D>& others, std::vector<Chosen>& chosen) {
  grade_.resize(listed.partner.size());
  parallel_for(
      static_cast<Index>(listed.active.size()),
      [&](Index k) {
        const Index facet = at(listed.active, k);
        for (Offset e = at(listed.start, facet); e < at(listed.start, facet + 1); ++e) {
          const Index other = at(listed.partner, e);
          const Real a = at(own_edges_, facet), b = at(edges_of_others_, other);
          const Real distance = least_distance<D>(own.x_of(facet), others.x_of(other));
          const bool near = distance < reach_ + corner * (a + b);
          at(grade_, e) =
              static_cast<std::int8_t>(near ? grades_.grade(distance, std::max(a, b)) : -1);
        }
      },
      16);
  sort_by_grade(listed, chosen);
}

template <int D>
void FacetPairs<D>::sort_by_grade(const Rows& listed, std::vector<Chosen>& chosen) const {
  const auto facets = static_cast<Index>(listed.start.size()) - 1;
  for (Chosen& rows : chosen) {
    rows.facets.start.assign(listed.start.size(), 0);
    rows.facets.partner.clear();
    rows.facets.partner.reserve(listed.partner.capacity());
    rows.facets.active.clear();
    rows.facets.active.reserve(listed.active.capacity());
    rows.clusters.clear();
    rows.clusters.reserve(static_cast<std::size_t>(facets) *
                          static_cast<std::size_t>(rows.clusters_per_facet));
  }
  for (Index facet = 0; facet < facets; ++facet) {
    for (Offset e = at(listed.start, facet); e < at(listed.start, facet + 1); ++e)
      if (at(grade_, e) >= 0)
        at(chosen, at(grade_, e)).facets.partner.push_back(at(listed.partner, e));
    for (Chosen& rows : chosen) {
      const auto end = static_cast<Offset>(rows.facets.partner.size());
      at(rows.facets.start, facet + 1) = end;
      if (end == at(rows.facets.start, facet)) continue;
      rows.facets.active.push_back(facet);
      for (Index k = 0; k < rows.clusters_per_facet; ++k)
        rows.clusters.push_back(facet * rows.clusters_per_facet + k);
    }
  }
}

template <int D>
std::size_t FacetPairs<D>::bytes() const {
  std::size_t n = grade_.size() + (own_edges_.size() + edges_of_others_.size()) * sizeof(Real);
  for (const auto* side : {&first_, &second_})
    for (const Chosen& rows : *side)
      n += rows.facets.start.size() * sizeof(Offset) +
           (rows.facets.partner.capacity() + rows.facets.active.capacity() +
            rows.clusters.capacity()) *
               sizeof(Index);
  return n;
}

template Real edge_by_points(const ContactPlaces<2>&, Index);
template Real edge_by_points(const ContactPlaces<3>&, Index);
template class FacetPairs<2>;
template class FacetPairs<3>;

}  // namespace meniscus
