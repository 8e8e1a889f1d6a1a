// SPDX-License-Identifier: BSD-3-Clause
// Contact of a deformable body with a rigid partner, whose field is known in closed form.
#include "meniscus/error.hpp"
#include "physics/assembled_force.hpp"
#include "physics/contact/contact_numbers.hpp"
#include "physics/contact/contact_terms.hpp"
#include "physics/contact/pair/contact_demand.hpp"
#include "physics/contact/pair/contact_visits.hpp"
#include "physics/contact/phases.hpp"
#include "physics/contact/rigid/layer_effects.hpp"
#include "physics/contact/rigid/partner_field.hpp"
#include "physics/contact/rigid/partner_measures.hpp"
#include "physics/contact/rigid/partner_tangent.hpp"
#include "physics/contact/rigid/partner_visits.hpp"
#include "physics/contact/rigid/partner_work.hpp"
#include "physics/contact/rigid/pressed_partner.hpp"
#include "physics/continued_term.hpp"

#include <fmt/core.h>

#include <numeric>

namespace meniscus {
namespace {

template <int D>
class RigidContact final : public ForceTerm,
                           public ContactVisits,
                           public AssembledForce,
                           public ContinuedTerm {
 public:
  RigidContact(const ContactBody<D>& body, MovingPartner<D> partner,
               std::shared_ptr<const Interaction> interaction, const ContactChoice& choice)
      : name_(choice.name),
        overlap_(choice.overlap),
        wets_(choice.wets),
        pair_(body, std::move(partner), std::move(interaction), choice),
        effects_(*pair_.interaction, pair_.partner, choice.friction),
        steady_after_(pair_.partner.motion.steady_after()),
        layers_(layers_at_rest(pair_)),
        effect_sums_(layer_tallies<WallSums>(pair_)),
        force_sums_(layer_tallies<Resultant>(pair_)),
        list_(pair_.interaction->range()),
        moves_(body.body.division),
        speeds_(body.body.division),
        of_parts_(body.body.division) {
    close_.reserve(static_cast<std::size_t>(pair_.finest().clusters()));
    if (press() && effects_.any())
      throw InputError("contact '" + name_ +
                       "': friction and adhesion by formulas go without a direction of the "
                       "partner; allowed are numbers and no friction");
    if (press()) pressed_ = std::make_unique<PressedPoints<D>>(pair_);
    if (const auto* pattern = effects_.pattern()) {
      require_adhesion(pair_, *pattern);
      steady_after_ = std::max(steady_after_, pattern->steady_after());
    }
  }

  std::string name() const override { return "contact '" + name_ + "'"; }
  std::string_view energy_kind() const override { return "contact"; }

  Report add_force(const Motion& motion, Forces force) override {
    effects_.begin(motion.time);
    if (const auto failure = settle(motion)) return failed({-1, *failure});
    if (!pair_.work.takes_part()) return sum_up(motion, force);
    if (!pair_.interaction->ends()) return place(motion, force);
    if (Real* const mine = moves_.mine())
      *mine = list_.farthest(pair_.finest(), pair_.finest().own_particles(pair_.work), motion);
    gathered_.assign(1, moves_.gathered());
    return go_on<&RigidContact::place>(*this, pair_.work, gathered_, motion, force);
  }

  /// Adds the exact tangent. With varying adhesion or friction, a difference of forces replaces it.
  void add_tangent(const Motion& motion, const Motion& change, Forces force) override {
    if (effects_.any()) return ForceTerm::add_tangent(motion, change, force);
    settle(motion);
    choose_visited(pair_, motion, list_, layers_);
    take_layers(pair_, motion, layers_);
    if (!press()) return add_tangent_of_partner(pair_, layers_, motion, change, force);
    const NodalVectors du = relative_change(pair_, layers_, motion, change);
    add_tangent_of_partner(pair_, layers_, motion, {change.time, du, change.v}, force);
  }

  /// In 3D, assembly takes longer than iterations with elements (quasi-statics note 10).
  bool has_stiffness() const override {
    return D == 2 && !effects_.any() && !pair_.on_patches() && pair_.form == ContactForm::energy;
  }
  void announce(StiffnessMatrix& K) override {
    for (ContactPoints<D>& points : pair_.points) points.announce(K);
    if (!press()) return;
    const Body<D>& body = pair_.finest().body();
    std::vector<Index> particles(static_cast<std::size_t>(body.size()));
    std::iota(particles.begin(), particles.end(), body.first);
    way_node_ = K.add_nodes(1, true);
    K.announce_column(way_node_, std::move(particles));
  }
  /// The way of a pressed partner is an unknown of its own.
  void add_stiffness(const Motion& motion, std::span<const Lanes>, StiffnessMatrix& K) override {
    settle(motion);
    choose_visited(pair_, motion, list_, layers_);
    take_layers(pair_, motion, layers_);
    if (K.is_here()) add_stiffness_of_partner(pair_, layers_, motion, K);
    if (press()) add_stiffness_of_way(pair_, layers_, motion, way_node_, K);
  }

  std::optional<Real> stored_energy(const Motion& motion) const override {
    settle(motion);
    return energy_of(pair_, layers_at(pair_, effects_, motion)) +
           (press() ? press()->energy(motion.time) : 0);
  }
  std::optional<Real> potential(const Motion& motion) override {
    if (pair_.form != ContactForm::energy || effects_.rubs()) return std::nullopt;
    return stored_energy(motion);
  }
  Real work_between(const Motion& before, const Motion& after) const override {
    if (press()) {
      settle(before);
      const auto begin = press()->now(before.time);
      settle(after);
      return press()->work(begin, press()->now(after.time));
    }
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
    effects_.commit(motion.time, sums_);
    if (press()) {
      settle(motion);
      press()->commit(motion.time);
    }
    if (pair_.partner.motion.moves())
      work_.commit(spatial<D>(pair_.shift(motion)), resultant_.force);
  }
  void archive(const Archive& a) override {
    effects_.archive(a);
    if (press()) press()->archive(a);
    if (pair_.partner.motion.moves()) work_.archive(a, D);
  }
  /// A pressed partner begins at its last place, which may be one of several.
  void continue_from(const Archive& a) override {
    std::optional<Real> way;  // empty if the partner was not pressed
    if (press()) a("way", way, dimension::length);
    if (!way) return;
    press()->set_way(*way);
    press()->commit(0);
  }
  bool reads(StepReads& reads) override {
    if (press()) return false;  // its way depends on all particles
    for (std::size_t g = 0; g < pair_.points.size(); ++g)
      pair_.on_patches() ? pair_.points[g].list_own_nodes(reads)
                         : pair_.points[g].list_reads(reads, pair_.moved(g));
    return true;
  }
  bool may_reject_steps() const override { return true; }
  bool stops_drift() const override { return true; }

  bool viscous() const override { return effects_.rubs(); }
  /// Adds friction with this velocity at the positions of the last force. Overwrites T of that
  /// force.
  void add_viscous(const Motion& motion, Forces force) override {
    if (!pair_.work.takes_part()) return;
    gathered_.clear();
    if (pair_.on_patches())
      for (std::size_t g = 0; g < layers_.size(); ++g)
        gathered_.push_back(pair_.points[g].place(layers_[g].near, pair_.work, Placed::velocities,
                                                  motion, layers_[g].places));
    go_on<&RigidContact::add_friction>(*this, pair_.work, gathered_, motion, force);
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
  using Placed = typename ContactPoints<D>::Placed;

  PartnerPress<D>* press() const { return pair_.partner.motion.press(); }
  /// Moves a pressed partner to its place at a motion. Returns the cause if it has none.
  std::optional<std::string> settle(const Motion& motion) const {
    if (!press() || settle_partner(pair_, motion, *pressed_)) return std::nullopt;
    return fmt::format(
        "nothing stops the rigid partner of contact '{}', which a force of {:.4g} pushes along its "
        "direction; expected is a body in its way, or a stiffness",
        name_, press()->force(motion.time));
  }
  static Report failed(const Failure& failure) {
    Report report;
    report.failure = failure;
    return report;
  }

  /// Moves the first points that are needed. For a finite range these are the points of the list,
  /// or all points if the list is not valid any more; otherwise they are the coarsest points.
  Report place(const Motion& motion, Forces force) {
    const bool ends = pair_.interaction->ends();
    listed_ =
        ends && list_.holds(*std::max_element(moves_.begin(), moves_.end()), pair_.shift(motion));
    return place_points<&RigidContact::choose>({ends ? 0 : layers_.size() - 1, !listed_, what()},
                                               motion, force);
  }
  /// Points that place() moves.
  struct Places {
    std::size_t grade = 0;
    bool all = false;  ///< or only the visited ones
    Placed what = Placed::positions;
  };
  template <auto next>
  Report place_points(const Places& wanted, const Motion& motion, Forces force) {
    wanted_ = wanted;
    PartnerLayer<D>& layer = layers_[wanted.grade];
    if (!pair_.on_patches()) {
      // Visited points are moved with their weights, by move_visited().
      if (wanted.all && (pair_.interaction->ends() || layers_.size() > 1))
        move_points(pair_, wanted.grade, motion, layer);
      return (this->*next)(motion, force);
    }
    gathered_.assign(1, pair_.points[wanted.grade].place(placed(), pair_.work, wanted.what, motion,
                                                         layer.places));
    return go_on<next>(*this, pair_.work, gathered_, motion, force);
  }
  std::span<const Index> placed() const {
    return wanted_.all ? pair_.points[wanted_.grade].all()
                       : std::span<const Index>(layers_[wanted_.grade].visited);
  }
  Placed what() const { return effects_.any() ? Placed::velocities : Placed::weights; }
  /// Takes the points that place() has moved.
  void take_placed() {
    if (pair_.on_patches())
      pair_.points[wanted_.grade].take_placed(placed(), pair_.work, wanted_.what,
                                              layers_[wanted_.grade].places);
  }
  /// Chooses the visited points.
  Report choose(const Motion& motion, Forces force) {
    take_placed();
    if (listed_) return take_fields(motion, force);
    if (!pair_.interaction->ends() && layers_.size() == 1) return take_fields(motion, force);
    take_distances(pair_, wanted_.grade, motion, layers_[wanted_.grade]);
    if (pair_.interaction->ends()) {
      list_.begin(pair_.finest(), motion, pair_.shift(motion));
      choose_within_reach(pair_, list_, layers_.front());
      if (pair_.on_patches())  // all points were placed
        pair_.finest().update_weights(layers_.front().visited, motion, layers_.front().places);
      return take_fields(motion, force);
    }
    choose_grades(pair_, layers_);
    if (!pair_.on_patches()) return take_fields(motion, force);
    gathered_.clear();
    for (std::size_t g = 0; g < layers_.size(); ++g)
      gathered_.push_back(
          pair_.points[g].place(layers_[g].visited, pair_.work, what(), motion, layers_[g].places));
    return go_on<&RigidContact::take_grades>(*this, pair_.work, gathered_, motion, force);
  }
  Report take_grades(const Motion& motion, Forces force) {
    for (std::size_t g = 0; g < layers_.size(); ++g)
      pair_.points[g].take_placed(layers_[g].visited, pair_.work, what(), layers_[g].places);
    return take_fields(motion, force);
  }
  /// Computes the field at a share of the visited points.
  Report take_fields(const Motion& motion, Forces force) {
    if (!pair_.on_patches()) move_visited(pair_, motion, layers_);
    gathered_.clear();
    for (std::size_t g = 0; g < layers_.size(); ++g)
      gathered_.push_back(
          take_forces(pair_, g, motion, pair_.evaluated(layers_[g].visited), layers_[g]));
    if (!pair_.on_patches()) return add_forces(motion, force);
    return go_on<&RigidContact::add_forces>(*this, pair_.work, gathered_, motion, force);
  }
  /// Adds the forces to the particles.
  Report add_forces(const Motion& motion, Forces force) {
    for (PartnerLayer<D>& layer : layers_) take_sent(pair_.evaluated(layer.visited), layer);
    if (effects_.any()) add_effects(pair_, effects_, motion, layers_, effect_sums_);
    for (std::size_t g = 0; g < layers_.size(); ++g) {
      const PartnerLayer<D>& layer = layers_[g];
      // Also without visited points: contacts that share points add their sums in the same order on
      // any number of processes, of which one may have visited points and another may not.
      pair_.points[g].add_force(layer.places, layer.visited, layer.T, layer.moment(pair_.form),
                                force);
    }
    find_near(pair_, layers_);
    sum_resultants(pair_, layers_, force_sums_);
    if (OfPart* const mine = of_parts_.mine()) {
      *mine = {nearest_point(pair_, layers_), 0, {}};
      for (const PartnerLayer<D>& layer : layers_)
        mine->visited += static_cast<Offset>(layer.visited.size()) * Lanes::width;
      if (force.demand)
        mine->boxes = {pair_.finest(), pair_.finest().own_particles(pair_.work), motion};
    }
    return sum_up(motion, force);
  }
  /// Gathers what the report needs.
  Report sum_up(const Motion& motion, Forces force) {
    gathered_.assign(1, of_parts_.gathered());
    for (std::size_t g = 0; g < layers_.size(); ++g) {
      if (effects_.any()) gathered_.push_back(effect_sums_[g].gathered());
      gathered_.push_back(force_sums_[g].gathered());
    }
    return force.gather(gathered_, motion,
                        [this](const Motion& m, const Forces& all) { return report(m, all); });
  }
  Report report(const Motion& motion, Forces force);
  void find_nearest();
  Report limit_far(const Motion& motion, Forces force);
  Report take_far(const Motion& motion, Forces force);
  Report share_distances(const Motion& motion, Forces force);
  Report limit_near(const Motion& motion, Forces force);
  Report limit_by_speed(const Motion& motion);
  Approach fastest(const Motion& motion) const;
  Vec<D> velocity(const Motion& motion) const {
    return pair_.partner.motion.moves() ? pair_.velocity(motion) : Vec<D>(Vec<D>::Zero());
  }
  Report add_friction(const Motion& motion, Forces force) {
    if (pair_.on_patches())
      for (std::size_t g = 0; g < layers_.size(); ++g)
        pair_.points[g].take_placed(layers_[g].near, pair_.work, Placed::velocities,
                                    layers_[g].places);
    take_friction(pair_, effects_, motion, layers_);
    for (std::size_t g = 0; g < layers_.size(); ++g)
      pair_.points[g].add_force(layers_[g].places, layers_[g].near, layers_[g].T, {}, force);
    return {};
  }
  Failure describe_overlap(const NearestPoint& nearest, Real time) const;
  Real closing_speed_of(std::size_t grade, Real within, const Motion& motion);

  std::string name_;
  std::string overlap_;  // advice for surfaces that pass through each other
  bool wets_;
  BodyAndPartner<D> pair_;
  WallEffects<D> effects_;
  Real steady_after_;
  // Results and work space of the last force.
  PartnerLayers<D> layers_;
  LayerTallies<WallSums> effect_sums_;
  LayerTallies<Resultant> force_sums_;
  WallSums sums_;
  Resultant resultant_;
  PartnerWork work_;
  ReachList<D> list_;
  // A pressed partner has these.
  std::unique_ptr<PressedPoints<D>> pressed_;
  Index way_node_ = -1;
  std::vector<Index> close_;  // clusters that determine the closing speed
  /// Results of a process.
  struct OfPart {
    NearestPoint nearest;
    Offset visited = 0;
    CoefficientBoxes<D> boxes;
  };
  PartTally<Real> moves_, speeds_;
  PartTally<OfPart> of_parts_;
  NearestPoint nearest_;  // of all points
  std::vector<Gathered> gathered_;
  bool listed_ = false;  // the list holds
  Places wanted_;        // of the last place()
};

/// Work of the partner, heat and failures of the last force; then the limit of the step.
template <int D>
Report RigidContact<D>::report(const Motion& motion, Forces force) {
  sums_ = {};
  if (effects_.any())
    for (const ChunkTally<WallSums>& of_grade : effect_sums_)
      sums_ = sums_ + of_grade.sum(WallSums());
  Report report;
  report.outside = resultant_ = resultant(force_sums_);
  if (pair_.partner.motion.moves()) {
    const Eigen::Vector3d shift = spatial<D>(pair_.shift(motion));
    work_.begin(shift);
    report.external_work = work_.since_step(shift, resultant_.force);
  }
  if (press()) report.external_work = press()->work_since_step(motion.time);
  report.external_work += effects_.work(sums_);
  report.heat = sums_.heat;
  find_nearest();
  Offset visited = 0;
  for (const OfPart& of_part : of_parts_)
    visited = pair_.division.is_to_each() ? of_part.visited : visited + of_part.visited;
  count(visited);
  const Interaction& interaction = *pair_.interaction;
  if (nearest_.distance < interaction.least_gap())
    report.failure = describe_overlap(nearest_, motion.time);
  if (!force.demand) return report;
  if (!(nearest_.distance < interaction.range()) && interaction.ends()) {
    // The distances of points out of reach are from the last build of the list.
    report += limit_far(motion, force);
  } else {
    report += limit_near(motion, force);
  }
  return report;
}

template <int D>
void RigidContact<D>::find_nearest() {
  nearest_ = {};
  for (const OfPart& of_part : of_parts_) nearest_ = nearer(nearest_, of_part.nearest);
}

/// Finds the distances of all points, which are all out of range.
template <int D>
Report RigidContact<D>::limit_far(const Motion& motion, Forces force) {
  if (!pair_.work.takes_part()) return share_distances(motion, force);
  return place_points<&RigidContact::take_far>({0, true, Placed::positions}, motion, force);
}

template <int D>
Report RigidContact<D>::take_far(const Motion& motion, Forces force) {
  take_placed();
  take_distances(pair_, 0, motion, layers_.front());
  if (OfPart* const mine = of_parts_.mine()) mine->nearest = nearest_point(pair_, layers_);
  return share_distances(motion, force);
}

template <int D>
Report RigidContact<D>::share_distances(const Motion& motion, Forces force) {
  return force.gather({of_parts_.gathered()}, motion, [this](const Motion& m, const Forces& all) {
    find_nearest();
    return limit_near(m, all);
  });
}

/// The limit of the step; points within the range have to be known.
template <int D>
Report RigidContact<D>::limit_near(const Motion& motion, Forces force) {
  const Interaction& interaction = *pair_.interaction;
  const Real gap = nearest_.distance;
  if (!(gap < interaction.range())) {
    Report report;
    report.demand = approach_demand(fastest(motion), interaction.range());
    return report;
  }
  const Real within = std::min(close_by(gap), interaction.range());
  if (Real* const mine = speeds_.mine()) {
    *mine = 0;
    for (std::size_t g = 0; g < layers_.size(); ++g)
      *mine = std::max(*mine, closing_speed_of(g, within, motion));
  }
  return force.gather({speeds_.gathered()}, motion,
                      [this](const Motion& m, const Forces&) { return limit_by_speed(m); });
}

template <int D>
Report RigidContact<D>::limit_by_speed(const Motion& motion) {
  const Interaction& interaction = *pair_.interaction;
  const Real gap = nearest_.distance;
  const Real strength = effects_.varies_at(gap) ? sums_.adhesion : 1;
  Report report;
  report.demand =
      contact_demand({interaction, strength / pair_.finest().inertia(), 0, D}, gap,
                     {*std::max_element(speeds_.begin(), speeds_.end()),
                      std::min(close_by(gap), interaction.range()), fastest(motion).speed});
  return report;
}

template <int D>
Approach RigidContact<D>::fastest(const Motion& motion) const {
  CoefficientBoxes<D> all;
  for (const OfPart& of_part : of_parts_) all.join(of_part.boxes);
  return approach<D>(pair_.finest(), all, nearest_.distance, velocity(motion));
}

template <int D>
Failure RigidContact<D>::describe_overlap(const NearestPoint& nearest, Real time) const {
  return {
      pair_.points[nearest.grade].particle_at(nearest.point),
      fmt::format("surfaces overlap: the gap between '{}' and the rigid partner of contact "
                  "'{}' is {:.4g}, least is {:.4g}{}",
                  pair_.finest().body().name, name_, nearest.distance - pair_.interaction->recess(),
                  pair_.interaction->least_gap() - pair_.interaction->recess(),
                  time > 0 ? overlap_ : ""),
      true};
}

/// Speed at which the points of a grade approach the partner. Only points within a distance below
/// the range count.
template <int D>
Real RigidContact<D>::closing_speed_of(std::size_t grade, Real within, const Motion& motion) {
  const PartnerLayer<D>& layer = layers_[grade];
  close_.clear();
  for (const Index c : layer.near)
    if (layer.nearest_of(c) < within) close_.push_back(c);
  return closing_speed<D>(pair_.points[grade], close_, pair_.work, velocity(motion), motion);
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
