// SPDX-License-Identifier: BSD-3-Clause
// Contact of two deformable bodies by a law of the gap between their surfaces.
#include "meniscus/core/error.hpp"
#include "meniscus/physics/contact.hpp"
#include "meniscus/physics/contact_demand.hpp"
#include "meniscus/physics/contact_facets.hpp"
#include "meniscus/physics/contact_list.hpp"

#include <fmt/core.h>

namespace meniscus {
namespace {

/// With the distance d of a surface point from the nearest point of the other surface and its area
/// A, both in the present state (CGCM note 11),
///   E = 1/2 sum over the points of the first A e(d) + 1/2 sum over those of the second A e(d):
/// for flat surfaces e per area, for equal treatment of both one half each. Forces are the gradient
/// of E: a point is pushed along the normal of the distance, what it was pushed from is pushed
/// back, so that force and torque are balanced. e is brought to zero smoothly over the last quarter
/// of its range. Sides that face away from each other are told apart by distance alone: bodies are
/// thicker than the range.
template <int D>
class GapPair final : public ForceTerm {
 public:
  GapPair(const Body<D>& first, const Body<D>& second, std::shared_ptr<const Interaction> law,
          const ContactChoice& choice)
      : name_(choice.name),
        law_(std::move(law)),
        range_(law_->range()),
        first_(first, second, range_, choice, 0),
        second_(second, first, range_, choice, 1),
        now_first_(first_),
        now_second_(second_) {}

  std::string name() const override { return "contact '" + name_ + "'"; }
  std::string_view energy_kind() const override { return "contact"; }

  Report add_force(const Motion& motion, Forces force) override {
    for (auto [side, result] :
         {std::pair{&first_, &now_first_}, std::pair{&second_, &now_second_}}) {
      side->move(motion, *result);
      side->list.update(result->places.x, result->others.samples);
      evaluate(*side, side->list, motion, *result);
      side->points.add_force(result->places, side->list.of_first().active, result->T, result->S,
                             force);
      side->facets.add_force(result->pull, force);
    }
    return report(motion);
  }

  std::optional<Real> stored_energy(const Motion& motion) const override {
    return evaluated(first_, motion).energy() + evaluated(second_, motion).energy();
  }
  bool may_reject_steps() const override { return true; }
  bool stops_drift() const override { return true; }
  std::optional<std::string> warning(const Motion& motion) const override {
    return unresolved_gap(name_, gap(motion), spacing(), range_);
  }

  std::vector<MeasureSource> measures() const override {
    std::vector<MeasureSource> all{
        {"energy", dimension::energy, "energy of the interaction",
         [this](const Motion& motion) { return *stored_energy(motion); }},
        {"gap", dimension::length, "least distance of the two surfaces; at most the range",
         [this](const Motion& motion) { return gap(motion); }},
        {"gap_per_spacing", dimension::none, "the same / distance of neighbouring points",
         [this](const Motion& motion) { return gap(motion) / spacing(); }}};
    for (int i = 0; i < D; ++i)
      all.push_back({std::string("force_") + "xyz"[i], dimension::force, "force on the first body",
                     [this, i](const Motion& motion) {
                       return evaluated(second_, motion).force_on_facets(i) -
                              evaluated(first_, motion).force_on_facets(i);
                     }});
    return all;
  }

  std::size_t bytes() const override {
    return first_.bytes() + second_.bytes() + now_first_.bytes() + now_second_.bytes();
  }
  Offset pairs() const override { return first_.pairs() + second_.pairs(); }

 private:
  struct Evaluation;

  /// The points of one body, and the facets of the other that act on them.
  struct Side {
    ContactPoints<D> points;
    ContactFacets<D> facets;
    ContactList<D> list;  // clusters of points, facets

    Side(const Body<D>& body, const Body<D>& other, Real range, const ContactChoice& choice,
         std::size_t side)
        : points(surface_contact_points(body, 1, choice, side)),
          facets(other),
          // No point of a facet that has not doubled its size is farther than that from its
          // samples.
          list(range + facets.longest_edge(), choice.skin * range / 4) {}
    void move(const Motion& motion, Evaluation& result) const {
      points.move(motion, result.places);
      facets.move(motion, result.others);
    }
    std::size_t bytes() const { return points.bytes() + facets.bytes() + list.bytes(); }
    Offset pairs() const { return points.pairs() + facets.pairs() + list.pairs(); }
  };

  /// Places, energies and forces of a side.
  struct Evaluation {
    ContactPlaces<D> places;
    typename ContactFacets<D>::Places others;
    AlignedVector<Lanes> T, S;                          // [cluster][i]: dE/dx, dE/dV
    std::vector<typename ContactFacets<D>::Foot> foot;  // [point]
    std::vector<Real> stored;                           // [point] energy
    std::vector<Vec<D>> pull;                           // [corner] force
    std::vector<Index> near;  // clusters within the range: the list has more, as it was built
    Real gap = unbounded;
    Index nearest = 0;  // point

    explicit Evaluation(const Side& side)
        : places(side.points.at_rest()),
          others(side.facets.at_rest()),
          T(places.x.size(), Lanes::zero()),
          S(T) {
      foot.resize(static_cast<std::size_t>(places.size));
      stored.resize(foot.size());
      pull.resize(others.corner.size());
      near.reserve(static_cast<std::size_t>(side.points.clusters()));
    }
    std::size_t bytes() const {
      return places.bytes() + (others.samples.size() + T.size() + S.size()) * sizeof(Lanes) +
             others.radius.size() * sizeof(Real) + foot.size() * (sizeof(foot[0]) + sizeof(Real)) +
             2 * pull.size() * sizeof(Vec<D>) + near.capacity() * sizeof(Index);
    }
    Real energy() const {
      return parallel_sum(places.size, 0.0, [&](Index q) { return at(stored, q); });
    }
    Real force_on_facets(int i) const {
      Real sum = 0;
      for (const Vec<D>& p : pull) sum += p[i];
      return sum;
    }
  };

