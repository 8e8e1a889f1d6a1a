// SPDX-License-Identifier: BSD-3-Clause
// Contact of a deformable body with a rigid partner, whose field is known in closed form.
#include "meniscus/error.hpp"
#include "physics/contact/contact_numbers.hpp"
#include "physics/contact/contact_terms.hpp"
#include "physics/contact/pair/contact_demand.hpp"
#include "physics/contact/pair/contact_visits.hpp"
#include "physics/contact/rigid/layer_effects.hpp"
#include "physics/contact/rigid/partner_field.hpp"
#include "physics/contact/rigid/partner_measures.hpp"
#include "physics/contact/rigid/partner_tangent.hpp"
#include "physics/contact/rigid/partner_visits.hpp"
#include "physics/contact/rigid/partner_work.hpp"

#include <fmt/core.h>

namespace meniscus {
namespace {

/// Time after which the partner stays at rest, with the resolution of 1e-4 of the run. Infinite if
/// it never does.
template <int D>
Real end_of_motion(const MovingPartner<D>& partner) {
  if (!partner.motion.moves()) return 0;
  constexpr int steps_of_run = 10000;
  const auto place = [&](int k) { return partner.motion.displacement(k * partner.velocity_step); };
  const Vec<D> last = place(steps_of_run);
  int k = steps_of_run;
  while (k > 0 && place(k - 1) == last) --k;
  return k == steps_of_run ? std::numeric_limits<Real>::infinity() : k * partner.velocity_step;
}

template <int D>
class RigidContact final : public ForceTerm, public ContactVisits {
 public:
  RigidContact(const ContactBody<D>& body, MovingPartner<D> partner,
               std::shared_ptr<const Interaction> interaction, const ContactChoice& choice)
      : name_(choice.name),
        overlap_(choice.overlap),
        wets_(choice.wets),
        pair_(body, std::move(partner), std::move(interaction), choice),
        effects_(*pair_.interaction, pair_.partner, choice.friction),
        steady_after_(end_of_motion(pair_.partner)),
        layers_(layers_at_rest(pair_)),
        list_(pair_.interaction->range()) {
    close_.reserve(static_cast<std::size_t>(pair_.finest().clusters()));
    if (const auto* pattern = effects_.pattern()) {
      require_adhesion(pair_, *pattern);
      if (pattern->depends_on_time()) steady_after_ = std::numeric_limits<Real>::infinity();
    }
  }

  std::string name() const override { return "contact '" + name_ + "'"; }
  std::string_view energy_kind() const override { return "contact"; }

  Report add_force(const Motion& motion, Forces force) override {
    effects_.begin(motion.time);
    return pair_.ranks.report_of([&] { return add_known_force(motion, force); });
  }

  /// Adds the exact tangent. With varying adhesion or friction, a difference of forces replaces it.
  void add_tangent(const Motion& motion, const Motion& change, Forces force) override {
    if (effects_.any()) return ForceTerm::add_tangent(motion, change, force);
    choose_visited(pair_, motion, list_, layers_);
    take_forces(pair_, motion, layers_);
    add_tangent_of_partner(pair_, layers_, motion, change, force);
  }

  std::optional<Real> stored_energy(const Motion& motion) const override {
    return energy_of(pair_, layers_at(pair_, effects_, motion));
  }
  std::optional<Real> potential(const Motion& motion) override {
    if (pair_.form != ContactForm::energy || effects_.rubs()) return std::nullopt;
    return stored_energy(motion);
  }
  Real work_between(const Motion& before, const Motion& after) const override {
    const Vec<D> way = pair_.shift(after) - pair_.shift(before);
    if (way.isZero(0)) return ForceTerm::work_between(before, after);
    const auto force_at = [&](const Motion& motion) {
      return resultant(pair_, layers_at(pair_, effects_, motion)).force;
    };
    return 0.5 * (force_at(before) + force_at(after)).dot(spatial<D>(way));
  }
  Real steady_after() const override { return steady_after_; }

