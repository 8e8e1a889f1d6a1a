// SPDX-License-Identifier: BSD-3-Clause
// Contact of two deformable bodies: their points, the list of pairs, the limits of steps and
// measures.
#include "meniscus/core/error.hpp"
#include "meniscus/physics/contact.hpp"
#include "meniscus/physics/contact_demand.hpp"
#include "meniscus/physics/contact_list.hpp"
#include "meniscus/physics/contact_numbers.hpp"
#include "meniscus/physics/contact_resolution.hpp"
#include "meniscus/physics/contact_visits.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "facet_pairs.hpp"
#include "moved_since.hpp"
#include "pair_sums.hpp"

namespace meniscus {
namespace {

/// The contact points of a body by grade: all of a facet first, then fewer and fewer.
template <int D>
using Graded = std::vector<ContactPoints<D>>;

template <int D>
FacetGrades grades_of(const ContactBody<D>& first, const ContactBody<D>& second,
                      const Interaction& interaction, const ContactChoice& choice) {
  const Real edge = std::min(facet_edges(first.body).least, facet_edges(second.body).least);
  // Points of the volume have no facets.
  return FacetGrades::of_pairs(choice.form == ContactForm::volume ? 1 : choice.points, interaction,
                               edge);
}

template <int D>
Graded<D> points_of(const ContactBody<D>& b, const ContactChoice& choice, std::size_t side,
                    const FacetGrades& grades) {
  Graded<D> all;
  if (choice.form == ContactForm::volume) {
    all.push_back(ContactPoints<D>::in_volume(b.body, b.beta, choice.points));
    return all;
  }
  return graded_contact_points(b.body, b.beta, choice, side, grades);
}

/// Nothing where facets have one grade.
template <int D>
Real overhang(const ContactBody<D>& first, const ContactBody<D>& second,
              const FacetGrades& grades) {
  if (grades.count() == 1) return 0;
  return FacetPairs<D>::overhang(
      std::max(facet_edges(first.body).largest, facet_edges(second.body).largest));
}

template <int D>
class PairContact final : public ForceTerm, public ContactVisits {
 public:
  PairContact(const ContactBody<D>& first, const ContactBody<D>& second, const ContactLaw& law,
              const ContactChoice& choice)
      : name_(choice.name),
        law_(law),
        sums_(pair_sums<D>(law, choice.form)),
        interaction_(law, first.beta * second.beta),
        grades_(grades_of(first, second, interaction_, choice)),
        first_(points_of(first, choice, 0, grades_)),
        second_(points_of(second, choice, 1, grades_)),
        list_(law.reach() + overhang(first, second, grades_), choice.skin * law.sigma0),
        now_(*this) {
    for (std::size_t g = 0; g < first_.size(); ++g) {
      first_result_.emplace_back(first_[g].clusters(), sums_->moment());
      second_result_.emplace_back(second_[g].clusters(), sums_->moment());
    }
    close_.first.reserve(static_cast<std::size_t>(first_.front().clusters()));
    close_.second.reserve(static_cast<std::size_t>(second_.front().clusters()));
  }

  std::string name() const override { return "contact '" + name_ + "'"; }
  std::string_view energy_kind() const override { return "contact"; }

  Report add_force(const Motion& motion, Forces force) override {
    visit(motion);
    count(point_pairs());
    for (std::size_t g = 0; g < first_.size(); ++g) {
      const FacetRows<D> first = of_first(now_, list_, g), second = of_second(now_, list_, g);
      sums_->evaluate(now_.first[g], first, now_.second[g], first_result_[g]);
      sums_->evaluate(now_.second[g], second, now_.first[g], second_result_[g]);
      first_[g].add_force(now_.first[g], first.clusters, first_result_[g].T, first_result_[g].S,
                          force);
      second_[g].add_force(now_.second[g], second.clusters, second_result_[g].T,
                           second_result_[g].S, force);
    }
    return report(motion);
  }

  void add_tangent(const Motion& motion, const Motion& change, Forces force) override {
    visit(motion);
    for (std::size_t g = 0; g < first_.size(); ++g) {
      const FacetRows<D> of_first = this->of_first(now_, list_, g),
                         of_second = this->of_second(now_, list_, g);
      const ContactChanges<D> first = first_[g].changes(of_first.clusters, now_.first[g], motion,
                                                        change),
                              second = second_[g].changes(of_second.clusters, now_.second[g],
                                                          motion, change);
      add_change({first_[g], of_first, now_.first[g], first}, now_.second[g], second, motion,
                 change, force);
      add_change({second_[g], of_second, now_.second[g], second}, now_.first[g], first, motion,
                 change, force);
    }
  }

