// SPDX-License-Identifier: BSD-3-Clause
// Contact of two deformable bodies by a law of the gap between their surfaces.
#include "meniscus/error.hpp"
#include "physics/contact/contact_terms.hpp"
#include "physics/contact/gap/gap_side.hpp"
#include "physics/contact/pair/contact_demand.hpp"
#include "physics/contact/pair/contact_visits.hpp"
#include "physics/contact/phases.hpp"

#include <fmt/core.h>

namespace meniscus {
namespace {

/// Energy of the contact of two surfaces: each point has a distance d from the nearest point of the
/// other surface, and a present area A (CGCM note 11).
///   E = 1/2 sum over the points of the first A e(d) + 1/2 sum over the points of the second A
///   e(d).
/// The energy of flat surfaces is e per area; each body gets one half, so that both are treated
/// alike. Forces are the gradient of E. A point is pushed along the line of its distance, and the
/// other surface is pushed back, so that forces and torques are balanced. e goes smoothly to zero
/// over the last quarter of its range. Only the distance distinguishes sides that face away from
/// each other: bodies must be thicker than the range. A varying adhesion is a function of time
/// alone, W(t).
///
/// With a ground, E = sum over the points of the first body of -up.V e(g), with the area vectors V
/// of the points, the gap g along `up`, and e not modified. This is the energy of a drop on a rigid
/// wall (wetting note 10). The ground is pulled along its normal and has no adhesion energy per
/// area of its own. Here the adhesion may be W(X, t) with the reference position X of the ground
/// below a point. Then E has W e(g), and a drop is pulled along the ground towards larger W.
template <int D>
class GapPair final : public ForceTerm, public ContactVisits {
 public:
  GapPair(const Body<D>& first, const Body<D>& second,
          std::shared_ptr<const Interaction> interaction, const ContactChoice& choice)
      : name_(choice.name),
        law_(std::move(interaction), choice.up),
        fold_(choice.fold),
        overlap_(choice.overlap),
        wets_(choice.wets),
        first_(first, second, law_.range(), choice, 0),
        second_(second, first, law_.range(), choice, 1),
        now_first_(first_, law_.pattern()),
        now_second_(second_, law_.pattern()),
        shared_({first.division, second.division}) {
    if (law_.up()) ground_ = first_.facets.facing(*law_.up());
    if (law_.placed()) require_adhesion();
  }

  std::string name() const override { return "contact '" + name_ + "'"; }
  std::string_view energy_kind() const override { return "contact"; }

  Report add_force(const Motion& motion, Forces force) override {
    work_.begin(motion.time);
    if (!shared_.takes_part()) return share_summary(motion, force);
    gathered_.clear();
    for_sides([&](const GapSide<D>& side, GapForces<D>& now) {
      const auto [points, corners] = now.place(side, shared_, motion);
      gathered_.push_back(points);
      gathered_.push_back(corners);
    });
    return go_on<&GapPair::take_forces>(*this, shared_, gathered_, motion, force);
  }

  std::optional<Real> stored_energy(const Motion& motion) const override {
    return sum_of(motion, &GapForces<D>::energy);
  }
  Real steady_after() const override { return law_.pattern() ? law_.pattern()->steady_after() : 0; }
  /// Accepts the step. The last computed force must belong to this motion.
  void commit(const Motion& motion) override {
    if (law_.pattern()) work_.commit(motion.time, summary_.supply);
  }
  void archive(const Archive& a) override {
    if (law_.pattern()) work_.archive(a, D);
  }
  bool reads(StepReads& reads) override {
    first_.list_reads(reads, shared_.takes_part());
    second_.list_reads(reads, shared_.takes_part());
    return true;
  }
  bool may_reject_steps() const override { return true; }
  bool stops_drift() const override { return true; }
  std::optional<std::string> warning(const Motion& motion) const override {
    return unresolved_gap(name_, gap(motion), spacing(), law_.range());
  }

  std::vector<MeasureSource> measures() const override {
    std::vector<MeasureSource> all{
        {"energy", dimension::energy, "energy of the interaction",
         [this](const Motion& motion) { return *stored_energy(motion); }},
        {"gap", dimension::length, "least distance of the two surfaces; at most the range",
         [this](const Motion& motion) { return gap(motion); }},
        {"gap_per_spacing", dimension::none, "least gap / distance of neighbouring points",
         [this](const Motion& motion) { return gap(motion) / spacing(); }}};
    if (wets_)
      all.push_back({"wetted_area", of_sum(dimension::area, D),
                     "area in full contact that has the energy of the adhesion (2D: length)",
                     [this](const Motion& motion) {
                       return sum_of(motion, &GapForces<D>::unit_energy) / law_.contact_energy();
                     }});
    const bool revolved = first_.points.body().geometry.grid.revolved;
    for (int i = revolved ? 1 : 0; i < D; ++i)
      all.push_back({std::string("force_") + "xyz"[i], dimension::force, "force on the first body",
                     [this, i](const Motion& motion) {
                       const Real on_second = forces_at(motion, first_).force_on_facets(i);
                       return (!law_.up() ? forces_at(motion, second_).force_on_facets(i) : 0) -
                              on_second;
                     }});
    return all;
  }