  /// Accepts the step. The last computed force must belong to this motion.
  void commit(const Motion& motion) override {
    if (pair_.ranks.is_absent()) return;
    effects_.commit(motion.time, sums_);
    if (pair_.partner.motion.moves())
      work_.commit(spatial<D>(pair_.shift(motion)), resultant_.force);
  }
  void archive(const Archive& a) override {
    effects_.archive(a);
    if (pair_.partner.motion.moves()) work_.archive(a, D);
  }
  void complete_history() override {
    effects_.complete_history(pair_.ranks);
    if (pair_.partner.motion.moves()) pair_.ranks.complete(work_);
  }
  bool tell_reads(StepReads& reads) override {
    pair_.ranks.learn_halo(reads);
    if (pair_.ranks.are_few()) {
      for (ContactPoints<D>& points : pair_.points)
        points.tell_reads_alone(reads, pair_.ranks.takes_part());
      return true;
    }
    told_ = visited_parts();
    if (told_->touches)
      pair_.points.front().tell_reads(reads, layers_.front().visited);
    else
      for (std::size_t g = 0; g < pair_.points.size(); ++g)
        pair_.points[g].tell_reads(reads, pair_.moved_clusters(g));
    return true;
  }
  bool reads_changed() const override { return told_ && *told_ != visited_parts(); }
  bool may_outgrow_halo() const override { return !pair_.ranks.are_few(); }
  bool may_reject_steps() const override { return true; }
  bool stops_drift() const override { return true; }

  bool viscous() const override { return effects_.rubs(); }
  /// Adds friction with this velocity at the positions of the last force. Overwrites T of that
  /// force.
  void add_viscous(const Motion& motion, Forces force) override {
    if (pair_.ranks.is_absent()) return;
    take_friction(pair_, effects_, motion, layers_);
    for (std::size_t g = 0; g < layers_.size(); ++g)
      if (!pair_.without(layers_[g].near))
        pair_.points[g].add_force(layers_[g].places, layers_[g].near, layers_[g].T, {}, force);
  }

  /// Warns if the contact points are too coarse for the gap. Not for planes and spheres: their
  /// fields are exact and smooth over many gaps, so few points suffice.
  std::optional<std::string> warning(const Motion& motion) const override {
    if (pair_.partner.surface && pair_.partner.surface->round()) return std::nullopt;
    return unresolved_gap(name_, gap_at(pair_, motion), pair_.finest().spacing(),
                          pair_.interaction->range());
  }

  std::vector<MeasureSource> measures() const override {
    return measures_of(pair_, effects_, wets_);
  }

  std::size_t bytes() const override {
    std::size_t n = list_.bytes();
    for (const ContactPoints<D>& points : pair_.points) n += points.bytes();
    for (const PartnerLayer<D>& layer : layers_) n += layer.bytes();
    return n;
  }
  Offset pairs() const override {
    Offset n = 0;
    for (const ContactPoints<D>& points : pair_.points) n += points.pairs() + points.size();
    return n;
  }

 private:
  /// Adds the force on a rank that takes part in the contact.
  Report add_known_force(const Motion& motion, Forces force) {
    choose_visited(pair_, motion, list_, layers_);
    take_forces(pair_, motion, layers_);
    sums_ = add_effects(pair_, effects_, motion, layers_);
    for (std::size_t g = 0; g < layers_.size(); ++g) {
      const PartnerLayer<D>& layer = layers_[g];
      if (pair_.without(layer.visited)) continue;
      pair_.points[g].add_force(layer.places, layer.visited, layer.T, layer.moment(pair_.form),
                                force);
    }
    find_near(pair_, layers_);
    const VisitedPoints visited = visited_points(pair_, motion, layers_);
    count(visited.count);
    return report(motion, visited.nearest);
  }
  /// For an interaction of finite range: number of the neighbour list, and whether any point is in
  /// range. If none is, the distances of all points are needed.
  struct VisitedParts {
    std::int64_t list;
    bool touches;
    bool operator==(const VisitedParts&) const = default;
  };
  VisitedParts visited_parts() const {
    return {list_.times(), pair_.interaction->ends() && touches_};
  }
  Report report(const Motion& motion, const NearestPoint& nearest);
  Failure describe_overlap(const NearestPoint& nearest, Real time) const;
  Real closing_speed_of(std::size_t grade, Real within, const Vec<D>& velocity,
                        const Motion& motion);

