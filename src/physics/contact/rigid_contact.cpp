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
        partner_(std::move(partner)),
        points_(ContactPoints<D>::on_surface(body.body, body.beta, choice.density, choice.points)),
        all_(static_cast<std::size_t>(points_.clusters())),
        now_(points_) {
    std::iota(all_.begin(), all_.end(), Index{0});
    near_.reserve(all_.size());
    if (partner_.motion.moves()) steady_after_ = end_of_motion();
  }

  std::string name() const override { return "contact '" + name_ + "'"; }
  std::string_view energy_kind() const override { return "contact"; }

  Report add_force(const Motion& motion, Forces force) override {
    evaluate(motion, now_);
    const std::span<const Lanes> S =
        form_ == ContactForm::energy ? std::span<const Lanes>(now_.S) : std::span<const Lanes>();
    points_.add_force(now_.places, all_, now_.T, S, force);
    return report(motion);
  }

  std::optional<Real> stored_energy(const Motion& motion) const override {
    const Evaluation result = evaluated(motion);
    return parallel_sum(points_.clusters(), 0.0, [&](Index c) {
      Lanes E = Lanes::zero();
      for (int i = 0; i < D; ++i) E += at(result.S, c * D + i) * result.places.weight_of(c)[i];
      return sum(E);
    });
  }
  Real steady_after() const override { return steady_after_; }

  bool may_reject_steps() const override { return true; }
  bool stops_drift() const override { return true; }

  std::optional<std::string> warning(const Motion& motion) const override {
    return unresolved_gap(name_, evaluated(motion).gap(), points_.spacing(), interaction_->range());
  }

  std::vector<MeasureSource> measures() const override;

  std::size_t bytes() const override {
    return points_.bytes() + now_.places.bytes() + (now_.T.size() + now_.S.size()) * sizeof(Lanes);
  }
  Offset pairs() const override { return points_.pairs() + points_.size(); }

 private:
  /// Places of the points and their forces, [cluster][i] as in contact_forms.hpp.
  struct Evaluation {
    ContactPlaces<D> places;
    AlignedVector<Lanes> T, S;
    AlignedVector<Lanes> distances;  // [cluster] from the surface of the partner

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

  Real end_of_motion() const;
  void evaluate(const Motion& motion, Evaluation& result) const;
  void evaluate(Index cluster, const Vec<D>& shift, Evaluation& result) const;
  /// At any motion; takes memory.
  Evaluation evaluated(const Motion& motion) const {
    Evaluation result(points_);
    evaluate(motion, result);
    return result;
  }
  Report report(const Motion& motion);

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
  MovingPartner<D> partner_;
  ContactPoints<D> points_;
  std::vector<Index> all_;  // clusters
  Real steady_after_ = 0;
  // Work space of a force.
  Evaluation now_;
  std::vector<Index> near_;  // clusters that the step demand looks at
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
void RigidContact<D>::evaluate(const Motion& motion, Evaluation& result) const {
  points_.move(motion, result.places);
  points_.update_weights(all_, motion, result.places);
  const Vec<D> shift = partner_.motion.displacement(motion.time);
  parallel_for(
      points_.clusters(), [&](Index c) { evaluate(c, shift, result); }, 16);
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
    velocity = partner_.motion.velocity(motion.time, partner_.velocity_step);
    report.external_power = net_force(now_).dot(velocity);
  }
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
  near_.clear();
  for (const Index c : all_) {
    const Lanes& d = at(now_.distances, c);
    if (std::min(std::min(d[0], d[1]), std::min(d[2], d[3])) < interaction_->range())
      near_.push_back(c);
  }
  const Real speed = closing_speed<D>(points_, near_, nullptr, {}, velocity, motion);
  report.demand = contact_demand({*interaction_, 1 / points_.inertia(), 0, D}, gap, speed);
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
