// SPDX-License-Identifier: BSD-3-Clause
// Forces between the surface points of one body and the facets of another.
#include "physics/contact/gap/gap_side.hpp"

namespace meniscus {
namespace {

template <int D>
OfCluster<D> results_of(const GapForces<D>& forces, Index c) {
  OfCluster<D> results;
  for (int i = 0; i < D; ++i) {
    results.T[i] = at(forces.T, c * D + i);
    results.S[i] = at(forces.S, c * D + i);
  }
  for (Index lane = 0; lane < Lanes::width; ++lane) {
    const Index q = c * Lanes::width + lane;
    at(results.point, lane) = {at(forces.foot, q), at(forces.stored, q), at(forces.unit, q)};
  }
  return results;
}

template <int D>
void put(const OfCluster<D>& results, Index c, GapForces<D>& forces) {
  for (int i = 0; i < D; ++i) {
    at(forces.T, c * D + i) = results.T[i];
    at(forces.S, c * D + i) = results.S[i];
  }
  for (Index lane = 0; lane < Lanes::width; ++lane) {
    const Index q = c * Lanes::width + lane;
    at(forces.foot, q) = at(results.point, lane).foot;
    at(forces.stored, q) = at(results.point, lane).stored;
    at(forces.unit, q) = at(results.point, lane).unit;
  }
}

}  // namespace

template <int D>
GapForces<D>::GapForces(const GapSide<D>& side, const AdhesionPattern* pattern)
    : places(side.points.at_rest()),
      others(side.facets.at_rest()),
      T(places.x.size(), Lanes::zero()),
      S(T) {
  foot.resize(static_cast<std::size_t>(places.size));
  stored.resize(foot.size());
  unit.resize(foot.size());
  if (pattern && pattern->depends_on_place()) W.resize(foot.size());
  pull.resize(others.corner.size());
  near.reserve(static_cast<std::size_t>(side.points.clusters()));
}

template <int D>
std::size_t GapForces<D>::bytes() const {
  return places.bytes() + (others.samples.size() + T.size() + S.size()) * sizeof(Lanes) +
         others.radius.size() * sizeof(Real) + foot.size() * (sizeof(foot[0]) + sizeof(Real)) +
         (unit.size() + W.size()) * sizeof(Real) + 2 * pull.size() * sizeof(Vec<D>) +
         near.capacity() * sizeof(Index);
}

template <int D>
Real GapForces<D>::energy() const {
  return parallel_sum(places.size, 0.0, [&](Index q) { return at(stored, q); });
}

template <int D>
Real GapForces<D>::unit_energy() const {
  return parallel_sum(places.size, 0.0, [&](Index q) { return at(unit, q); });
}

template <int D>
Real GapForces<D>::force_on_facets(int i) const {
  Real sum = 0;
  for (const Vec<D>& p : pull) sum += p[i];
  return sum;
}

namespace {

/// Adds the forces of the points to the corners of the facets they act on, and finds the smallest
/// gap. Sequential, since many points pull the same corner.
template <int D>
void pull_corners(const GapSide<D>& side, std::span<const Index> active, GapForces<D>& forces) {
  std::fill(forces.pull.begin(), forces.pull.end(), Vec<D>::Zero());
  forces.gap = unbounded;
  forces.near.clear();
  for (const Index c : active)
    for (int lane = 0; lane < side.points.points_in(c); ++lane) {
      const Index q = c * Lanes::width + lane;
      const auto& foot = at(forces.foot, q);
      if (foot.facet < 0) continue;
      if (forces.near.empty() || forces.near.back() != c) forces.near.push_back(c);
      if (foot.distance < forces.gap) {
        forces.gap = foot.distance;
        forces.nearest = q;
      }
      Vec<D> T;
      for (int i = 0; i < D; ++i) T[i] = at(forces.T, c * D + i)[lane];
      for (std::size_t k = 0; k < D; ++k)
        at(forces.pull, side.facets.corners_of(foot.facet)[k]) += foot.share[k] * T;
    }
}

}  // namespace

template <int D>
Portions shares_of(const ContactList<D>& list, const GapLaw<D>& law, const SharedWork& work) {
  const auto active = static_cast<Index>(list.of_first().active.size());
  return law.placed() ? Division::to_each().items(active) : work.items(active);
}

template <int D>
Gathered take_forces(const GapSide<D>& side, const ContactList<D>& list, const GapLaw<D>& law,
                     const Motion& motion, const Portions& shares, GapForces<D>& forces) {
  const auto& active = list.of_first().active;
  const std::optional<Vec<D>>& up = law.up();
  const AdhesionPattern* pattern = law.pattern();
  const Real even = law.adhesion(motion.time);
  const ItemRange own = shares.own();
  std::fill(forces.foot.begin(), forces.foot.end(), typename ContactFacets<D>::Foot());
  std::fill(forces.stored.begin(), forces.stored.end(), 0.0);
  std::fill(forces.unit.begin(), forces.unit.end(), 0.0);
  std::fill(forces.W.begin(), forces.W.end(), 0.0);
  parallel_for(
      own,
      [&](Index k) {
        const Index c = at(active, k);
        for (int i = 0; i < D; ++i)
          at(forces.T, c * D + i) = at(forces.S, c * D + i) = Lanes::zero();
        for (int lane = 0; lane < side.points.points_in(c); ++lane) {
          const Index q = c * Lanes::width + lane;
          const Vec<D> place = forces.places.place(q);
          const auto foot = up ? side.facets.below(forces.others, place, *up, list.of_first().of(c))
                               : side.facets.foot(forces.others, place, list.of_first().of(c));
          if (!(foot.distance < law.range())) continue;
          Real W = even;
          Vec<D> slope = Vec<D>::Zero();  // gradient of W
          if (law.placed()) {
            const Eigen::Vector3d X = spatial<D>(side.facets.reference_place(foot));
            W = at(forces.W, q) = (*pattern)(X, motion.time);
            const Vec<D> in_reference = pattern->gradient(X, motion.time).template head<D>();
            slope = side.facets.carried(forces.others, foot, in_reference, *up);
          }
          const auto e = law.energy(foot.distance, W);
          Vec<D> V;
          for (int i = 0; i < D; ++i) V[i] = forces.places.weight_of(c)[i][lane];
          const Real norm = V.norm(), area = up ? -up->dot(V) : 0.5 * norm;
          for (int i = 0; i < D; ++i) {
            at(forces.T, c * D + i)
                .set(lane, area * e.slope * foot.normal[i] + area * e.unit * slope[i]);
            at(forces.S, c * D + i)
                .set(lane, up ? -e.value * (*up)[i] : 0.5 * e.value / norm * V[i]);
          }
          at(forces.foot, q) = foot;
          at(forces.stored, q) = area * e.value;
          at(forces.unit, q) = area * e.unit;
        }
      },
      4);
  if (shares.are_sent()) {
    forces.sent.resize(active.size());
    for (Index k = own.begin; k < own.end; ++k)
      at(forces.sent, k) = results_of(forces, at(active, k));
  }
  return {forces.sent.data(), shares};
}

template <int D>
void add_up(const GapSide<D>& side, const ContactList<D>& list, const Portions& shares,
            GapForces<D>& forces) {
  const auto& active = list.of_first().active;
  const ItemRange own = shares.own();
  if (shares.are_sent())
    for (Index k = 0; k < static_cast<Index>(active.size()); ++k)
      if (k < own.begin || k >= own.end) put(at(forces.sent, k), at(active, k), forces);
  pull_corners<D>(side, active, forces);
}

template <int D>
GapForces<D> forces_at(const Motion& motion, const GapSide<D>& side, const GapLaw<D>& law) {
  GapForces<D> forces(side, law.pattern());
  side.points.move(motion, forces.places);
  side.facets.move(motion, forces.others);
  ContactList<D> list(side.list.reach(), side.list.skin());
  list.update(forces.places.x, forces.others.samples);
  const Portions shares = shares_of(list, law, SharedWork::of_all());
  side.points.update_weights(list.of_first().active, motion, forces.places);
  GatherTogether()({{take_forces(side, list, law, motion, shares, forces)}});
  add_up(side, list, shares, forces);
  return forces;
}

template <int D>
AdhesionSupply supply_of(const GapSide<D>& side, const GapForces<D>& forces,
                         const AdhesionPattern& W, const AdhesionWork& work, Real time) {
  AdhesionSupply supply;
  for (const Index c : forces.near)
    for (int lane = 0; lane < side.points.points_in(c); ++lane) {
      const Index q = c * Lanes::width + lane;
      const auto& foot = at(forces.foot, q);
      if (foot.facet < 0) continue;
      supply = supply + work.supply(W, spatial<D>(side.facets.reference_place(foot)),
                                    at(forces.W, q), at(forces.unit, q), time);
    }
  return supply;
}

#define MENISCUS_INSTANTIATE(D)                                                                   \
  template struct GapForces<D>;                                                                   \
  template Portions shares_of(const ContactList<D>&, const GapLaw<D>&, const SharedWork&);        \
  template Gathered take_forces(const GapSide<D>&, const ContactList<D>&, const GapLaw<D>&,       \
                                const Motion&, const Portions&, GapForces<D>&);                   \
  template void add_up(const GapSide<D>&, const ContactList<D>&, const Portions&, GapForces<D>&); \
  template GapForces<D> forces_at(const Motion&, const GapSide<D>&, const GapLaw<D>&);            \
  template AdhesionSupply supply_of(const GapSide<D>&, const GapForces<D>&,                       \
                                    const AdhesionPattern&, const AdhesionWork&, Real);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
