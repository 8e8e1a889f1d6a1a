// SPDX-License-Identifier: BSD-3-Clause
// Contact of two deformable bodies by a law of the gap between their surfaces.
#include "meniscus/core/error.hpp"
#include "meniscus/physics/contact.hpp"
#include "meniscus/physics/contact_demand.hpp"
#include "meniscus/physics/contact_facets.hpp"
#include "meniscus/physics/contact_list.hpp"
#include "meniscus/physics/contact_visits.hpp"

#include <fmt/core.h>

#include "adhesion_work.hpp"

namespace meniscus {
namespace {

/// With the distance d of a surface point from the nearest point of the other surface and its area
/// A, both in the present state (CGCM note 11),
///   E = 1/2 sum over the points of the first A e(d) + 1/2 sum over those of the second A e(d):
/// for flat surfaces e per area, for equal treatment of both one half each. Forces are the
/// gradient of E: a point is pushed along the normal of the distance, what it was pushed from is
/// pushed back, so that force and torque are balanced. e is brought to zero smoothly over the last
/// quarter of its range. Sides that face away from each other are told apart by distance alone:
/// bodies are thicker than the range. An adhesion that varies is the same everywhere, W(t).
///
/// Above a ground, E = sum over the points of the first -up.V e(g), V their area vectors and g the
/// gap along `up`, of the law as it is: what a drop gains on a wall (wetting note 10). The ground
/// is pulled along its normal, and what it gains counts no area of its own. There the adhesion may
/// be W(X, t), X the place in the reference of the ground below a point: E has W e(g), and what
/// slides over the ground is pulled to more of it.
template <int D>
class GapPair final : public ForceTerm, public ContactVisits {
 public:
  GapPair(const Body<D>& first, const Body<D>& second, std::shared_ptr<const Interaction> law,
          const ContactChoice& choice)
      : name_(choice.name),
        law_(std::move(law)),
        pattern_(law_->pattern()),
        range_(law_->range()),
        rest_(law_->flat().equilibrium_gap),
        up_(direction(choice.up)),
        fold_(choice.fold),
        wets_(choice.wets),
        first_(first, second, range_, choice, 0),
        second_(second, first, range_, choice, 1),
        now_first_(first_, pattern_),
        now_second_(second_, pattern_) {
    if (up_) ground_ = first_.facets.facing(*up_);
    if (placed()) require_adhesion();
  }

  std::string name() const override { return "contact '" + name_ + "'"; }
  std::string_view energy_kind() const override { return "contact"; }

  Report add_force(const Motion& motion, Forces force) override {
    work_.begin(motion.time);
    Offset visited = 0;
    for (auto [side, result] :
         {std::pair{&first_, &now_first_}, std::pair{&second_, &now_second_}}) {
      if (side == &second_ && up_) break;
      side->move(motion, *result);
      side->list.update(result->places.x, result->others.samples);
      visited += side->list.pairs() * Lanes::width;
      evaluate(*side, side->list, motion, *result);
      side->points.add_force(result->places, side->list.of_first().active, result->T, result->S,
                             force);
      side->facets.add_force(result->pull, force);
    }
    count(visited);
    return report(motion);
  }