  std::string name_;
  std::string overlap_;  // advice for surfaces that pass through each other
  bool wets_;
  BodyAndPartner<D> pair_;
  WallEffects<D> effects_;
  Real steady_after_;
  // Results and work space of the last force.
  PartnerLayers<D> layers_;
  WallSums sums_;
  Resultant resultant_;
  bool touches_ = false;  // true if some point is within the range
  PartnerWork work_;
  ReachList<D> list_;
  std::optional<VisitedParts> told_;  // visited parts at tell_reads()
  std::vector<Index> close_;          // clusters that determine the closing speed
};

/// Report of the last force: work of the partner, failures, and the limit of the step.
template <int D>
Report RigidContact<D>::report(const Motion& motion, const NearestPoint& nearest) {
  Report report;
  report.outside = resultant_ = resultant(pair_, layers_);
  Vec<D> velocity = Vec<D>::Zero();
  if (pair_.partner.motion.moves()) {
    velocity = pair_.velocity(motion);
    const Eigen::Vector3d shift = spatial<D>(pair_.shift(motion));
    work_.begin(shift);
    report.external_work = work_.since_step(shift, resultant_.force);
  }
  report.external_work += effects_.work(sums_);
  report.heat = sums_.heat;
  const Interaction& interaction = *pair_.interaction;
  const Real gap = nearest.distance;
  const Approach any = approach<D>(pair_.finest(), gap, velocity, motion);
  touches_ = gap < interaction.range();
  if (!touches_) {
    report.demand = approach_demand(any, interaction.range());
    return report;
  }
  if (gap < interaction.least_gap()) report.failure = describe_overlap(nearest, motion.time);
  const Real within = std::min(close_by(gap), interaction.range());
  Real speed = 0;
  for (std::size_t g = 0; g < layers_.size(); ++g)
    speed = std::max(speed, closing_speed_of(g, within, velocity, motion));
  speed = pair_.largest(speed);
  const Real strength = effects_.varies_at(gap) ? sums_.adhesion : 1;
  report.demand = contact_demand({interaction, strength / pair_.finest().inertia(), 0, D}, gap,
                                 {speed, within, any.speed});
  return report;
}

template <int D>
Failure RigidContact<D>::describe_overlap(const NearestPoint& nearest, Real time) const {
  return {pair_.points[nearest.grade].particle_at(nearest.point),
          fmt::format("surfaces overlap: the gap between '{}' and the rigid partner of contact "
                      "'{}' is {:.4g}, least is {:.4g}{}",
                      pair_.finest().body().name, name_, nearest.distance,
                      pair_.interaction->least_gap(), time > 0 ? overlap_ : ""),
          true};
}

/// Speed at which the points of a grade approach the partner. Only points within a distance below
/// the range count.
template <int D>
Real RigidContact<D>::closing_speed_of(std::size_t grade, Real within, const Vec<D>& velocity,
                                       const Motion& motion) {
  const PartnerLayer<D>& layer = layers_[grade];
  close_.clear();
  for (const Index c : layer.near)
    if (layer.nearest_of(c) < within) close_.push_back(c);
  const ItemRange part = pair_.parts().own_items(static_cast<Index>(close_.size()));
  const std::span<const Index> mine(close_.data() + part.begin, close_.data() + part.end);
  return closing_speed<D>(pair_.points[grade], mine, nullptr, {}, velocity, motion);
}

}  // namespace

template <int D>
std::unique_ptr<ForceTerm> rigid_contact(const ContactBody<D>& body, MovingPartner<D> partner,
                                         std::shared_ptr<const Interaction> interaction,
                                         const ContactChoice& choice) {
  if (choice.form == ContactForm::volume)
    throw InputError(
        "form = \"volume\" is for two deformable bodies; a rigid partner is known by its surface "
        "interaction (allowed are energy, pressure, dissertation)");
  if (interaction->pattern() && choice.form != ContactForm::energy)
    throw InputError("contact '" + choice.name +
                     "': adhesion that varies has a force from its energy alone; use form = "
                     "\"energy\", or numbers");
  return std::make_unique<RigidContact<D>>(body, std::move(partner), std::move(interaction),
                                           choice);
}

template <int D>
std::unique_ptr<ForceTerm> rigid_contact(const ContactBody<D>& body, MovingPartner<D> partner,
                                         const ContactLaw& law, const ContactChoice& choice) {
  auto interaction = std::make_shared<LennardJones>(law, body.beta * partner.beta);
  return rigid_contact(body, std::move(partner), std::move(interaction), choice);
}

#define MENISCUS_INSTANTIATE(D)                                                              \
  template std::unique_ptr<ForceTerm> rigid_contact(const ContactBody<D>&, MovingPartner<D>, \
                                                    std::shared_ptr<const Interaction>,      \
                                                    const ContactChoice&);                   \
  template std::unique_ptr<ForceTerm> rigid_contact(const ContactBody<D>&, MovingPartner<D>, \
                                                    const ContactLaw&, const ContactChoice&);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
