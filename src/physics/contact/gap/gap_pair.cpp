// SPDX-License-Identifier: BSD-3-Clause
// Contact of two deformable bodies by a law of the gap between their surfaces.
#include "meniscus/error.hpp"
#include "physics/contact/contact_terms.hpp"
#include "physics/contact/gap/gap_side.hpp"
#include "physics/contact/pair/contact_demand.hpp"
#include "physics/contact/pair/contact_ranks.hpp"
#include "physics/contact/pair/contact_visits.hpp"

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
        ranks_({first.division, second.division}) {
    if (law_.up()) ground_ = first_.facets.facing(*law_.up());
    if (law_.placed()) require_adhesion();
  }

  std::string name() const override { return "contact '" + name_ + "'"; }
  std::string_view energy_kind() const override { return "contact"; }

  Report add_force(const Motion& motion, Forces force) override {
    work_.begin(motion.time);
    return ranks_.report_of([&] { return add_known_force(motion, force); });
  }

  std::optional<Real> stored_energy(const Motion& motion) const override {
    return sum_of(motion, &GapForces<D>::energy);
  }
  Real steady_after() const override {
    return law_.pattern() && law_.pattern()->depends_on_time() ? unbounded : 0;
  }
  /// Accepts the step. The last computed force must belong to this motion.
  void commit(const Motion& motion) override {
    if (law_.pattern() && !ranks_.is_absent()) work_.commit(motion.time, supply_);
  }
  void archive(const Archive& a) override {
    if (law_.pattern()) work_.archive(a, D);
  }
  void complete_history() override {
    if (law_.pattern()) ranks_.complete(work_);
  }
  bool tell_reads(StepReads& reads) override {
    ranks_.learn_halo(reads);
    const bool reads_all = !ranks_.are_few() || ranks_.takes_part();
    first_.tell_reads(reads, reads_all);
    second_.tell_reads(reads, reads_all);
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
        {"gap_per_spacing", dimension::none, "the same / distance of neighbouring points",
         [this](const Motion& motion) { return gap(motion) / spacing(); }}};
    if (law_.pattern() && wets_)
      all.push_back(
          {"wetted_area", D == 3 ? dimension::area : dimension::length,
           "area in full contact that has the energy of the interaction (2D: length)",
           [this](const Motion& motion) { return -sum_of(motion, &GapForces<D>::unit_energy); }});
    for (int i = 0; i < D; ++i)
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
  /// Adds the force on a rank that takes part in the contact.
  Report add_known_force(const Motion& motion, Forces force) {
    Offset visited = 0;
    for (auto [side, now] : {std::pair{&first_, &now_first_}, std::pair{&second_, &now_second_}}) {
      if (side == &second_ && law_.up()) break;
      now->move(*side, motion, ranks_.division());
      side->list.update(now->places.x, now->others.samples, ranks_.division());
      visited += side->list.pairs() * Lanes::width;
      take_forces(*side, side->list, law_, motion, ranks_.division(), *now);
      if (const auto& active = side->list.of_first().active; !active.empty())
        side->points.add_force(now->places, active, now->T, now->S, force);
      side->facets.add_force(now->pull, force);
    }
    count(visited);
    supply_ = supply(motion.time);
    return report(motion);
  }
  GapForces<D> forces_at(const Motion& motion, const GapSide<D>& side) const {
    return meniscus::forces_at(motion, side, law_, ranks_.division());
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
  Report report(const Motion& motion) const;

  std::string name_;
  GapLaw<D> law_;
  AdhesionWork work_;
  std::string fold_;     // advice if the ground (second body) folds
  std::string overlap_;  // advice for surfaces that pass through each other
  bool wets_;
  GapSide<D> first_, second_;
  std::vector<Index> ground_;            // facets of the second that face up in the reference
  GapForces<D> now_first_, now_second_;  // work space of a force
  AdhesionSupply supply_;                // work of the adhesion, from the last force
  ContactRanks ranks_;
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

/// Report of the last force: external work, failures, and the limit of the step from present
/// positions and velocities.
template <int D>
Report GapPair<D>::report(const Motion& motion) const {
  Report report;
  const std::optional<Vec<D>>& up = law_.up();
  if (law_.pattern()) report.external_work = work_.since_step(supply_);
  if (const Index facet = up ? first_.facets.turned_over(now_first_.others, *up, ground_) : -1;
      facet >= 0)
    report.failure =
        Failure{first_.facets.particle_at(facet),
                fmt::format("the surface of '{}' folds over{}", second_.points.body().name, fold_)};
  const bool on_first = now_first_.gap <= now_second_.gap;
  const Real gap = std::min(now_first_.gap, now_second_.gap);
  if (!(gap < law_.range())) return report;
  if (gap < law_.interaction().least_gap() && !report.failure) {
    const GapSide<D>& side = on_first ? first_ : second_;
    report.failure = Failure{
        side.points.particle_at(on_first ? now_first_.nearest : now_second_.nearest),
        fmt::format("surfaces overlap: the gap between '{}' and '{}' is {:.4g}, least is {:.4g}{}",
                    first_.points.body().name, second_.points.body().name, gap,
                    law_.interaction().least_gap(), motion.time > 0 ? overlap_ : ""),
        true};
  }
  const Real speed = closing_speed<D>(first_.points, now_first_.near, &second_.points,
                                      now_second_.near, Vec<D>::Zero(), motion);
  const Real strength = law_.varies_at(gap) ? largest_adhesion(motion.time) : 1;
  const Real inverse_inertia = 1 / first_.points.inertia() + 1 / second_.points.inertia();
  report.demand =
      contact_demand({law_.interaction(), strength * inverse_inertia, 0, D}, gap, {speed});
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