  std::size_t bytes() const override {
    return first_.bytes() + second_.bytes() + now_first_.bytes() + now_second_.bytes();
  }
  Offset pairs() const override { return first_.pairs() + second_.pairs(); }

 private:
  /// Calls f for the sides that store energy.
  template <class F>
  void for_sides(F&& f) {
    f(first_, now_first_);
    if (!law_.up()) f(second_, now_second_);
  }
  /// Computes the forces on a share of the points, when all are placed.
  Report take_forces(const Motion& motion, Forces force) {
    Offset visited = 0;
    gathered_.clear();
    for_sides([&](GapSide<D>& side, GapForces<D>& now) {
      now.take_placed(side, shared_);
      side.list.update(now.places.x, now.others.samples);
      visited += side.list.pairs() * Lanes::width;
      update_weights(side, motion, now);
      gathered_.push_back(
          meniscus::take_forces(side, side.list, law_, motion, shares_of(side), now));
    });
    count(visited);
    return go_on<&GapPair::add_forces>(*this, shared_, gathered_, motion, force);
  }
  /// Adds the forces on all points to the particles.
  Report add_forces(const Motion& motion, Forces force) {
    for_sides([&](GapSide<D>& side, GapForces<D>& now) {
      add_up(side, side.list, shares_of(side), now);
      if (const auto& active = side.list.of_first().active; !active.empty())
        side.points.add_force(now.places, active, now.T, now.S, force);
      side.facets.add_force(now.pull, force);
    });
    summarise(motion, force.demand);
    return share_summary(motion, force);
  }
  Report share_summary(const Motion& motion, Forces force) {
    return force.gather({shared_.reported(&summary_)}, motion,
                        [this](const Motion& m, const Forces&) { return report(m.time); });
  }
  /// Updates the weights of the points that this process computes, and of those whose rows it has.
  void update_weights(const GapSide<D>& side, const Motion& motion, GapForces<D>& now) const {
    const std::span<const Index> active = side.list.of_first().active;
    const auto update = [&](const ItemRange& part) {
      side.points.update_weights(active.subspan(static_cast<std::size_t>(part.begin),
                                                static_cast<std::size_t>(part.end - part.begin)),
                                 motion, now.places);
    };
    update(shares_of(side).own());
    if (shares_of(side).are_sent()) update(side.points.rows_of(active, shared_).own());
  }
  Portions shares_of(const GapSide<D>& side) const {
    return meniscus::shares_of(side.list, law_, shared_);
  }
  GapForces<D> forces_at(const Motion& motion, const GapSide<D>& side) const {
    return meniscus::forces_at(motion, side, law_);
  }
  void require_adhesion() const;
  /// The largest adhesion at this time, at the positions of the last force.
  Real largest_adhesion(Real time) const {
    return law_.placed() ? *std::max_element(now_first_.W.begin(), now_first_.W.end())
                         : law_.adhesion(time);
  }
  /// Work of the changing adhesion at the positions of the last force. `time`: time of that force.
  AdhesionSupply supply(Real time) const {
    const AdhesionPattern* W = law_.pattern();
    if (!W || (law_.placed() && !W->depends_on_time())) return {};
    if (law_.placed()) return supply_of(first_, now_first_, *W, work_, time);
    return work_.supply(*W, Eigen::Vector3d::Zero(), law_.adhesion(time),
                        now_first_.unit_energy() + (!law_.up() ? now_second_.unit_energy() : 0),
                        time);
  }
  /// Sum of a number over the surfaces that store energy.
  Real sum_of(const Motion& motion, Real (GapForces<D>::*number)() const) const {
    const Real of_first = (forces_at(motion, first_).*number)();
    return !law_.up() ? of_first + (forces_at(motion, second_).*number)() : of_first;
  }
  Real gap(const Motion& motion) const {
    const Real of_first = std::min(forces_at(motion, first_).gap, law_.range());
    return !law_.up() ? std::min(of_first, forces_at(motion, second_).gap) : of_first;
  }
  Real spacing() const {
    return !law_.up() ? std::max(first_.points.spacing(), second_.points.spacing())
                      : first_.points.spacing();
  }
  void summarise(const Motion& motion, bool demand);
  Report report(Real time) const;

