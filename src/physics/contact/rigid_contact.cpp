// SPDX-License-Identifier: BSD-3-Clause
// Contact of a deformable body with a rigid partner in closed form.
#include "meniscus/core/dense.hpp"
#include "meniscus/core/divided.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/physics/contact.hpp"
#include "meniscus/physics/contact_demand.hpp"
#include "meniscus/physics/contact_numbers.hpp"
#include "meniscus/physics/contact_resolution.hpp"
#include "meniscus/physics/contact_visits.hpp"

#include <fmt/core.h>

#include <cmath>
#include <numeric>

#include "contact_tangent.hpp"
#include "facet_pairs.hpp"
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
class RigidContact final : public ForceTerm, public ContactVisits {
 public:
  RigidContact(const ContactBody<D>& body, MovingPartner<D> partner,
               std::shared_ptr<const Interaction> interaction, const ContactChoice& choice)
      : name_(choice.name),
        interaction_(std::move(interaction)),
        form_(choice.form),
        wets_(choice.wets),
        partner_(std::move(partner)),
        effects_(*interaction_, partner_, choice.friction),
        grades_(choice.points, *interaction_, facet_edges(body.body).least),
        points_(graded_contact_points(body.body, body.beta, choice, 0, grades_)),
        now_(points_),
        list_(interaction_->range()) {
    close_.reserve(static_cast<std::size_t>(finest().clusters()));
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
    visit(motion);
    count(points_visited());
    evaluate(motion, now_);
    add_effects(motion, now_);
    for (std::size_t g = 0; g < points_.size(); ++g) {
      Layer& layer = now_.layers[g];
      const std::span<const Lanes> S =
          form_ == ContactForm::energy ? std::span<const Lanes>(layer.S) : std::span<const Lanes>();
      points_[g].add_force(layer.places, layer.visited, layer.T, S, force);
    }
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
    return unresolved_gap(name_, gap(motion), finest().spacing(), interaction_->range());
  }

  std::vector<MeasureSource> measures() const override;

  std::size_t bytes() const override {
    std::size_t n = list_.bytes();
    for (const ContactPoints<D>& points : points_) n += points.bytes();
    for (const Layer& layer : now_.layers)
      n += layer.places.bytes() + (layer.T.size() + layer.S.size()) * sizeof(Lanes);
    return n;
  }
  Offset pairs() const override {
    Offset n = 0;
    for (const ContactPoints<D>& points : points_) n += points.pairs() + points.size();
    return n;
  }

 private:
  /// Places of the points of a grade and their forces, [cluster][i] as in contact_forms.hpp.
  struct Layer {
    std::vector<Index> visited;  // clusters that feel the partner: only they have forces
    std::vector<Index> near;     // of these, clusters within the range
    ContactPlaces<D> places;
    AlignedVector<Lanes> T, S;
    AlignedVector<Lanes> distances;  // [cluster] from the surface of the partner; others: beyond

    explicit Layer(const ContactPoints<D>& points) : places(points.at_rest()) {
      visited.resize(static_cast<std::size_t>(points.clusters()));
      std::iota(visited.begin(), visited.end(), Index{0});
      near.reserve(visited.size());
      T.assign(visited.size() * D, Lanes::zero());
      S = T;
      distances.assign(visited.size(), Lanes(unbounded));
    }
    Real distance(Index q) const { return at(distances, q / Lanes::width)[q % Lanes::width]; }
    Real nearest_of(Index cluster) const {
      const Lanes& d = at(distances, cluster);
      return std::min(std::min(d[0], d[1]), std::min(d[2], d[3]));
    }
    /// What other ranks are told of a cluster.
    struct AtCluster {
      Lanes T[D], S[D], distances;
    };
    AtCluster at_cluster(Index c) const {
      AtCluster found;
      for (int i = 0; i < D; ++i) {
        found.T[i] = at(T, c * D + i);
        found.S[i] = at(S, c * D + i);
      }
      found.distances = at(distances, c);
      return found;
    }
    void take(Index c, const AtCluster& found) {
      for (int i = 0; i < D; ++i) {
        at(T, c * D + i) = found.T[i];
        at(S, c * D + i) = found.S[i];
      }
      at(distances, c) = found.distances;
    }
  };
  /// Of all points: those of a facet are of one grade.
  struct Evaluation {
    std::vector<Layer> layers;  // by grade
    WallSums sums;

