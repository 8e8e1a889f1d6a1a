// SPDX-License-Identifier: BSD-3-Clause
// One side of a gap between two deformable bodies: the surface points of one body and the facets of
// the other.
#pragma once
#include "physics/contact/adhesion_work.hpp"
#include "physics/contact/contact_terms.hpp"
#include "physics/contact/gap/gap_law.hpp"
#include "physics/contact/pair/contact_list.hpp"
#include "physics/contact/points/contact_facets.hpp"

#include <vector>

namespace meniscus {

template <int D>
struct GapSide {
  ContactPoints<D> points;
  ContactFacets<D> facets;
  ContactList<D> list;  ///< pairs (cluster of points, facet)

  GapSide(const Body<D>& body, const Body<D>& other, Real range, const ContactChoice& choice,
          std::size_t side)
      : points(surface_contact_points(body, 1, choice, side)),
        facets(other),
        // Points of a facet that has less than doubled its size are no farther from its samples
        // than this.
        list(range + facets.longest_edge(), choice.skin * range / 4) {}
  /// Registers the reads of a step: all points and facets, or none.
  void tell_reads(StepReads& reads, bool reads_all) {
    points.tell_reads_alone(reads, reads_all);
    facets.tell_reads(reads, reads_all);
  }
  std::size_t bytes() const { return points.bytes() + facets.bytes() + list.bytes(); }
  Offset pairs() const { return points.pairs() + facets.pairs() + list.pairs(); }
};

/// Positions, energies and forces of a side.
template <int D>
struct GapForces {
  ContactPlaces<D> places;
  typename ContactFacets<D>::Places others;
  AlignedVector<Lanes> T, S;                          ///< [cluster][i]: dE/dx, dE/dV
  std::vector<typename ContactFacets<D>::Foot> foot;  ///< [point] nearest point
  std::vector<Real> stored;                           ///< [point] energy
  std::vector<Real> unit;    ///< [point] energy at unit adhesion without core; if W varies
  std::vector<Real> W;       ///< [point] adhesion, if it depends on position
  std::vector<Vec<D>> pull;  ///< [corner] force
  std::vector<Index> near;   ///< clusters within the range; the list has more
  Real gap = unbounded;
  Index nearest = 0;  ///< number of the point with the smallest gap

  GapForces(const GapSide<D>& side, const AdhesionPattern* pattern);
  void move(const GapSide<D>& side, const Motion& motion, const Division& division) {
    side.points.move(motion, places, division);
    side.facets.move(motion, others, division);
  }
  std::size_t bytes() const;
  Real energy() const;
  Real unit_energy() const;
  Real force_on_facets(int i) const;
};

/// Computes the forces at this motion. Positions and list have to be up to date for it; ranks
/// divide the points of the list by `division`.
template <int D>
void take_forces(const GapSide<D>& side, const ContactList<D>& list, const GapLaw<D>& law,
                 const Motion& motion, const Division& division, GapForces<D>& forces);

/// Computes the forces at any motion; allocates memory.
template <int D>
GapForces<D> forces_at(const Motion& motion, const GapSide<D>& side, const GapLaw<D>& law,
                       const Division& division);

/// The supply of adhesion that depends on the place, at the time of the forces.
template <int D>
AdhesionSupply supply_of(const GapSide<D>& side, const GapForces<D>& forces,
                         const AdhesionPattern& W, const AdhesionWork& work, Real time);

}  // namespace meniscus