  std::string name_;
  GapLaw<D> law_;
  AdhesionWork work_;
  std::string fold_;     // advice if the ground (second body) folds
  std::string overlap_;  // advice for surfaces that pass through each other
  bool wets_;
  GapSide<D> first_, second_;
  std::vector<Index> ground_;            // facets of the second that face up in the reference
  GapForces<D> now_first_, now_second_;  // work space of a force
  SharedWork shared_;
  std::vector<Gathered> gathered_;  // work space of a force
  /// Results of the last force.
  struct Summary {
    AdhesionSupply supply;  ///< work of the adhesion
    Real gap = unbounded;
    bool on_first = true;  ///< the smallest gap is that of the point `nearest` of the first body
    Index nearest = 0;
    Index folded = -1;  ///< facet of the ground that has turned over, or -1
    StepDemand demand;
  };
  Summary summary_;
};

/// Evaluates W at all corners of the ground before a run, so that a failing formula is reported
/// early.
template <int D>
void GapPair<D>::require_adhesion() const try {
  for (const Index facet : ground_)
    for (std::size_t k = 0; k < D; ++k) {
      typename ContactFacets<D>::Foot corner;
      corner.facet = facet;
      corner.share.fill(0);
      corner.share[k] = 1;
      (*law_.pattern())(spatial<D>(first_.facets.reference_place(corner)), 0);
    }
} catch (const SolveError& error) {
  throw InputError(error.what());
}

/// Summarises the last force: work of the adhesion, smallest gap, and the limit of the step from
/// present positions and velocities.
template <int D>
void GapPair<D>::summarise(const Motion& motion, bool demand) {
  const std::optional<Vec<D>>& up = law_.up();
  summary_ = {};
  summary_.supply = supply(motion.time);
  summary_.on_first = now_first_.gap <= now_second_.gap;
  summary_.gap = std::min(now_first_.gap, now_second_.gap);
  summary_.nearest = summary_.on_first ? now_first_.nearest : now_second_.nearest;
  if (up) summary_.folded = first_.facets.turned_over(now_first_.others, *up, ground_);
  const Real gap = summary_.gap;
  if (!demand || !(gap < law_.range())) return;
  const Real speed =
      closing_speed<D>(first_.points, now_first_.near, second_.points, now_second_.near, motion);
  const Real strength = law_.varies_at(gap) ? largest_adhesion(motion.time) : 1;
  const Real inverse_inertia = 1 / first_.points.inertia() + 1 / second_.points.inertia();
  summary_.demand =
      contact_demand({law_.interaction(), strength * inverse_inertia, 0, D}, gap, {speed});
}

/// Report of the last force: external work, failures, and the limit of the step.
template <int D>
Report GapPair<D>::report(Real time) const {
  Report report;
  report.demand = summary_.demand;
  if (law_.pattern()) report.external_work = work_.since_step(summary_.supply);
  if (summary_.folded >= 0) {
    report.failure =
        Failure{first_.facets.particle_at(summary_.folded),
                fmt::format("the surface of '{}' folds over{}", second_.points.body().name, fold_)};
  } else if (summary_.gap < law_.interaction().least_gap()) {
    const GapSide<D>& side = summary_.on_first ? first_ : second_;
    report.failure = Failure{
        side.points.particle_at(summary_.nearest),
        fmt::format("surfaces overlap: the gap between '{}' and '{}' is {:.4g}, least is {:.4g}{}",
                    first_.points.body().name, second_.points.body().name, summary_.gap,
                    law_.interaction().least_gap(), time > 0 ? overlap_ : ""),
        true};
  }
  return report;
}

}  // namespace

template <int D>
std::unique_ptr<ForceTerm> gap_pair(const Body<D>& first, const Body<D>& second,
                                    std::shared_ptr<const Interaction> law,
                                    const ContactChoice& choice) {
  if (choice.form != ContactForm::energy)
    throw InputError("contact '" + choice.name +
                     "': a law of the gap acts between two bodies by its energy alone; use form = "
                     "\"energy\"");
  return std::make_unique<GapPair<D>>(first, second, std::move(law), choice);
}

template std::unique_ptr<ForceTerm> gap_pair(const Body<2>&, const Body<2>&,
                                             std::shared_ptr<const Interaction>,
                                             const ContactChoice&);
template std::unique_ptr<ForceTerm> gap_pair(const Body<3>&, const Body<3>&,
                                             std::shared_ptr<const Interaction>,
                                             const ContactChoice&);

}  // namespace meniscus
