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
  /// Registers the reads of a force: all points and facets, or none.
  void list_reads(StepReads& reads, bool reads_all) const {
    reads_all ? points.list_reads(reads) : points.list_sums(reads);
    facets.list_reads(reads, reads_all);
  }
  std::size_t bytes() const { return points.bytes() + facets.bytes() + list.bytes(); }
  Offset pairs() const { return points.pairs() + facets.pairs() + list.pairs(); }
};

/// The results at the points of a cluster.
template <int D>
struct OfCluster {
  struct Point {
    typename ContactFacets<D>::Foot foot;
    Real stored, unit;
  };
  Lanes T[D], S[D];
  std::array<Point, Lanes::width> point;
};

/// Positions, energies and forces of a side.
template <int D>
struct GapForces {
  ContactPlaces<D> places;
  typename ContactFacets<D>::Places others;
  AlignedVector<Lanes> T, S;                          ///< [cluster][i]: dE/dx, dE/dV
  std::vector<typename ContactFacets<D>::Foot> foot;  ///< [point] nearest point
  std::vector<Real> stored;                           ///< [point] energy
  std::vector<Real> unit;          ///< [point] energy without core; if W varies at W = 1
  std::vector<Real> W;             ///< [point] adhesion, if it depends on position
  std::vector<Vec<D>> pull;        ///< [corner] force
  std::vector<Index> near;         ///< clusters within the range; the list has more
  std::vector<OfCluster<D>> sent;  ///< work space: results for other processes, [k of the list]
  Real gap = unbounded;
  Index nearest = 0;  ///< number of the point with the smallest gap

  GapForces(const GapSide<D>& side, const AdhesionPattern* pattern);
  /// Moves all points and facets, each process those whose rows it has. The result is to be
  /// gathered before take_placed().
  std::array<Gathered, 2> place(const GapSide<D>& side, const SharedWork& work,
                                const Motion& motion) {
    return {side.points.place(side.points.all(), work, ContactPoints<D>::Placed::positions, motion,
                              places),
            side.facets.place(work, motion, others)};
  }
  void take_placed(const GapSide<D>& side, const SharedWork& work) {
    side.points.take_placed(side.points.all(), work, ContactPoints<D>::Placed::positions, places);
    side.facets.take_placed(others);
  }
  std::size_t bytes() const;
  Real energy() const;
  Real unit_energy() const;
  Real force_on_facets(int i) const;
};

/// The part of the points of the list that this process computes: all where adhesion depends on the
/// place, so that a position without adhesion fails everywhere.
template <int D>
Portions shares_of(const ContactList<D>& list, const GapLaw<D>& law, const SharedWork& work);
/// Computes the forces on this share, at a motion for which positions, weights and list are up
/// to date. The
/// result is to be gathered before add_up().
template <int D>
Gathered take_forces(const GapSide<D>& side, const ContactList<D>& list, const GapLaw<D>& law,
                     const Motion& motion, const Portions& shares, GapForces<D>& forces);
/// Adds the forces of the points to the corners of the facets they act on, and finds the smallest
/// gap.
template <int D>
void add_up(const GapSide<D>& side, const ContactList<D>& list, const Portions& shares,
            GapForces<D>& forces);

/// Computes the forces at any motion that is known everywhere; allocates memory.
template <int D>
GapForces<D> forces_at(const Motion& motion, const GapSide<D>& side, const GapLaw<D>& law);

/// The supply of adhesion that depends on the place, at the time of the forces.
template <int D>
AdhesionSupply supply_of(const GapSide<D>& side, const GapForces<D>& forces,
                         const AdhesionPattern& W, const AdhesionWork& work, Real time);

}  // namespace meniscus
