// SPDX-License-Identifier: BSD-3-Clause
// Contact of a deformable body with a rigid partner in closed form.
#include "meniscus/core/dense.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/physics/contact.hpp"
#include "meniscus/physics/contact_demand.hpp"
#include "meniscus/physics/contact_numbers.hpp"

#include <fmt/core.h>

#include <cmath>
#include <numeric>

#include "contact_tangent.hpp"
#include "reach_list.hpp"
#include "wall_effects.hpp"

namespace meniscus {
namespace {

/// x cross y; in the plane the third component.
template <int D>
Eigen::Vector3d cross(const Vec<D>& x, const Vec<D>& y) {
  return meniscus::cross(spatial<D>(x), spatial<D>(y));
}

template <int D>
class RigidContact final : public ForceTerm {
 public:
  RigidContact(const ContactBody<D>& body, MovingPartner<D> partner,
               std::shared_ptr<const Interaction> interaction, const ContactChoice& choice)
      : name_(choice.name),
        interaction_(std::move(interaction)),
        form_(choice.form),
        wets_(choice.wets),
        partner_(std::move(partner)),
        effects_(*interaction_, partner_, choice.friction),
        points_(surface_contact_points(body.body, body.beta, choice, 0)),
        all_(static_cast<std::size_t>(points_.clusters())),
        now_(points_),
        list_(interaction_->range()) {
    std::iota(all_.begin(), all_.end(), Index{0});
    near_.reserve(all_.size());
    if (partner_.motion.moves()) steady_after_ = end_of_motion();
    if (const auto* pattern = effects_.pattern()) {
      require_adhesion(*pattern);
      if (pattern->depends_on_time()) steady_after_ = std::numeric_limits<Real>::infinity();
    }
  }

  std::string name() const override { return "contact '" + name_ + "'"; }
  std::string_view energy_kind() const override { return "contact"; }

  Report add_force(const Motion& motion, Forces force) override {
    effects_.begin(motion.time);
    const std::span<const Index> visited = in_reach(motion);
    evaluate(motion, visited, now_);
    add_effects(motion, visited, now_);
    const std::span<const Lanes> S =
        form_ == ContactForm::energy ? std::span<const Lanes>(now_.S) : std::span<const Lanes>();
    points_.add_force(now_.places, visited, now_.T, S, force);
    return report(motion);
  }

  void add_tangent(const Motion& motion, const Motion& change, Forces force) override;

  std::optional<Real> stored_energy(const Motion& motion) const override {
    return energy_of(evaluated(motion));
  }
  std::optional<Real> potential(const Motion& motion) override {
    if (form_ != ContactForm::energy || effects_.rubs()) return std::nullopt;
    return stored_energy(motion);
  }
  Real work_between(const Motion& before, const Motion& after) const override {
    const Vec<D> way =
        partner_.motion.displacement(after.time) - partner_.motion.displacement(before.time);
    if (way.isZero(0)) return ForceTerm::work_between(before, after);
    return 0.5 * (net_force(evaluated(before)) + net_force(evaluated(after))).dot(way);
  }
  Real steady_after() const override { return steady_after_; }

  /// The last force was that of this motion.
  void commit(const Motion& motion) override { effects_.commit(motion.time, now_.sums); }
  void archive(const Archive& a) override { effects_.archive(a); }
  bool viscous() const override { return effects_.rubs(); }
  void add_viscous(const Motion& motion, Forces force) override;
  bool may_reject_steps() const override { return true; }
  bool stops_drift() const override { return true; }

  /// Fields of planes and spheres are smooth over many gaps, and exact: few points do no harm
  /// there.
  std::optional<std::string> warning(const Motion& motion) const override {
    if (partner_.surface && partner_.surface->round()) return std::nullopt;
    return unresolved_gap(name_, evaluated(motion).gap(), points_.spacing(), interaction_->range());
  }

  std::vector<MeasureSource> measures() const override;

  std::size_t bytes() const override {
    return points_.bytes() + now_.places.bytes() + (now_.T.size() + now_.S.size()) * sizeof(Lanes) +
           list_.bytes();
  }
  Offset pairs() const override { return points_.pairs() + points_.size(); }