  struct Energy {
    Real value, slope;
  };
  /// Per area, and its derivative: e Q with Q = 1 - t^3 (10 - 15 t + 6 t^2), t from 0 to 1 over the
  /// last quarter of the range.
  Energy energy_at(Real gap) const {
    const PlaneState plane = law_->at(std::max(gap, law_->least_gap()));
    const Real t = std::max(0.0, 4 * gap / range_ - 3), s = 1 - t;
    const Real Q = 1 - t * t * t * (10 - t * (15 - 6 * t)), dQ = -30 * t * t * s * s * 4 / range_;
    return {plane.energy * Q, plane.energy * dQ - plane.pressure * Q};
  }

  void evaluate(const Side& side, const ContactList<D>& list, const Motion& motion,
                Evaluation& result) const;
  Evaluation evaluated(const Side& side, const Motion& motion) const {
    Evaluation result(side);
    side.move(motion, result);
    ContactList<D> list(side.list.reach(), side.list.skin());
    list.update(result.places.x, result.others.samples);
    evaluate(side, list, motion, result);
    return result;
  }
  Real gap(const Motion& motion) const {
    return std::min({evaluated(first_, motion).gap, evaluated(second_, motion).gap, range_});
  }
  Real spacing() const { return std::max(first_.points.spacing(), second_.points.spacing()); }
  Report report(const Motion& motion) const;

  std::string name_;
  std::shared_ptr<const Interaction> law_;
  Real range_;
  Side first_, second_;
  Evaluation now_first_, now_second_;  // work space of a force
};

template <int D>
void GapPair<D>::evaluate(const Side& side, const ContactList<D>& list, const Motion& motion,
                          Evaluation& result) const {
  const auto& active = list.of_first().active;
  side.points.update_weights(active, motion, result.places);
  std::fill(result.foot.begin(), result.foot.end(), typename ContactFacets<D>::Foot());
  std::fill(result.stored.begin(), result.stored.end(), 0.0);
  parallel_for(
      static_cast<Index>(active.size()),
      [&](Index k) {
        const Index c = at(active, k);
        for (int i = 0; i < D; ++i)
          at(result.T, c * D + i) = at(result.S, c * D + i) = Lanes::zero();
        for (int lane = 0; lane < side.points.points_in(c); ++lane) {
          const Index q = c * Lanes::width + lane;
          const auto foot =
              side.facets.foot(result.others, result.places.place(q), list.of_first().of(c));
          if (!(foot.distance < range_)) continue;
          const Energy e = energy_at(foot.distance);
          Vec<D> V;
          for (int i = 0; i < D; ++i) V[i] = result.places.weight_of(c)[i][lane];
          const Real area = V.norm();
          for (int i = 0; i < D; ++i) {
            at(result.T, c * D + i).set(lane, 0.5 * area * e.slope * foot.normal[i]);
            at(result.S, c * D + i).set(lane, 0.5 * e.value / area * V[i]);
          }
          at(result.foot, q) = foot;
          at(result.stored, q) = 0.5 * area * e.value;
        }
      },
      4);
  // One after the other: many points push the same corner.
  std::fill(result.pull.begin(), result.pull.end(), Vec<D>::Zero());
  result.gap = unbounded;
  result.near.clear();
  for (const Index c : active)
    for (int lane = 0; lane < side.points.points_in(c); ++lane) {
      const Index q = c * Lanes::width + lane;
      const auto& foot = at(result.foot, q);
      if (foot.facet < 0) continue;
      if (result.near.empty() || result.near.back() != c) result.near.push_back(c);
      if (foot.distance < result.gap) {
        result.gap = foot.distance;
        result.nearest = q;
      }
      Vec<D> T;
      for (int i = 0; i < D; ++i) T[i] = at(result.T, c * D + i)[lane];
      for (std::size_t k = 0; k < D; ++k)
        at(result.pull, side.facets.corners_of(foot.facet)[k]) += foot.share[k] * T;
    }
}

/// What the places and velocities of a force mean for the step.
template <int D>
Report GapPair<D>::report(const Motion& motion) const {
  Report report;
  const bool on_first = now_first_.gap <= now_second_.gap;
  const Real gap = std::min(now_first_.gap, now_second_.gap);
  if (!(gap < range_)) return report;
  if (gap < law_->least_gap()) {
    const Side& side = on_first ? first_ : second_;
    report.failure = Failure{
        side.points.particle_at(on_first ? now_first_.nearest : now_second_.nearest),
        fmt::format("surfaces overlap: the gap between '{}' and '{}' is {:.4g}, least is {:.4g}",
                    first_.points.body().name, second_.points.body().name, gap, law_->least_gap()),
        true};
  }
  const Real speed = closing_speed<D>(first_.points, now_first_.near, &second_.points,
                                      now_second_.near, Vec<D>::Zero(), motion);
  report.demand = contact_demand(
      {*law_, 1 / first_.points.inertia() + 1 / second_.points.inertia(), 0, D}, gap, speed);
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