    explicit Evaluation(const std::vector<ContactPoints<D>>& points)
        : layers(points.begin(), points.end()) {}
  };
  /// A point of a grade.
  struct Nearest {
    Real distance = unbounded;
    std::size_t grade = 0;
    Index point = 0;
  };

  const ContactPoints<D>& finest() const { return points_.front(); }
  void require_adhesion(const AdhesionPattern& W) const;
  Real end_of_motion() const;
  /// Decides which clusters of which grades feel the partner.
  void visit(const Motion& motion) {
    if (interaction_->ends())
      visit_near(motion);
    else
      visit_by_grade(motion, now_);
  }
  Offset points_visited() const {
    Offset n = 0;
    for (const Layer& layer : now_.layers)
      n += static_cast<Offset>(layer.visited.size()) * Lanes::width;
    return n;
  }
  void visit_near(const Motion& motion);
  void visit_by_grade(const Motion& motion, Evaluation& result) const;
  void evaluate(const Motion& motion, Evaluation& result) const;
  void evaluate(const ContactPoints<D>& points, Index cluster, const Vec<D>& shift,
                Layer& layer) const;
  void take_distances(const ContactPoints<D>& points, const Vec<D>& shift, Layer& layer) const;
  void add_effects(const Motion& motion, Evaluation& result) const;
  WallPoints<D> wall_points(std::size_t grade, Index cluster, const Motion& motion,
                            const Vec<D>& shift, const Vec<D>& velocity, Evaluation& result) const;
  /// At any motion, without effects; takes memory.
  Evaluation without_effects(const Motion& motion) const {
    Evaluation result(points_);
    visit_by_grade(motion, result);
    evaluate(motion, result);
    return result;
  }
  Evaluation evaluated(const Motion& motion) const {
    Evaluation result = without_effects(motion);
    add_effects(motion, result);
    return result;
  }
  Nearest nearest_of(const Evaluation& result) const;
  /// Of all points of the finest grade.
  Real gap(const Motion& motion) const {
    Layer layer(finest());
    finest().move(motion, layer.places);
    take_distances(finest(), partner_.motion.displacement(motion.time), layer);
    Real least = unbounded;
    for (const Index c : layer.visited) least = std::min(least, layer.nearest_of(c));
    return least;
  }
  Real energy_of(const Evaluation& result) const {
    Real sum_of_layers = 0;
    for (const Layer& layer : result.layers)
      sum_of_layers += parallel_sum(static_cast<Index>(layer.visited.size()), 0.0, [&](Index k) {
        const Index c = at(layer.visited, k);
        Lanes E = Lanes::zero();
        for (int i = 0; i < D; ++i) E += at(layer.S, c * D + i) * layer.places.weight_of(c)[i];
        return sum(E);
      });
    return sum_of_layers;
  }
  Real wetted_area(const Motion& motion) const {
    const Evaluation uniform = without_effects(motion);
    const Real energy = effects_.pattern() ? unit_energy(uniform, motion.time) : energy_of(uniform);
    return std::max(0.0, -energy / effects_.adhesion());
  }
  Real unit_energy(const Evaluation& uniform, Real time) const;
  Vec<D> mean_slip(const Motion& motion) const;
  Vec<D> velocity(const Motion& motion) const {
    return partner_.motion.velocity(motion.time, partner_.velocity_step);
  }
  Report report(const Motion& motion);
  /// Clusters with points within a distance of the partner that is below the range.
  void find_close(const Layer& layer, Real within) {
    close_.clear();
    for (const Index c : layer.near)
      if (layer.nearest_of(c) < within) close_.push_back(c);
  }

  Vec<D> net_force(const Evaluation& result) const {
    Vec<D> force = Vec<D>::Zero();
    for (const Layer& layer : result.layers)
      for (const Index c : layer.visited)
        for (int i = 0; i < D; ++i) force[i] -= sum(at(layer.T, c * D + i));
    return force;
  }
  Eigen::Vector3d net_torque(const Evaluation& result) const;