 private:
  /// Places of the points and their forces, [cluster][i] as in contact_forms.hpp.
  struct Evaluation {
    ContactPlaces<D> places;
    AlignedVector<Lanes> T, S;
    AlignedVector<Lanes> distances;  // [cluster] from the surface of the partner
    WallSums sums;

    explicit Evaluation(const ContactPoints<D>& points) : places(points.at_rest()) {
      T.assign(static_cast<std::size_t>(points.clusters()) * D, Lanes::zero());
      S = T;
      distances.assign(static_cast<std::size_t>(points.clusters()), Lanes::zero());
    }
    Real distance(Index q) const { return at(distances, q / Lanes::width)[q % Lanes::width]; }
    Index nearest_point() const {
      Index nearest = 0;
      for (Index q = 0; q < places.size; ++q)
        if (distance(q) < distance(nearest)) nearest = q;
      return nearest;
    }
    Real gap() const { return distance(nearest_point()); }
  };

  void require_adhesion(const AdhesionPattern& W) const;
  Real end_of_motion() const;
  std::span<const Index> in_reach(const Motion& motion);
  void evaluate(const Motion& motion, std::span<const Index> clusters, Evaluation& result) const;
  void evaluate(Index cluster, const Vec<D>& shift, Evaluation& result) const;
  void take_all_distances(const Motion& motion);
  void add_effects(const Motion& motion, std::span<const Index> clusters, Evaluation& result) const;
  WallPoints<D> wall_points(Index cluster, const Motion& motion, const Vec<D>& shift,
                            const Vec<D>& velocity, Evaluation& result) const;
  /// At any motion; takes memory.
  Evaluation evaluated(const Motion& motion) const {
    Evaluation result(points_);
    evaluate(motion, all_, result);
    add_effects(motion, all_, result);
    return result;
  }
  Real energy_of(const Evaluation& result) const {
    return parallel_sum(points_.clusters(), 0.0, [&](Index c) {
      Lanes E = Lanes::zero();
      for (int i = 0; i < D; ++i) E += at(result.S, c * D + i) * result.places.weight_of(c)[i];
      return sum(E);
    });
  }
  Real wetted_area(const Motion& motion) const {
    Evaluation uniform(points_);
    evaluate(motion, all_, uniform);
    const Real energy = effects_.pattern() ? unit_energy(uniform, motion.time) : energy_of(uniform);
    return std::max(0.0, -energy / effects_.adhesion());
  }
  Real unit_energy(const Evaluation& uniform, Real time) const {
    const Vec<D> shift = partner_.motion.displacement(time);
    return parallel_sum(uniform.places.size, 0.0, [&](Index q) {
      const Index c = q / Lanes::width;
      Vec<D> V, S;
      for (int i = 0; i < D; ++i) {
        V[i] = uniform.places.weight_of(c)[i][q % Lanes::width];
        S[i] = at(uniform.S, c * D + i)[q % Lanes::width];
      }
      return effects_.unit_energy(uniform.places.place(q) - shift, uniform.distance(q), V, S);
    });
  }
  Vec<D> mean_slip(const Motion& motion) const;
  Vec<D> velocity(const Motion& motion) const {
    return partner_.motion.velocity(motion.time, partner_.velocity_step);
  }
  Report report(const Motion& motion);
  /// Whether a point of the cluster is within the range.
  bool near(const Evaluation& result, Index cluster) const {
    return nearest_of(result, cluster) < interaction_->range();
  }
  static Real nearest_of(const Evaluation& result, Index cluster) {
    const Lanes& d = at(result.distances, cluster);
    return std::min(std::min(d[0], d[1]), std::min(d[2], d[3]));
  }

  Vec<D> net_force(const Evaluation& result) const {
    Vec<D> force = Vec<D>::Zero();
    for (const Index c : all_)
      for (int i = 0; i < D; ++i) force[i] -= sum(at(result.T, c * D + i));
    return force;
  }
  Eigen::Vector3d net_torque(const Evaluation& result) const;

