// SPDX-License-Identifier: BSD-3-Clause
// Contact of a deformable body with a rigid partner in closed form.
#include "meniscus/core/error.hpp"
#include "meniscus/physics/contact.hpp"
#include "meniscus/physics/contact_demand.hpp"
#include "meniscus/physics/contact_numbers.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

namespace meniscus {
namespace {

/// x cross y; in the plane the third component.
template <int D>
Eigen::Vector3d cross(const Vec<D>& x, const Vec<D>& y) {
  Eigen::Vector3d a = Eigen::Vector3d::Zero(), b = a;
  a.head<D>() = x;
  b.head<D>() = y;
  return a.cross(b);
}

template <int D>
class RigidContact final : public ForceTerm {
 public:
  RigidContact(const ContactBody<D>& body, MovingPartner<D> partner,
               std::shared_ptr<const Interaction> interaction, const ContactChoice& choice)
      : name_(choice.name),
        interaction_(std::move(interaction)),
        form_(choice.form),
        partner_(std::move(partner)),
        now_(std::make_unique<Configuration>(
            ContactPoints<D>::on_surface(body.body, body.beta, choice.density, choice.points))) {
    near_.reserve(now_->all.size());
    if (partner_.motion.moves()) steady_after_ = end_of_motion();
  }

  std::string name() const override { return "contact '" + name_ + "'"; }
  std::string_view energy_kind() const override { return "contact"; }

  void add_force(const Motion& motion, std::span<Lanes> force) override {
    Configuration& now = *now_;
    bring_up(motion);
    const std::span<const Lanes> S =
        form_ == ContactForm::energy ? std::span<const Lanes>(now.S) : std::span<const Lanes>();
    now.points.add_force(now.all, now.T, S, force);
    if (partner_.motion.moves()) {
      const Vec<D> v = partner_.motion.velocity(motion.time, partner_.velocity_step);
      power_ = net_force().dot(v);
    }
    note_closeness(motion);
  }

  std::optional<Real> stored_energy(const Motion& motion) const override {
    bring_up(motion);
    const Configuration& now = *now_;
    return parallel_sum(now.points.clusters(), 0.0, [&](Index c) {
      Lanes E = Lanes::zero();
      for (int i = 0; i < D; ++i) E += at(now.S, c * D + i) * now.points.weight(c)[i];
      return sum(E);
    });
  }
  Real external_power(const Motion&) const override { return power_; }
  Real steady_after() const override { return steady_after_; }

  std::optional<Failure> failure() const override { return failure_; }
  bool may_reject_steps() const override { return true; }
  StepDemand step_demand() const override { return demand_; }

  std::optional<std::string> warning(const Motion& motion) const override {
    bring_up(motion);
    return unresolved_gap(name_, gap(), now_->points.spacing(), interaction_->range());
  }

  std::vector<MeasureSource> measures() const override;

  std::size_t bytes() const override {
    return now_->points.bytes() + (now_->T.size() + now_->S.size()) * sizeof(Lanes);
  }
  Offset pairs() const override { return now_->points.pairs() + now_->points.size(); }

 private:
  /// The motion looked at last: what the points feel, [cluster][i] as in contact_forms.hpp.
  struct Configuration {
    ContactPoints<D> points;
    std::vector<Index> all;  // clusters
    AlignedVector<Lanes> T, S;
    AlignedVector<Lanes> distance;  // [cluster] from the surface of the partner

    explicit Configuration(ContactPoints<D> p) : points(std::move(p)) {
      for (Index c = 0; c < points.clusters(); ++c) all.push_back(c);
      T.assign(static_cast<std::size_t>(points.clusters()) * D, Lanes::zero());
      S = T;
      distance.assign(all.size(), Lanes::zero());
    }
  };

  Real end_of_motion() const;
  void bring_up(const Motion& motion) const;
  void feel(Index cluster, const Vec<D>& shift) const;
  void note_closeness(const Motion& motion);

  Index nearest_point() const {
    Index nearest = 0;
    for (Index q = 0; q < now_->points.size(); ++q)
      if (distance(q) < distance(nearest)) nearest = q;
    return nearest;
  }
  Real distance(Index q) const { return at(now_->distance, q / Lanes::width)[q % Lanes::width]; }
  Real gap() const { return distance(nearest_point()); }
  Vec<D> net_force() const {
    Vec<D> force = Vec<D>::Zero();
    for (const Index c : now_->all)
      for (int i = 0; i < D; ++i) force[i] -= sum(at(now_->T, c * D + i));
    return force;
  }
  Eigen::Vector3d net_torque() const;