  std::string name_;
  std::shared_ptr<const Interaction> interaction_;
  ContactForm form_;
  bool wets_;
  MovingPartner<D> partner_;
  WallEffects<D> effects_;
  FacetGrades grades_;
  std::vector<ContactPoints<D>> points_;  // by grade
  Real steady_after_ = 0;
  // Work space of a force.
  Evaluation now_;
  std::vector<Index> close_;  // clusters that decide how fast the gap closes
  ReachList<D> list_;
};

/// Before a run, that W can be taken wherever on the partner the body may touch it first.
template <int D>
void RigidContact<D>::require_adhesion(const AdhesionPattern& W) const try {
  for (Index q = 0; q < finest().size(); ++q) {
    const Vec<D> X = finest().reference_place(q);
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

/// Clusters that may feel the partner of an interaction that ends. They are kept in a list for as
/// long as no other point can have come within the range.
template <int D>
void RigidContact<D>::visit_near(const Motion& motion) {
  Layer& layer = now_.layers.front();
  const Vec<D> shift = partner_.motion.displacement(motion.time);
  if (list_.holds(finest(), motion, shift)) return;
  finest().move(motion, layer.places);
  take_distances(finest(), shift, layer);
  list_.begin(finest(), motion, shift);
  layer.visited.clear();
  for (Index c = 0; c < finest().clusters(); ++c)
    if (layer.nearest_of(c) < list_.distance()) layer.visited.push_back(c);
}

/// Each facet has the grade that it needs at the distance of its coarsest points: by the present
/// motion alone.
template <int D>
void RigidContact<D>::visit_by_grade(const Motion& motion, Evaluation& result) const {
  if (grades_.count() == 1) return;
  const ContactPoints<D>& coarsest = points_.back();
  Layer& layer = result.layers.back();
  coarsest.move(motion, layer.places);
  take_distances(coarsest, partner_.motion.displacement(motion.time), layer);
  for (Layer& each : result.layers) {
    each.visited.clear();
    if (&each != &layer) std::fill(each.distances.begin(), each.distances.end(), Lanes(unbounded));
  }
  // The coarsest points of a facet are a cluster.
  for (Index facet = 0; facet < coarsest.clusters(); ++facet) {
    const int grade = grades_.grade(layer.nearest_of(facet), edge_by_points(layer.places, facet));
    Layer& chosen = at(result.layers, grade);
    const Index clusters = at(points_, grade).clusters() / coarsest.clusters();
    for (Index c = facet * clusters; c < (facet + 1) * clusters; ++c) chosen.visited.push_back(c);
    if (&chosen != &layer) at(layer.distances, facet) = Lanes(unbounded);
  }
}

template <int D>
void RigidContact<D>::evaluate(const Motion& motion, Evaluation& result) const {
  const Vec<D> shift = partner_.motion.displacement(motion.time);
  for (std::size_t g = 0; g < points_.size(); ++g) {
    const ContactPoints<D>& points = points_[g];
    Layer& layer = result.layers[g];
    if (g == 0 || g + 1 < points_.size()) points.move(layer.visited, motion, layer.places);
    points.update_weights(layer.visited, motion, layer.places);
    divided_for(
        static_cast<Index>(layer.visited.size()),
        [&](Index k) { evaluate(points, at(layer.visited, k), shift, layer); },
        [&](Index k) { return layer.at_cluster(at(layer.visited, k)); },
        [&](Index k, const typename Layer::AtCluster& of_other) {
          layer.take(at(layer.visited, k), of_other);
        },
        16);
  }
}

template <int D>
void RigidContact<D>::take_distances(const ContactPoints<D>& points, const Vec<D>& shift,
                                     Layer& layer) const {
  parallel_for(
      points.clusters(),
      [&](Index c) {
        LanePlace<D> place;
        for (int i = 0; i < D; ++i) at(place, i) = layer.places.x_of(c)[i] - shift[i];
        at(layer.distances, c) = partner_.shape->distances(place);
      },
      16);
}

/// T and S of the four points of a cluster: T = grad S V, with S forming the energy S.V, or T = U V
/// for the pressure form. The dissertation's traction Sigma n = -beta1 grad S n is T without S.
template <int D>
void RigidContact<D>::evaluate(const ContactPoints<D>& points, Index cluster, const Vec<D>& shift,
                               Layer& layer) const {
  const Lanes* V = layer.places.weight_of(cluster);
  LanePlace<D> place;
  for (int i = 0; i < D; ++i) at(place, i) = layer.places.x_of(cluster)[i] - shift[i];
  const LaneField<D> field = partner_.shape->fields(place, points.points_in(cluster));
  for (int i = 0; i < D; ++i) {
    Lanes T = Lanes::zero();
    if (form_ == ContactForm::pressure)
      T = field.U * V[i];
    else
      for (int j = 0; j < D; ++j) T += at(at(field.grad_S, i), j) * V[j];
    at(layer.T, cluster * D + i) = T;
    at(layer.S, cluster * D + i) = at(field.S, i);
  }
  at(layer.distances, cluster) = field.distance;
}

template <int D>
Real RigidContact<D>::unit_energy(const Evaluation& uniform, Real time) const {
  const Vec<D> shift = partner_.motion.displacement(time);
  Real sum_of_layers = 0;
  for (std::size_t g = 0; g < points_.size(); ++g) {
    const Layer& layer = uniform.layers[g];
    sum_of_layers += parallel_sum(static_cast<Index>(layer.visited.size()), 0.0, [&](Index k) {
      const Index c = at(layer.visited, k);
      Real energy = 0;
      for (int lane = 0; lane < points_[g].points_in(c); ++lane) {
        Vec<D> V, S;
        for (int i = 0; i < D; ++i) {
          V[i] = layer.places.weight_of(c)[i][lane];
          S[i] = at(layer.S, c * D + i)[lane];
        }
        const Index q = c * Lanes::width + lane;
        energy += effects_.unit_energy(layer.places.place(q) - shift, layer.distance(q), V, S);
      }
      return energy;
    });
  }
  return sum_of_layers;
}

/// Adhesion that varies, and friction, have the difference of their forces.
template <int D>
void RigidContact<D>::add_tangent(const Motion& motion, const Motion& change, Forces force) {
  if (effects_.any()) return ForceTerm::add_tangent(motion, change, force);
  visit(motion);
  evaluate(motion, now_);
  for (std::size_t g = 0; g < points_.size(); ++g) {
    const Layer& layer = now_.layers[g];
    add_tangent_of_partner<D>(points_[g], *partner_.shape, form_,
                              {partner_.motion.displacement(motion.time), layer.visited,
                               layer.places, layer.S, layer.distances, interaction_->least_gap()},
                              motion, change, force);
  }
}

/// Adhesion that varies, and friction.
template <int D>
void RigidContact<D>::add_effects(const Motion& motion, Evaluation& result) const {
  if (!effects_.any()) return;
  const Vec<D> shift = partner_.motion.displacement(motion.time), velocity = this->velocity(motion);
  result.sums = {};
  for (std::size_t g = 0; g < points_.size(); ++g) {
    Layer& layer = result.layers[g];
    points_[g].prepare_velocities(layer.visited, motion, layer.places);
    result.sums = result.sums + parallel_sum(points_[g].clusters(), WallSums(), [&](Index c) {
                    if (!(layer.nearest_of(c) < interaction_->range())) return WallSums();
                    WallPoints<D> points = wall_points(g, c, motion, shift, velocity, result);
                    return effects_.add(points, motion.time);
                  });
  }
}

template <int D>
WallPoints<D> RigidContact<D>::wall_points(std::size_t grade, Index cluster, const Motion& motion,
                                           const Vec<D>& shift, const Vec<D>& velocity,
                                           Evaluation& result) const {
  Layer& layer = result.layers[grade];
  const Lanes *x = layer.places.x_of(cluster), *weight = layer.places.weight_of(cluster);
  Lanes v[D];
  points_[grade].velocity(cluster, motion, layer.places, v);
  WallPoints<D> points;
  points.T = &at(layer.T, cluster * D);
  points.S = &at(layer.S, cluster * D);
  points.distance = at(layer.distances, cluster);
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
  Evaluation result = without_effects(motion);
  const Vec<D> shift = partner_.motion.displacement(motion.time), velocity = this->velocity(motion);
  Real area = 0;
  Vec<D> sum = Vec<D>::Zero();
  for (std::size_t g = 0; g < points_.size(); ++g) {
    Layer& layer = result.layers[g];
    points_[g].prepare_velocities(layer.visited, motion, layer.places);
    for (const Index c : layer.visited) {
      const auto [part, slip] = effects_.slip(wall_points(g, c, motion, shift, velocity, result));
      area += part;
      sum += slip;
    }
  }
  return area > 0 ? Vec<D>(sum / area) : sum;
}

/// Friction by this velocity at the places of the last force, whose T are not needed any more.
template <int D>
void RigidContact<D>::add_viscous(const Motion& motion, Forces force) {
  const Vec<D> shift = partner_.motion.displacement(motion.time);
  for (std::size_t g = 0; g < points_.size(); ++g) {
    Layer& layer = now_.layers[g];
    std::fill(layer.T.begin(), layer.T.end(), Lanes::zero());
    points_[g].prepare_velocities(layer.near, motion, layer.places);
    parallel_for(static_cast<Index>(layer.near.size()), [&](Index k) {
      WallPoints<D> points = wall_points(g, at(layer.near, k), motion, shift, Vec<D>::Zero(), now_);
      effects_.rub(points);
    });
    points_[g].add_force(layer.places, layer.near, layer.T, {}, force);
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
  for (const Layer& layer : result.layers)
    for (const Index c : layer.visited)
      for (int lane = 0; lane < Lanes::width; ++lane) {
        torque -= cross<D>(vector(layer.places.x_of(c), lane), vector(&at(layer.T, c * D), lane));
        if (form_ == ContactForm::energy)
          torque -=
              cross<D>(vector(layer.places.weight_of(c), lane), vector(&at(layer.S, c * D), lane));
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
  bool any_near = false;
  for (Layer& layer : now_.layers) {
    layer.near.clear();
    for (const Index c : layer.visited)
      if (layer.nearest_of(c) < interaction_->range()) layer.near.push_back(c);
    any_near = any_near || !layer.near.empty();
  }
  // Distances of points beyond reach are those of when the list was made.
  if (!any_near && interaction_->ends()) {
    finest().move(motion, now_.layers.front().places);
    take_distances(finest(), partner_.motion.displacement(motion.time), now_.layers.front());
  }
  const auto [gap, grade, nearest] = nearest_of(now_);
  if (!(gap < interaction_->range())) {
    report.demand =
        approach_demand(approach<D>(finest(), gap, velocity, motion), interaction_->range());
    return report;
  }
  if (gap < interaction_->least_gap())
    report.failure = Failure{
        points_[grade].particle_at(nearest),
        fmt::format("surfaces overlap: the gap between '{}' and the rigid partner of contact '{}' "
                    "is {:.4g}, least is {:.4g}",
                    finest().body().name, name_, gap, interaction_->least_gap()),
        true};
  const Real within = std::min(close_by(gap), interaction_->range());
  Real speed = 0;
  for (std::size_t g = 0; g < points_.size(); ++g) {
    find_close(now_.layers[g], within);
    speed = std::max(speed, closing_speed<D>(points_[g], close_, nullptr, {}, velocity, motion));
  }
  const Real strength = effects_.varies_at(gap) ? now_.sums.adhesion : 1;
  report.demand =
      contact_demand({*interaction_, strength / finest().inertia(), 0, D}, gap,
                     {speed, within, approach<D>(finest(), gap, velocity, motion).speed});
  return report;
}

template <int D>
typename RigidContact<D>::Nearest RigidContact<D>::nearest_of(const Evaluation& result) const {
  Nearest nearest;
  for (std::size_t g = 0; g < points_.size(); ++g)
    for (Index q = 0; q < result.layers[g].places.size; ++q)
      if (const Real distance = result.layers[g].distance(q); distance < nearest.distance)
        nearest = {distance, g, q};
  return nearest;
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
       [this](const Motion& motion) { return gap(motion); }},
      {"gap_per_spacing", dimension::none, "the same / distance of neighbouring points",
       [this](const Motion& motion) { return gap(motion) / finest().spacing(); }}};
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