  std::string name_;
  std::shared_ptr<const Interaction> interaction_;
  ContactForm form_;
  bool wets_;
  MovingPartner<D> partner_;
  WallEffects<D> effects_;
  ContactPoints<D> points_;
  std::vector<Index> all_;  // clusters
  Real steady_after_ = 0;
  // Work space of a force.
  Evaluation now_;
  ReachList<D> list_;
  std::vector<Index> near_;  // clusters within the range at the last force
};

/// Before a run, that W can be taken wherever on the partner the body may touch it first.
template <int D>
void RigidContact<D>::require_adhesion(const AdhesionPattern& W) const try {
  for (Index q = 0; q < points_.size(); ++q) {
    const Vec<D> X = points_.reference_place(q);
    const auto foot = partner_.surface->foot(X);
    W(spatial<D>(X - foot.distance * foot.normal), 0);
  }
} catch (const SolveError& error) {
  throw InputError(error.what());
}

/// From when on the partner stays where it is, to 1e-4 of the run; infinite if it never does.
template <int D>
Real RigidContact<D>::end_of_motion() const {
  constexpr int steps_of_run = 10000;
  const auto place = [&](int k) {
    return partner_.motion.displacement(k * partner_.velocity_step);
  };
  const Vec<D> last = place(steps_of_run);
  int k = steps_of_run;
  while (k > 0 && place(k - 1) == last) --k;
  return k == steps_of_run ? std::numeric_limits<Real>::infinity() : k * partner_.velocity_step;
}

/// Clusters that may feel the partner; all of them, for an interaction without end. Those are kept
/// in a list for as long as no other point can have come within the range.
template <int D>
std::span<const Index> RigidContact<D>::in_reach(const Motion& motion) {
  if (!interaction_->ends()) return all_;
  const Vec<D> shift = partner_.motion.displacement(motion.time);
  if (!list_.holds(points_, motion, shift)) {
    take_all_distances(motion);
    list_.begin(points_, motion, shift);
    for (const Index c : all_)
      if (nearest_of(now_, c) < list_.distance()) list_.add(c);
    std::fill(now_.T.begin(), now_.T.end(), Lanes::zero());
    std::fill(now_.S.begin(), now_.S.end(), Lanes::zero());
  }
  return list_.clusters();
}

template <int D>
void RigidContact<D>::evaluate(const Motion& motion, std::span<const Index> clusters,
                               Evaluation& result) const {
  points_.move(clusters, motion, result.places);
  points_.update_weights(clusters, motion, result.places);
  const Vec<D> shift = partner_.motion.displacement(motion.time);
  parallel_for(
      static_cast<Index>(clusters.size()),
      [&](Index k) { evaluate(at(clusters, k), shift, result); }, 16);
}

template <int D>
void RigidContact<D>::take_all_distances(const Motion& motion) {
  points_.move(motion, now_.places);
  const Vec<D> shift = partner_.motion.displacement(motion.time);
  parallel_for(
      points_.clusters(),
      [&](Index c) {
        for (int lane = 0; lane < Lanes::width; ++lane) {
          Vec<D> place;
          for (int i = 0; i < D; ++i) place[i] = now_.places.x_of(c)[i][lane] - shift[i];
          at(now_.distances, c).set(lane, partner_.shape->distance(place));
        }
      },
      16);
}

/// T and S of the four points of a cluster: T = grad S V, with S forming the energy S.V, or T = U V
/// for the pressure form. The dissertation's traction Sigma n = -beta1 grad S n is T without S.
template <int D>
void RigidContact<D>::evaluate(Index cluster, const Vec<D>& shift, Evaluation& result) const {
  const Lanes *x = result.places.x_of(cluster), *weight = result.places.weight_of(cluster);
  for (int lane = 0; lane < Lanes::width; ++lane) {
    Vec<D> place, V;
    for (int i = 0; i < D; ++i) {
      place[i] = x[i][lane] - shift[i];
      V[i] = weight[i][lane];
    }
    const RigidField<D> field = partner_.shape->field(place);
    const Vec<D> T = form_ == ContactForm::pressure ? Vec<D>(field.U * V) : field.grad_S * V;
    for (int i = 0; i < D; ++i) {
      at(result.T, cluster * D + i).set(lane, T[i]);
      at(result.S, cluster * D + i).set(lane, field.S[i]);
    }
    at(result.distances, cluster).set(lane, partner_.shape->distance(place));
  }
}

/// Adhesion that varies, and friction, have the difference of their forces.
template <int D>
void RigidContact<D>::add_tangent(const Motion& motion, const Motion& change, Forces force) {
  if (effects_.any()) return ForceTerm::add_tangent(motion, change, force);
  const std::span<const Index> visited = in_reach(motion);
  evaluate(motion, visited, now_);
  add_tangent_of_partner<D>(points_, *partner_.shape, form_,
                            {partner_.motion.displacement(motion.time), visited, now_.places,
                             now_.S, now_.distances, interaction_->least_gap()},
                            motion, change, force);
}

/// Adhesion that varies, and friction.
template <int D>
void RigidContact<D>::add_effects(const Motion& motion, std::span<const Index> visited,
                                  Evaluation& result) const {
  if (!effects_.any()) return;
  const Vec<D> shift = partner_.motion.displacement(motion.time), velocity = this->velocity(motion);
  points_.prepare_velocities(visited, motion, result.places);
  result.sums = parallel_sum(points_.clusters(), WallSums(), [&](Index c) {
    if (!near(result, c)) return WallSums();
    WallPoints<D> points = wall_points(c, motion, shift, velocity, result);
    return effects_.add(points, motion.time);
  });
}

template <int D>
WallPoints<D> RigidContact<D>::wall_points(Index cluster, const Motion& motion, const Vec<D>& shift,
                                           const Vec<D>& velocity, Evaluation& result) const {
  const Lanes *x = result.places.x_of(cluster), *weight = result.places.weight_of(cluster);
  Lanes v[D];
  points_.velocity(cluster, motion, result.places, v);
  WallPoints<D> points;
  points.T = &at(result.T, cluster * D);
  points.S = &at(result.S, cluster * D);
  points.distance = at(result.distances, cluster);
  for (int lane = 0; lane < Lanes::width; ++lane)
    for (int i = 0; i < D; ++i) {
      at(points.x, lane)[i] = x[i][lane] - shift[i];
      at(points.v, lane)[i] = v[i][lane] - velocity[i];
      at(points.V, lane)[i] = weight[i][lane];
    }
  return points;
}

/// Of the velocity along the partner, over the area that rubs; zero without any.
template <int D>
Vec<D> RigidContact<D>::mean_slip(const Motion& motion) const {
  Evaluation result(points_);
  evaluate(motion, all_, result);
  points_.prepare_velocities(all_, motion, result.places);
  const Vec<D> shift = partner_.motion.displacement(motion.time), velocity = this->velocity(motion);
  Real area = 0;
  Vec<D> sum = Vec<D>::Zero();
  for (const Index c : all_) {
    const auto [part, slip] = effects_.slip(wall_points(c, motion, shift, velocity, result));
    area += part;
    sum += slip;
  }
  return area > 0 ? Vec<D>(sum / area) : sum;
}

/// Friction by this velocity at the places of the last force, whose T are not needed any more.
template <int D>
void RigidContact<D>::add_viscous(const Motion& motion, Forces force) {
  const Vec<D> shift = partner_.motion.displacement(motion.time);
  std::fill(now_.T.begin(), now_.T.end(), Lanes::zero());
  points_.prepare_velocities(near_, motion, now_.places);
  parallel_for(static_cast<Index>(near_.size()), [&](Index k) {
    WallPoints<D> points = wall_points(at(near_, k), motion, shift, Vec<D>::Zero(), now_);
    effects_.rub(points);
  });
  points_.add_force(now_.places, near_, now_.T, {}, force);
}

/// Torque about the origin, -sum (x cross T + V cross S): turning the body turns x and V.
template <int D>
Eigen::Vector3d RigidContact<D>::net_torque(const Evaluation& result) const {
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();
  const auto vector = [](const Lanes* field, int lane) {
    Vec<D> x;
    for (int i = 0; i < D; ++i) x[i] = field[i][lane];
    return x;
  };
  for (const Index c : all_)
    for (int lane = 0; lane < points_.points_in(c); ++lane) {
      torque -= cross<D>(vector(result.places.x_of(c), lane), vector(&at(result.T, c * D), lane));
      if (form_ == ContactForm::energy)
        torque -=
            cross<D>(vector(result.places.weight_of(c), lane), vector(&at(result.S, c * D), lane));
    }
  return torque;
}

/// The power of the partner, and what the places and velocities of a force mean for the step.
template <int D>
Report RigidContact<D>::report(const Motion& motion) {
  Report report;
  Vec<D> velocity = Vec<D>::Zero();
  if (partner_.motion.moves()) {
    velocity = this->velocity(motion);
    report.external_power = net_force(now_).dot(velocity);
  }
  report.external_work = effects_.work(now_.sums);
  report.heat = now_.sums.heat;
  near_.clear();
  for (const Index c : all_)
    if (near(now_, c)) near_.push_back(c);
  // Distances of points beyond reach are those of when the list was made.
  if (near_.empty() && interaction_->ends()) take_all_distances(motion);
  const Index nearest = now_.nearest_point();
  const Real gap = now_.distance(nearest);
  if (!(gap < interaction_->range())) {
    report.demand =
        approach_demand(approach<D>(points_.body(), gap, velocity, motion), interaction_->range());
    return report;
  }
  if (gap < interaction_->least_gap())
    report.failure = Failure{
        points_.particle_at(nearest),
        fmt::format("surfaces overlap: the gap between '{}' and the rigid partner of contact '{}' "
                    "is {:.4g}, least is {:.4g}",
                    points_.body().name, name_, gap, interaction_->least_gap()),
        true};
  const Real speed = closing_speed<D>(points_, near_, nullptr, {}, velocity, motion);
  const Real strength = effects_.varies_at(gap) ? now_.sums.adhesion : 1;
  report.demand = contact_demand({*interaction_, strength / points_.inertia(), 0, D}, gap, speed);
  return report;
}

template <int D>
std::vector<MeasureSource> RigidContact<D>::measures() const {
  const auto looked_at = [this](auto&& number) {
    return [this, number](const Motion& motion) { return Real(number(evaluated(motion))); };
  };
  std::vector<MeasureSource> all{
      {"energy", dimension::energy, "energy of the interaction",
       [this](const Motion& motion) { return *stored_energy(motion); }},
      {"gap", dimension::length, "least distance of the points of the body from the partner",
       looked_at([](const Evaluation& result) { return result.gap(); })},
      {"gap_per_spacing", dimension::none, "the same / distance of neighbouring points",
       looked_at([this](const Evaluation& result) { return result.gap() / points_.spacing(); })}};
  for (int i = 0; i < D; ++i)
    all.push_back(
        {std::string("force_") + "xyz"[i], dimension::force, "force on the body",
         looked_at([this, i](const Evaluation& result) { return net_force(result)[i]; })});
  for (int i = D == 3 ? 0 : 2; i < 3; ++i)
    all.push_back(
        {std::string("torque_") + "xyz"[i], dimension::energy,
         "torque on the body about the origin",
         looked_at([this, i](const Evaluation& result) { return net_torque(result)[i]; })});
  if (wets_) {
    for (int i = 0; i < D; ++i)
      all.push_back(
          {std::string("reaction_") + "xyz"[i], dimension::force, "force on the partner",
           looked_at([this, i](const Evaluation& result) { return -net_force(result)[i]; })});
    all.push_back({"wetted_area", D == 3 ? dimension::area : dimension::length,
                   "area in full contact that has the energy of the interaction (2D: length)",
                   [this](const Motion& motion) { return wetted_area(motion); }});
  }
  if (effects_.rubs())
    for (int i = 0; i < D; ++i)
      all.push_back({std::string("slip_") + "xyz"[i], dimension::velocity,
                     "mean velocity along the partner and relative to it, over the area that rubs",
                     [this, i](const Motion& motion) { return mean_slip(motion)[i]; }});
  if (partner_.motion.moves())
    for (int i = 0; i < D; ++i)
      all.push_back({std::string("displacement_") + "xyz"[i], dimension::length,
                     "prescribed displacement of the partner", [this, i](const Motion& motion) {
                       return partner_.motion.displacement(motion.time)[i];
                     }});
  return all;
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
