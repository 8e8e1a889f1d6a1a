// SPDX-License-Identifier: BSD-3-Clause
// One side of a gap between two deformable bodies: the surface points of one in the field of the
// facets of the other.
#pragma once
#include "meniscus/physics/contact.hpp"
#include "meniscus/physics/contact_facets.hpp"
#include "meniscus/physics/contact_list.hpp"

#include <vector>

#include "adhesion_work.hpp"
#include "gap_law.hpp"

namespace meniscus {

template <int D>
struct GapSide {
  ContactPoints<D> points;
  ContactFacets<D> facets;
  ContactList<D> list;  ///< clusters of points, facets

  GapSide(const Body<D>& body, const Body<D>& other, Real range, const ContactChoice& choice,
          std::size_t side)
      : points(surface_contact_points(body, 1, choice, side)),
        facets(other),
        // No point of a facet that has not doubled its size is farther than that from its samples.
        list(range + facets.longest_edge(), choice.skin * range / 4) {}
  /// All of it, or nothing.
  void tell_reads(StepReads& reads, bool reads_all) {
    points.tell_reads_alone(reads, reads_all);
    facets.tell_reads(reads, reads_all);
  }
  std::size_t bytes() const { return points.bytes() + facets.bytes() + list.bytes(); }
  Offset pairs() const { return points.pairs() + facets.pairs() + list.pairs(); }
};

/// Places, energies and forces of a side.
template <int D>
struct GapForces {
  ContactPlaces<D> places;
  typename ContactFacets<D>::Places others;
  AlignedVector<Lanes> T, S;                          ///< [cluster][i]: dE/dx, dE/dV
  std::vector<typename ContactFacets<D>::Foot> foot;  ///< [point]
  std::vector<Real> stored;                           ///< [point] energy
  std::vector<Real> unit;    ///< [point] the same of unit adhesion, without core; where it varies
  std::vector<Real> W;       ///< [point] adhesion, where it varies from place to place
  std::vector<Vec<D>> pull;  ///< [corner] force
  std::vector<Index> near;   ///< clusters within the range: the list has more, as it was built
  Real gap = unbounded;
  Index nearest = 0;  ///< point

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

/// At this motion, at which places and the list are; points of the list are divided so.
template <int D>
void take_forces(const GapSide<D>& side, const ContactList<D>& list, const GapLaw<D>& law,
                 const Motion& motion, const Division& division, GapForces<D>& forces);

/// At any motion; takes memory.
template <int D>
GapForces<D> forces_at(const Motion& motion, const GapSide<D>& side, const GapLaw<D>& law,
                       const Division& division);

/// Of adhesion that varies from place to place, at the time of the forces.
template <int D>
AdhesionSupply supply_of(const GapSide<D>& side, const GapForces<D>& forces,
                         const AdhesionPattern& W, const AdhesionWork& work, Real time);

}  // namespace meniscus