  std::string name_;
  std::shared_ptr<const Interaction> interaction_;
  ContactForm form_;
  MovingPartner<D> partner_;
  std::unique_ptr<Configuration> now_;
  std::vector<Index> near_;  // clusters that the step demand looks at
  Real power_ = 0, steady_after_ = 0;
  std::optional<Failure> failure_;
  StepDemand demand_;
};

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

template <int D>
void RigidContact<D>::bring_up(const Motion& motion) const {
  Configuration& now = *now_;
  now.points.move(motion);
  now.points.weigh(now.all, motion);
  const Vec<D> shift = partner_.motion.displacement(motion.time);
  parallel_for(
      now.points.clusters(), [&](Index c) { feel(c, shift); }, 16);
}

/// T and S of the four points of a cluster: T = grad S V, with S forming the energy S.V, or T = U V
/// for the pressure form. The dissertation's traction Sigma n = -beta1 grad S n is T without S.
template <int D>
void RigidContact<D>::feel(Index cluster, const Vec<D>& shift) const {
  Configuration& now = *now_;
  const Lanes *x = now.points.x(cluster), *weight = now.points.weight(cluster);
  for (int lane = 0; lane < Lanes::width; ++lane) {
    Vec<D> place, V;
    for (int i = 0; i < D; ++i) {
      place[i] = x[i][lane] - shift[i];
      V[i] = weight[i][lane];
    }
    const RigidField<D> field = partner_.shape->field(place);
    const Vec<D> T = form_ == ContactForm::pressure ? Vec<D>(field.U * V) : field.grad_S * V;
    for (int i = 0; i < D; ++i) {
      at(now.T, cluster * D + i).set(lane, T[i]);
      at(now.S, cluster * D + i).set(lane, field.S[i]);
    }
    at(now.distance, cluster).set(lane, partner_.shape->distance(place));
  }
}

/// Torque about the origin, -sum (x cross T + V cross S): turning the body turns x and V.
template <int D>
Eigen::Vector3d RigidContact<D>::net_torque() const {
  const Configuration& now = *now_;
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();
  const auto vector = [](const Lanes* field, int lane) {
    Vec<D> x;
    for (int i = 0; i < D; ++i) x[i] = field[i][lane];
    return x;
  };
  for (const Index c : now.all)
    for (int lane = 0; lane < now.points.points_in(c); ++lane) {
      const auto first = static_cast<std::size_t>(c) * D;
      torque -= cross<D>(vector(now.points.x(c), lane), vector(&at(now.T, first), lane));
      if (form_ == ContactForm::energy)
        torque -= cross<D>(vector(now.points.weight(c), lane), vector(&at(now.S, first), lane));
    }
  return torque;
}

/// What the places and velocities of the last add_force() mean for the step.
template <int D>
void RigidContact<D>::note_closeness(const Motion& motion) {
  failure_.reset();
  demand_ = {};
  const Index nearest = nearest_point();
  const Real gap = distance(nearest);
  if (!(gap < interaction_->range())) return;
  if (gap < interaction_->least_gap())
    failure_ = Failure{
        now_->points.particle_at(nearest),
        fmt::format("surfaces overlap: the gap between '{}' and the rigid partner of contact '{}' "
                    "is {:.4g}, least is {:.4g}",
                    now_->points.body().name, name_, gap, interaction_->least_gap()),
        true};
  near_.clear();
  for (const Index c : now_->all) {
    const Lanes& d = at(now_->distance, c);
    if (std::min(std::min(d[0], d[1]), std::min(d[2], d[3])) < interaction_->range())
      near_.push_back(c);
  }
  const Vec<D> velocity = partner_.motion.moves()
                              ? partner_.motion.velocity(motion.time, partner_.velocity_step)
                              : Vec<D>::Zero();
  const Real speed = closing_speed<D>(now_->points, near_, nullptr, {}, velocity, motion);
  demand_ = contact_demand({*interaction_, 1 / now_->points.inertia(), 0, D}, gap, speed);
}

template <int D>
std::vector<MeasureSource> RigidContact<D>::measures() const {
  const auto looked_at = [this](auto&& number) {
    return [this, number](const Motion& motion) {
      bring_up(motion);
      return Real(number());
    };
  };
  std::vector<MeasureSource> all{
      {"energy", dimension::energy, "energy of the interaction",
       [this](const Motion& motion) { return *stored_energy(motion); }},
      {"gap", dimension::length, "least distance of the points of the body from the partner",
       looked_at([this] { return gap(); })},
      {"gap_per_spacing", dimension::none, "the same / distance of neighbouring points",
       looked_at([this] { return gap() / now_->points.spacing(); })}};
  for (int i = 0; i < D; ++i)
    all.push_back({std::string("force_") + "xyz"[i], dimension::force, "force on the body",
                   looked_at([this, i] { return net_force()[i]; })});
  for (int i = D == 3 ? 0 : 2; i < 3; ++i)
    all.push_back({std::string("torque_") + "xyz"[i], dimension::energy,
                   "torque on the body about the origin",
                   looked_at([this, i] { return net_torque()[i]; })});
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