  std::optional<Real> stored_energy(const Motion& motion) const override {
    return sum_of(motion, &Evaluation::energy);
  }
  Real steady_after() const override {
    return pattern_ && pattern_->depends_on_time() ? unbounded : 0;
  }
  /// The last force was that of this motion.
  void commit(const Motion& motion) override {
    if (pattern_) work_.commit(motion.time, supply(motion.time));
  }
  void archive(const Archive& a) override {
    if (pattern_) work_.archive(a, D);
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
    if (pattern_ && wets_)
      all.push_back(
          {"wetted_area", D == 3 ? dimension::area : dimension::length,
           "area in full contact that has the energy of the interaction (2D: length)",
           [this](const Motion& motion) { return -sum_of(motion, &Evaluation::unit_energy); }});
    for (int i = 0; i < D; ++i)
      all.push_back({std::string("force_") + "xyz"[i], dimension::force, "force on the first body",
                     [this, i](const Motion& motion) {
                       const Real on_second = evaluated(first_, motion).force_on_facets(i);
                       return (!up_ ? evaluated(second_, motion).force_on_facets(i) : 0) -
                              on_second;
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
    std::vector<Real> unit;    // [point] the same of unit adhesion, without core; where it varies
    std::vector<Real> W;       // [point] adhesion, where it varies from place to place
    AdhesionSupply supply;     // then
    std::vector<Vec<D>> pull;  // [corner] force
    std::vector<Index> near;   // clusters within the range: the list has more, as it was built
    Real gap = unbounded;
    Index nearest = 0;  // point

    Evaluation(const Side& side, const AdhesionPattern* pattern)
        : places(side.points.at_rest()),
          others(side.facets.at_rest()),
          T(places.x.size(), Lanes::zero()),
          S(T) {
      foot.resize(static_cast<std::size_t>(places.size));
      stored.resize(foot.size());
      if (pattern) unit.resize(foot.size());
      if (pattern && pattern->depends_on_place()) W.resize(foot.size());
      pull.resize(others.corner.size());
      near.reserve(static_cast<std::size_t>(side.points.clusters()));
    }
    std::size_t bytes() const {
      return places.bytes() + (others.samples.size() + T.size() + S.size()) * sizeof(Lanes) +
             others.radius.size() * sizeof(Real) + foot.size() * (sizeof(foot[0]) + sizeof(Real)) +
             (unit.size() + W.size()) * sizeof(Real) + 2 * pull.size() * sizeof(Vec<D>) +
             near.capacity() * sizeof(Index);
    }
    Real energy() const {
      return parallel_sum(places.size, 0.0, [&](Index q) { return at(stored, q); });
    }
    Real unit_energy() const {
      return parallel_sum(places.size, 0.0, [&](Index q) { return at(unit, q); });
    }
    Real force_on_facets(int i) const {
      Real sum = 0;
      for (const Vec<D>& p : pull) sum += p[i];
      return sum;
    }
  };

  static std::optional<Vec<D>> direction(const std::vector<Real>& up) {
    if (up.empty()) return std::nullopt;
    return Vec<D>::Map(up.data()).normalized();
  }

  struct Energy {
    Real value, slope;
    Real unit;  // value / adhesion, without the core
  };
  /// Per area, and its derivative: e Q with Q = 1 - t^3 (10 - 15 t + 6 t^2), t from 0 to 1 over the
  /// last quarter of the range.
  Energy energy_at(Real gap, Real adhesion) const {
    PlaneState plane = law_->at(std::max(gap, law_->least_gap()));
    const Real unit = gap < rest_ ? -1 : plane.energy;
    if (pattern_) plane = varied(plane, gap, adhesion);
    if (up_ && law_->ends()) return {plane.energy, -plane.pressure, unit};
    const Real t = std::max(0.0, 4 * gap / range_ - 3), s = 1 - t;
    const Real Q = 1 - t * t * t * (10 - t * (15 - 6 * t)), dQ = -30 * t * t * s * s * 4 / range_;
    return {plane.energy * Q, plane.energy * dQ - plane.pressure * Q, unit * Q};
  }
  /// From unit adhesion to W. Nearer than the equilibrium gap there is the core beside it, which
  /// does not vary.
  PlaneState varied(const PlaneState& plane, Real gap, Real W) const {
    if (gap < rest_) return {plane.energy - (W - 1), plane.pressure, plane.stiffness};
    return {W * plane.energy, W * plane.pressure, W * plane.stiffness};
  }
  bool placed() const { return pattern_ && pattern_->depends_on_place(); }
  void require_adhesion() const;
  /// Where it is the same everywhere.
  Real adhesion(Real time) const {
    return pattern_ && !placed() ? (*pattern_)(Eigen::Vector3d::Zero(), time) : 1;
  }
  /// The largest by the last force, at this time.
  Real largest_adhesion(Real time) const {
    return placed() ? *std::max_element(now_first_.W.begin(), now_first_.W.end()) : adhesion(time);
  }
  /// By the last force, at this time.
  AdhesionSupply supply(Real time) const {
    if (placed()) return now_first_.supply;
    return work_.supply(*pattern_, Eigen::Vector3d::Zero(), adhesion(time),
                        now_first_.unit_energy() + (!up_ ? now_second_.unit_energy() : 0), time);
  }

  void evaluate(const Side& side, const ContactList<D>& list, const Motion& motion,
                Evaluation& result) const;
  Evaluation evaluated(const Side& side, const Motion& motion) const {
    Evaluation result(side, pattern_);
    side.move(motion, result);
    ContactList<D> list(side.list.reach(), side.list.skin());
    list.update(result.places.x, result.others.samples);
    evaluate(side, list, motion, result);
    return result;
  }
  /// Over the surfaces that have energy.
  Real sum_of(const Motion& motion, Real (Evaluation::*number)() const) const {
    const Real of_first = (evaluated(first_, motion).*number)();
    return !up_ ? of_first + (evaluated(second_, motion).*number)() : of_first;
  }
  Real gap(const Motion& motion) const {
    const Real of_first = std::min(evaluated(first_, motion).gap, range_);
    return !up_ ? std::min(of_first, evaluated(second_, motion).gap) : of_first;
  }
  Real spacing() const {
    return !up_ ? std::max(first_.points.spacing(), second_.points.spacing())
                : first_.points.spacing();
  }
  Report report(const Motion& motion) const;

  std::string name_;
  std::shared_ptr<const Interaction> law_;
  const AdhesionPattern* pattern_;  // null: steady
  AdhesionWork work_;
  Real range_, rest_;         // gaps
  std::optional<Vec<D>> up_;  // from the second, which is ground then
  std::string fold_;          // what it means if it folds
  bool wets_;
  Side first_, second_;
  std::vector<Index> ground_;          // facets of the second that face up in the reference
  Evaluation now_first_, now_second_;  // work space of a force
};

/// Before a run, that W can be taken all over the ground.
template <int D>
void GapPair<D>::require_adhesion() const try {
  for (const Index facet : ground_)
    for (std::size_t k = 0; k < D; ++k) {
      typename ContactFacets<D>::Foot corner;
      corner.facet = facet;
      corner.share.fill(0);
      corner.share[k] = 1;
      (*pattern_)(spatial<D>(first_.facets.reference_place(corner)), 0);
    }
} catch (const SolveError& error) {
  throw InputError(error.what());
}

template <int D>
void GapPair<D>::evaluate(const Side& side, const ContactList<D>& list, const Motion& motion,
                          Evaluation& result) const {
  const auto& active = list.of_first().active;
  const Real even = adhesion(motion.time);
  side.points.update_weights(active, motion, result.places);
  std::fill(result.foot.begin(), result.foot.end(), typename ContactFacets<D>::Foot());
  std::fill(result.stored.begin(), result.stored.end(), 0.0);
  std::fill(result.unit.begin(), result.unit.end(), 0.0);
  std::fill(result.W.begin(), result.W.end(), 0.0);
  parallel_for(
      static_cast<Index>(active.size()),
      [&](Index k) {
        const Index c = at(active, k);
        for (int i = 0; i < D; ++i)
          at(result.T, c * D + i) = at(result.S, c * D + i) = Lanes::zero();
        for (int lane = 0; lane < side.points.points_in(c); ++lane) {
          const Index q = c * Lanes::width + lane;
          const Vec<D> place = result.places.place(q);
          const auto foot =
              up_ ? side.facets.below(result.others, place, *up_, list.of_first().of(c))
                  : side.facets.foot(result.others, place, list.of_first().of(c));
          if (!(foot.distance < range_)) continue;
          Real W = even;
          Vec<D> slope = Vec<D>::Zero();  // of W
          if (placed()) {
            const Eigen::Vector3d X = spatial<D>(side.facets.reference_place(foot));
            W = at(result.W, q) = (*pattern_)(X, motion.time);
            const Vec<D> in_reference = pattern_->gradient(X, motion.time).template head<D>();
            slope = side.facets.carried(result.others, foot, in_reference, *up_);
          }
          const Energy e = energy_at(foot.distance, W);
          Vec<D> V;
          for (int i = 0; i < D; ++i) V[i] = result.places.weight_of(c)[i][lane];
          const Real norm = V.norm(), area = up_ ? -up_->dot(V) : 0.5 * norm;
          for (int i = 0; i < D; ++i) {
            at(result.T, c * D + i)
                .set(lane, area * e.slope * foot.normal[i] + area * e.unit * slope[i]);
            at(result.S, c * D + i)
                .set(lane, up_ ? -e.value * (*up_)[i] : 0.5 * e.value / norm * V[i]);
          }
          at(result.foot, q) = foot;
          at(result.stored, q) = area * e.value;
          if (pattern_) at(result.unit, q) = area * e.unit;
        }
      },
      4);
  // One after the other: many points push the same corner.
  std::fill(result.pull.begin(), result.pull.end(), Vec<D>::Zero());
  result.gap = unbounded;
  result.supply = {};
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
      if (placed() && pattern_->depends_on_time())
        result.supply =
            result.supply + work_.supply(*pattern_, spatial<D>(side.facets.reference_place(foot)),
                                         at(result.W, q), at(result.unit, q), motion.time);
    }
}

/// What the places and velocities of a force mean for the step.
template <int D>
Report GapPair<D>::report(const Motion& motion) const {
  Report report;
  if (pattern_) report.external_work = work_.since_step(supply(motion.time));
  if (const Index facet = up_ ? first_.facets.turned_over(now_first_.others, *up_, ground_) : -1;
      facet >= 0)
    report.failure =
        Failure{first_.facets.particle_at(facet),
                fmt::format("the surface of '{}' folds over{}", second_.points.body().name, fold_)};
  const bool on_first = now_first_.gap <= now_second_.gap;
  const Real gap = std::min(now_first_.gap, now_second_.gap);
  if (!(gap < range_)) return report;
  if (gap < law_->least_gap() && !report.failure) {
    const Side& side = on_first ? first_ : second_;
    report.failure = Failure{
        side.points.particle_at(on_first ? now_first_.nearest : now_second_.nearest),
        fmt::format("surfaces overlap: the gap between '{}' and '{}' is {:.4g}, least is {:.4g}",
                    first_.points.body().name, second_.points.body().name, gap, law_->least_gap()),
        true};
  }
  const Real speed = closing_speed<D>(first_.points, now_first_.near, &second_.points,
                                      now_second_.near, Vec<D>::Zero(), motion);
  // The stiffness of the core does not vary.
  const Real strength = pattern_ && gap >= rest_ ? largest_adhesion(motion.time) : 1;
  const Real inverse_inertia = 1 / first_.points.inertia() + 1 / second_.points.inertia();
  report.demand = contact_demand({*law_, strength * inverse_inertia, 0, D}, gap, {speed});
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