  std::optional<Real> stored_energy(const Motion& motion) const override {
    return look_at(motion, [&](const Visited& at_motion, const ContactList<D>& list) {
      Real energy = 0;
      for (std::size_t g = 0; g < first_.size(); ++g)
        energy += sums_->energy(at_motion.first[g], first_[g].clusters(),
                                of_first(at_motion, list, g), at_motion.second[g]);
      return energy;
    });
  }

  /// The forces of the others are not the gradient of their energy.
  std::optional<Real> potential(const Motion& motion) override {
    if (!sums_->conservative()) return std::nullopt;
    return stored_energy(motion);
  }

  bool may_reject_steps() const override { return true; }
  bool stops_drift() const override { return true; }

  std::optional<std::string> warning(const Motion& motion) const override {
    return look_at(motion, [&](const Visited& at_motion, const ContactList<D>& list) {
      return unresolved_gap(name_, nearest_of(evaluated(at_motion, list)).distance, spacing(),
                            interaction_.range());
    });
  }

  std::vector<MeasureSource> measures() const override;

  std::size_t bytes() const override {
    std::size_t n = list_.bytes() + first_since_.bytes() + second_since_.bytes() + now_.bytes();
    for (std::size_t g = 0; g < first_.size(); ++g)
      n += first_[g].bytes() + second_[g].bytes() + first_result_[g].bytes() +
           second_result_[g].bytes();
    return n;
  }
  Offset pairs() const override {
    Offset n = point_pairs();
    for (std::size_t g = 0; g < first_.size(); ++g) n += first_[g].pairs() + second_[g].pairs();
    return n;
  }

 private:
  /// The points of both bodies at a motion, by grade, as far as they may be within reach of the
  /// other body, and which act on which.
  struct Visited {
    std::vector<ContactPlaces<D>> first, second;
    FacetPairs<D> facets;

    explicit Visited(const PairContact& term)
        : facets(term.grades_, clusters_per_facet(term.first_), term.law_.reach()) {
      for (const ContactPoints<D>& points : term.first_) first.push_back(points.at_rest());
      for (const ContactPoints<D>& points : term.second_) second.push_back(points.at_rest());
    }
    std::size_t bytes() const {
      std::size_t n = facets.bytes();
      for (const auto* side : {&first, &second})
        for (const ContactPlaces<D>& places : *side) n += places.bytes();
      return n;
    }
  };
  /// Of the points of the first.
  struct Nearest {
    Real distance = unbounded;
    std::size_t grade = 0;
    Index cluster = 0;
  };

  static std::vector<Index> clusters_per_facet(const Graded<D>& points) {
    std::vector<Index> all;
    for (const ContactPoints<D>& grade : points)
      all.push_back(grade.clusters() / points.back().clusters());
    return all;
  }
  static FacetRows<D> all_of(const typename ContactList<D>::Rows& rows) {
    return {&rows, 1, rows.active};
  }
  FacetRows<D> of_first(const Visited& at_motion, const ContactList<D>& list,
                        std::size_t grade) const {
    return first_.size() == 1 ? all_of(list.of_first()) : at_motion.facets.of_first(grade);
  }
  FacetRows<D> of_second(const Visited& at_motion, const ContactList<D>& list,
                         std::size_t grade) const {
    return first_.size() == 1 ? all_of(list.of_second()) : at_motion.facets.of_second(grade);
  }
  /// Of points, from both sides.
  Offset point_pairs() const {
    Offset n = 0;
    for (std::size_t g = 0; g < first_.size(); ++g)
      n += pairs_of(of_first(now_, list_, g)) + pairs_of(of_second(now_, list_, g));
    return n;
  }
  static Offset pairs_of(const FacetRows<D>& rows) {
    const Offset clusters = rows.clusters_per_facet * rows.clusters_per_facet;
    return static_cast<Offset>(rows.facets->partner.size()) * clusters * Lanes::width *
           Lanes::width;
  }

  /// Whether the list has all pairs within reach at this motion.
  bool holds(const Motion& motion) const {
    return first_since_.farthest(first_.back(), motion) +
               second_since_.farthest(second_.back(), motion) <=
           list_.skin() * (1 - 1e-12);
  }
  /// Brings to this motion the points that may be within reach of the other body: all others are
  /// left where they were. The coarsest points tell which.
  void visit(const Motion& motion) {
    if (holds(motion)) {
      first_.back().move(list_.of_first().active, motion, now_.first.back());
      second_.back().move(list_.of_second().active, motion, now_.second.back());
    } else {
      make_list(motion, list_, now_);
      first_since_.begin(first_.back(), motion);
      second_since_.begin(second_.back(), motion);
    }
    bring_others(motion, list_, now_);
  }
  void make_list(const Motion& motion, ContactList<D>& list, Visited& at_motion) const {
    first_.back().move(motion, at_motion.first.back());
    second_.back().move(motion, at_motion.second.back());
    list.build(at_motion.first.back().x, at_motion.second.back().x);
  }
  /// Weights of the coarsest points of the list, which have been moved, and all of the others.
  void bring_others(const Motion& motion, const ContactList<D>& list, Visited& at_motion) const {
    if (first_.size() > 1)
      at_motion.facets.choose(list, at_motion.first.back(), at_motion.second.back());
    for (std::size_t g = 0; g < first_.size(); ++g) {
      const auto first = of_first(at_motion, list, g).clusters,
                 second = of_second(at_motion, list, g).clusters;
      if (g + 1 < first_.size()) {
        first_[g].move(first, motion, at_motion.first[g]);
        second_[g].move(second, motion, at_motion.second[g]);
      }
      first_[g].update_weights(first, motion, at_motion.first[g]);
      second_[g].update_weights(second, motion, at_motion.second[g]);
    }
  }

  /// f(visited, list) at any motion; takes memory. The list of the forces serves where it holds.
  template <class F>
  auto look_at(const Motion& motion, F&& f) const {
    Visited at_motion(*this);
    std::optional<ContactList<D>> own;
    if (holds(motion)) {
      first_.back().move(list_.of_first().active, motion, at_motion.first.back());
      second_.back().move(list_.of_second().active, motion, at_motion.second.back());
    } else {
      make_list(motion, own.emplace(list_.reach(), list_.skin()), at_motion);
    }
    const ContactList<D>& list = own ? *own : list_;
    bring_others(motion, list, at_motion);
    return f(at_motion, list);
  }
  /// On the first, by grade.
  std::vector<PairEvaluation<D>> evaluated(const Visited& at_motion,
                                           const ContactList<D>& list) const {
    std::vector<PairEvaluation<D>> results;
    for (std::size_t g = 0; g < first_.size(); ++g) {
      results.emplace_back(first_[g].clusters(), sums_->moment());
      sums_->evaluate(at_motion.first[g], of_first(at_motion, list, g), at_motion.second[g],
                      results.back());
    }
    return results;
  }
  /// `cluster` counts among those with partners.
  static Nearest nearest_of(const std::vector<PairEvaluation<D>>& results) {
    Nearest least;
    for (std::size_t g = 0; g < results.size(); ++g)
      for (std::size_t k = 0; k < results[g].nearest.size(); ++k)
        if (const Real distance = std::sqrt(results[g].nearest[k]); distance < least.distance)
          least = {distance, g, static_cast<Index>(k)};
    return least;
  }

  /// The points of one body with their changes.
  struct Changing {
    ContactPoints<D>& points;
    const FacetRows<D>& rows;
    const ContactPlaces<D>& places;
    const ContactChanges<D>& changes;
  };
  void add_change(const Changing& own, const ContactPlaces<D>& others,
                  const ContactChanges<D>& changes, const Motion& motion, const Motion& change,
                  Forces force) const {
    const PairChange by = sums_->change(own.places, own.changes, own.rows, others, changes);
    own.points.add_force_change(own.places, own.changes, motion, change, own.rows.clusters, by.dT,
                                by.S, by.dS, force);
  }

  Report report(const Motion& motion);
  Real closing_speed_of(std::size_t grade, Real within, const Motion& motion);
  Failure describe_overlap(const Nearest& nearest) const;
  Real spacing() const { return std::max(first_.front().spacing(), second_.front().spacing()); }
  Vec<D> force_on_first(const Motion& motion) const;

  std::string name_;
  ContactLaw law_;
  std::unique_ptr<PairSums<D>> sums_;
  LennardJones interaction_;
  FacetGrades grades_;
  Graded<D> first_, second_;
  ContactList<D> list_;                       // of the coarsest points
  MovedSince<D> first_since_, second_since_;  // that was made
  // Work space of a force.
  Visited now_;
  std::vector<PairEvaluation<D>> first_result_, second_result_;  // by grade
  struct {
    std::vector<Index> first, second;
  } close_;  // clusters
};

/// Clusters with points within a distance of the other body.
template <int D>
void find_close(const FacetRows<D>& rows, const std::vector<Real>& nearest, Real within,
                std::vector<Index>& close) {
  close.clear();
  for (std::size_t k = 0; k < nearest.size(); ++k)
    if (nearest[k] < within * within) close.push_back(rows.clusters[k]);
}

/// Of the points of a grade within a distance of each other.
template <int D>
Real PairContact<D>::closing_speed_of(std::size_t grade, Real within, const Motion& motion) {
  find_close(of_first(now_, list_, grade), first_result_[grade].nearest, within, close_.first);
  find_close(of_second(now_, list_, grade), second_result_[grade].nearest, within, close_.second);
  if (close_.first.empty()) return 0;
  return closing_speed<D>(first_[grade], close_.first, &second_[grade], close_.second,
                          Vec<D>::Zero(), motion);
}

/// What the places and velocities of a force mean for the step: by the present motion alone, not by
/// what else the list has.
template <int D>
Report PairContact<D>::report(const Motion& motion) {
  Report report;
  const Nearest nearest = nearest_of(first_result_);
  const Approach any = approach(first_.front(), second_.front(), motion);
  if (!(nearest.distance < law_.reach())) {
    report.demand = approach_demand(any, law_.reach());
    return report;
  }
  if (nearest.distance < interaction_.least_gap()) report.failure = describe_overlap(nearest);
  const Real within = std::min(close_by(nearest.distance), law_.reach());
  Real speed = 0;
  for (std::size_t g = 0; g < first_.size(); ++g)
    speed = std::max(speed, closing_speed_of(g, within, motion));
  const Real inverse_inertia = 1 / first_.front().inertia() + 1 / second_.front().inertia();
  report.demand = contact_demand({interaction_, inverse_inertia, spacing(), D}, nearest.distance,
                                 {speed, within, any.speed});
  return report;
}

template <int D>
Failure PairContact<D>::describe_overlap(const Nearest& nearest) const {
  const ContactPoints<D>& points = first_[nearest.grade];
  const Index cluster =
      of_first(now_, list_, nearest.grade).clusters[static_cast<std::size_t>(nearest.cluster)];
  return {points.particle_at(cluster * Lanes::width),
          fmt::format("surfaces overlap: the gap between '{}' and '{}' is {:.4g} = {:.3g} sigma0, "
                      "least is {:.2g} sigma0",
                      points.body().name, second_.front().body().name, nearest.distance,
                      nearest.distance / law_.sigma0, law_.guard),
          true};
}

template <int D>
Vec<D> PairContact<D>::force_on_first(const Motion& motion) const {
  return look_at(motion, [&](const Visited& at_motion, const ContactList<D>& list) {
    const std::vector<PairEvaluation<D>> results = evaluated(at_motion, list);
    Vec<D> force = Vec<D>::Zero();
    for (std::size_t g = 0; g < first_.size(); ++g)
      for (const Index c : of_first(at_motion, list, g).clusters)
        for (int i = 0; i < D; ++i) force[i] -= sum(at(results[g].T, c * D + i));
    return force;
  });
}

template <int D>
std::vector<MeasureSource> PairContact<D>::measures() const {
  const auto gap = [this](const Motion& motion) {
    ContactPlaces<D> first = first_.front().at_rest(), second = second_.front().at_rest();
    first_.front().move(motion, first);
    second_.front().move(motion, second);
    return gap_between(first, second);
  };
  std::vector<MeasureSource> all{
      {"energy", dimension::energy, "energy of the interaction",
       [this](const Motion& motion) { return *stored_energy(motion); }},
      {"gap", dimension::length, "least distance of the points of the two bodies", gap},
      {"gap_per_spacing", dimension::none, "the same / distance of neighbouring points",
       [this, gap](const Motion& motion) { return gap(motion) / spacing(); }}};
  for (int i = 0; i < D; ++i)
    all.push_back({std::string("force_") + "xyz"[i], dimension::force, "force on the first body",
                   [this, i](const Motion& motion) { return force_on_first(motion)[i]; }});
  return all;
}

}  // namespace

template <int D>
std::unique_ptr<ForceTerm> contact_pair(const ContactBody<D>& first, const ContactBody<D>& second,
                                        const ContactLaw& law, const ContactChoice& choice) {
  if (!law.cut()) throw InputError("the contact of two deformable bodies needs a cut-off");
  return std::make_unique<PairContact<D>>(first, second, law, choice);
}

template std::unique_ptr<ForceTerm> contact_pair(const ContactBody<2>&, const ContactBody<2>&,
                                                 const ContactLaw&, const ContactChoice&);
template std::unique_ptr<ForceTerm> contact_pair(const ContactBody<3>&, const ContactBody<3>&,
                                                 const ContactLaw&, const ContactChoice&);

}  // namespace meniscus
