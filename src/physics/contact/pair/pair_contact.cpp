// SPDX-License-Identifier: BSD-3-Clause
// Contact of two deformable bodies, summed over the pairs of their contact points: forces, limits
// of the step, and measures.
#include "meniscus/error.hpp"
#include "physics/contact/contact_numbers.hpp"
#include "physics/contact/contact_terms.hpp"
#include "physics/contact/pair/contact_demand.hpp"
#include "physics/contact/pair/contact_visits.hpp"
#include "physics/contact/pair/pair_sums.hpp"
#include "physics/contact/pair/pair_visits.hpp"
#include "physics/contact/phases.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace meniscus {
namespace {

/// The cluster of the first body that is nearest to the second body.
struct NearestCluster {
  Real distance = unbounded;
  std::size_t grade = 0;
  Index cluster = 0;
};

template <int D>
class PairContact final : public ForceTerm, public ContactVisits {
 public:
  PairContact(const ContactBody<D>& first, const ContactBody<D>& second, const ContactLaw& law,
              const ContactChoice& choice)
      : name_(choice.name),
        overlap_(choice.overlap),
        law_(law),
        sums_(pair_sums<D>(law, choice.form, first.body.geometry.grid.revolved)),
        interaction_(law, first.beta * second.beta),
        visits_(first, second, interaction_, law, choice) {
    first_boxes_ = PartTally<CoefficientBoxes<D>>(visits_.work().rows(first.body.division));
    second_boxes_ = PartTally<CoefficientBoxes<D>>(visits_.work().rows(second.body.division));
    for (std::size_t g = 0; g < visits_.grades(); ++g) {
      first_result_.emplace_back(visits_.first(g).clusters(), sums_->moment());
      second_result_.emplace_back(visits_.second(g).clusters(), sums_->moment());
    }
    close_.first.reserve(static_cast<std::size_t>(visits_.first(0).clusters()));
    close_.second.reserve(static_cast<std::size_t>(visits_.second(0).clusters()));
  }

  std::string name() const override { return "contact '" + name_ + "'"; }
  std::string_view energy_kind() const override { return "contact"; }

  /// Finds the points that may be near, gathers their places, gathers the forces on them, and adds
  /// these to the particles.
  Report add_force(const Motion& motion, Forces force) override {
    if (!visits_.work().takes_part()) return share_summary(motion, force);
    return go_on<&PairContact::place>(*this, visits_.work(), visits_.moves(motion), motion, force);
  }

  void add_tangent(const Motion& motion, const Motion& change, Forces force) override {
    visits_.visit(motion);
    const VisitedPair<D>& now = visits_.now();
    for (std::size_t g = 0; g < visits_.grades(); ++g) {
      const FacetRows<D> of_first = now.of_first(g), of_second = now.of_second(g);
      const ContactChanges<D> first = visits_.first(g).changes(of_first.clusters, now.first[g],
                                                               motion, change),
                              second = visits_.second(g).changes(of_second.clusters, now.second[g],
                                                                 motion, change);
      add_change({visits_.first(g), of_first, now.first[g], first}, now.second[g], second, motion,
                 change, force);
      add_change({visits_.second(g), of_second, now.second[g], second}, now.first[g], first, motion,
                 change, force);
    }
  }

  std::optional<Real> stored_energy(const Motion& motion) const override {
    return visits_.look_at(motion, [&](const VisitedPair<D>& visited) {
      Real energy = 0;
      for (std::size_t g = 0; g < visits_.grades(); ++g)
        // Sum over all clusters, so that the order of summation does not depend on the active ones.
        energy +=
            visits_.first(g).body().sum_over_rows(visits_.first(g).clusters(), 0.0, [&](Index c) {
              return sums_->energy(visited.first[g], c, visited.of_first(g), visited.second[g]);
            });
      return energy;
    });
  }

  /// The stored energy, if the forces are its gradient. Some forms have none.
  std::optional<Real> potential(const Motion& motion) override {
    if (!sums_->conservative()) return std::nullopt;
    return stored_energy(motion);
  }

  bool reads(StepReads& reads) override {
    visits_.list_reads(reads);
    return true;
  }
  bool reads_changed() const override { return visits_.reads_changed(); }
  bool may_reject_steps() const override { return true; }
  bool stops_drift() const override { return true; }

  std::optional<std::string> warning(const Motion& motion) const override {
    return visits_.look_at(motion, [&](const VisitedPair<D>& visited) {
      return unresolved_gap(name_, nearest_of(evaluated(visited), visited).distance, spacing(),
                            interaction_.range());
    });
  }

  std::vector<MeasureSource> measures() const override;

  std::size_t bytes() const override {
    std::size_t n = visits_.bytes();
    for (std::size_t g = 0; g < visits_.grades(); ++g)
      n += first_result_[g].bytes() + second_result_[g].bytes();
    return n;
  }
  Offset pairs() const override {
    Offset n = visits_.point_pairs();
    for (std::size_t g = 0; g < visits_.grades(); ++g)
      n += visits_.first(g).pairs() + visits_.second(g).pairs();
    return n;
  }

 private:
  /// Moves the coarsest points; if the list does not cover the motion, all of them.
  Report place(const Motion& motion, Forces force) {
    const bool known = visits_.covers() || visits_.work().is_of_few();
    const Motion here = known ? motion : force.everywhere(motion);
    return go_on<&PairContact::choose>(*this, visits_.work(), visits_.place(here), here, force);
  }
  Report choose(const Motion& motion, Forces force) {
    visits_.choose(motion);
    if (visits_.grades() == 1) return evaluate(motion, force);
    return go_on<&PairContact::take_grades>(*this, visits_.work(), visits_.place_grades(motion),
                                            motion, force);
  }
  Report take_grades(const Motion& motion, Forces force) {
    visits_.take_grades();
    return evaluate(motion, force);
  }
  /// Sums the forces on a share of the points.
  Report evaluate(const Motion& motion, Forces force) {
    count(visits_.point_pairs());
    const VisitedPair<D>& now = visits_.now();
    gathered_.clear();
    const auto evaluate_side = [&](const ContactPlaces<D>& points, const FacetRows<D>& rows,
                                   const ContactPlaces<D>& others, PairEvaluation<D>& result) {
      const Portions shares = shares_of(rows);
      sums_->evaluate(points, rows, others, shares.own(), result);
      gathered_.push_back(result.packed(rows, shares));
      gathered_.push_back(result.nearest_of(shares));
    };
    for (std::size_t g = 0; g < visits_.grades(); ++g) {
      if (visits_.work().reports())
        evaluate_side(now.first[g], now.of_first(g), now.second[g], first_result_[g]);
      evaluate_side(now.second[g], now.of_second(g), now.first[g], second_result_[g]);
    }
    if (force.demand) take_boxes(motion);
    gathered_.push_back(first_boxes_.gathered());
    gathered_.push_back(second_boxes_.gathered());
    return go_on<&PairContact::add_forces>(*this, visits_.work(), gathered_, motion, force);
  }
  /// Adds the forces on all points to the particles.
  Report add_forces(const Motion& motion, Forces force) {
    const VisitedPair<D>& now = visits_.now();
    const auto add_side = [&](ContactPoints<D>& points, const ContactPlaces<D>& places,
                              const FacetRows<D>& rows, PairEvaluation<D>& result) {
      result.take(rows, shares_of(rows));
      if (!rows.clusters.empty())
        points.add_force(places, rows.clusters, result.T, result.S, force);
    };
    for (std::size_t g = 0; g < visits_.grades(); ++g) {
      if (visits_.work().reports())
        add_side(visits_.first(g), now.first[g], now.of_first(g), first_result_[g]);
      add_side(visits_.second(g), now.second[g], now.of_second(g), second_result_[g]);
    }
    if (visits_.work().reports()) summarise(motion, force.demand);
    return share_summary(motion, force);
  }
  Report share_summary(const Motion& motion, Forces force) {
    return force.gather({visits_.work().reported(&summary_)}, motion,
                        [this](const Motion& m, const Forces&) { return report(m.time); });
  }
  Portions shares_of(const FacetRows<D>& rows) const {
    return visits_.work().items(static_cast<Index>(rows.clusters.size()));
  }
  void take_boxes(const Motion& motion) {
    const ContactPoints<D>&first = visits_.first(0), &second = visits_.second(0);
    if (auto* const mine = first_boxes_.mine())
      *mine = {first, first.own_particles(visits_.work()), motion};
    if (auto* const mine = second_boxes_.mine())
      *mine = {second, second.own_particles(visits_.work()), motion};
  }
  static CoefficientBoxes<D> joined(const PartTally<CoefficientBoxes<D>>& boxes) {
    CoefficientBoxes<D> all;
    for (const CoefficientBoxes<D>& of_part : boxes) all.join(of_part);
    return all;
  }
  /// Sums on the first body, by grade.
  std::vector<PairEvaluation<D>> evaluated(const VisitedPair<D>& visited) const {
    std::vector<PairEvaluation<D>> results;
    for (std::size_t g = 0; g < visits_.grades(); ++g) {
      PairEvaluation<D>& result =
          results.emplace_back(visits_.first(g).clusters(), sums_->moment());
      const FacetRows<D> rows = visited.of_first(g);
      const Portions shares = evenly.items(static_cast<Index>(rows.clusters.size()));
      sums_->evaluate(visited.first[g], rows, visited.second[g], shares.own(), result);
      GatherTogether()({{result.packed(rows, shares), result.nearest_of(shares)}});
      result.take(rows, shares);
    }
    return results;
  }
  static NearestCluster nearest_of(const std::vector<PairEvaluation<D>>& results,
                                   const VisitedPair<D>& visited) {
    NearestCluster least;
    for (std::size_t g = 0; g < results.size(); ++g)
      for (std::size_t k = 0; k < results[g].nearest.size(); ++k)
        if (const Real distance = std::sqrt(results[g].nearest[k]); distance < least.distance)
          least = {distance, g, visited.of_first(g).clusters[k]};
    return least;
  }

  /// The points of one body with changes of their positions.
  struct Changing {
    ContactPoints<D>& points;
    const FacetRows<D>& rows;
    const ContactPlaces<D>& places;
    const ContactChanges<D>& changes;
  };
  void add_change(const Changing& own, const ContactPlaces<D>& others,
                  const ContactChanges<D>& changes, const Motion& motion, const Motion& change,
                  Forces force) const {
    if (own.rows.clusters.empty()) return;
    const PairChange by = sums_->change(own.places, own.changes, own.rows, others, changes);
    own.points.add_force_change(own.places, own.changes, motion, change, own.rows.clusters, by.dT,
                                by.S, by.dS, force);
  }

  void summarise(const Motion& motion, bool demand);
  Report report(Real time) const;
  Real closing_speed_of(std::size_t grade, Real within, const Motion& motion);
  Failure describe_overlap(const NearestCluster& nearest, Real time) const;
  Real spacing() const { return std::max(visits_.first(0).spacing(), visits_.second(0).spacing()); }
  Vec<D> force_on_first(const Motion& motion) const;

  std::string name_;
  std::string overlap_;  // advice for surfaces that pass through each other
  ContactLaw law_;
  std::unique_ptr<PairSums<D>> sums_;
  LennardJones interaction_;
  PairVisits<D> visits_;
  struct Summary {
    NearestCluster nearest;
    StepDemand demand;
  };
  // Results and work space of a force.
  Summary summary_;
  PartTally<CoefficientBoxes<D>> first_boxes_, second_boxes_;
  std::vector<Gathered> gathered_;
  std::vector<PairEvaluation<D>> first_result_, second_result_;  // [grade]
  struct {
    std::vector<Index> first, second;
  } close_;  // clusters near the other body
};

/// Finds the clusters with points within a distance of the other body.
template <int D>
void find_close(const FacetRows<D>& rows, const std::vector<Real>& nearest, Real within,
                std::vector<Index>& close) {
  close.clear();
  for (std::size_t k = 0; k < nearest.size(); ++k)
    if (nearest[k] < within * within) close.push_back(rows.clusters[k]);
}

/// Speed at which the points of a grade that are within a distance of each other approach.
template <int D>
Real PairContact<D>::closing_speed_of(std::size_t grade, Real within, const Motion& motion) {
  const VisitedPair<D>& now = visits_.now();
  find_close(now.of_first(grade), first_result_[grade].nearest, within, close_.first);
  find_close(now.of_second(grade), second_result_[grade].nearest, within, close_.second);
  if (close_.first.empty()) return 0;
  return closing_speed<D>(visits_.first(grade), close_.first, visits_.second(grade), close_.second,
                          motion);
}

/// Finds the nearest points, and the limit of the step from present positions and velocities. Pairs
/// of the list that are out of reach have no influence.
template <int D>
void PairContact<D>::summarise(const Motion& motion, bool demand) {
  const ContactPoints<D>&first = visits_.first(0), &second = visits_.second(0);
  summary_ = {nearest_of(first_result_, visits_.now()), {}};
  if (!demand) return;
  const Real gap = summary_.nearest.distance;
  const Approach any = approach(first, joined(first_boxes_), second, joined(second_boxes_));
  if (!(gap < law_.reach())) {
    summary_.demand = approach_demand(any, law_.reach());
    return;
  }
  const Real within = std::min(close_by(gap), law_.reach());
  Real speed = 0;
  for (std::size_t g = 0; g < visits_.grades(); ++g)
    speed = std::max(speed, closing_speed_of(g, within, motion));
  const Real inverse_inertia = 1 / first.inertia() + 1 / second.inertia();
  summary_.demand = contact_demand({interaction_, inverse_inertia, spacing(), D}, gap,
                                   {speed, within, any.speed});
}

template <int D>
Report PairContact<D>::report(Real time) const {
  Report report;
  report.demand = summary_.demand;
  if (summary_.nearest.distance < interaction_.least_gap())
    report.failure = describe_overlap(summary_.nearest, time);
  return report;
}

template <int D>
Failure PairContact<D>::describe_overlap(const NearestCluster& nearest, Real time) const {
  const ContactPoints<D>& points = visits_.first(nearest.grade);
  return {points.particle_at(nearest.cluster * Lanes::width),
          fmt::format("surfaces overlap: the gap between '{}' and '{}' is {:.4g} = {:.3g} sigma0, "
                      "least is {:.2g} sigma0{}",
                      points.body().name, visits_.second(0).body().name, nearest.distance,
                      nearest.distance / law_.sigma0, law_.guard, time > 0 ? overlap_ : ""),
          true};
}

template <int D>
Vec<D> PairContact<D>::force_on_first(const Motion& motion) const {
  return visits_.look_at(motion, [&](const VisitedPair<D>& visited) {
    const std::vector<PairEvaluation<D>> results = evaluated(visited);
    Vec<D> force = Vec<D>::Zero();
    for (std::size_t g = 0; g < visits_.grades(); ++g)
      for (const Index c : visited.of_first(g).clusters)
        for (int i = 0; i < D; ++i) force[i] -= sum(at(results[g].T, c * D + i));
    return force;
  });
}

template <int D>
std::vector<MeasureSource> PairContact<D>::measures() const {
  const auto gap = [this](const Motion& motion) {
    const ContactPoints<D>&first = visits_.first(0), &second = visits_.second(0);
    ContactPlaces<D> of_first = first.at_rest(), of_second = second.at_rest();
    first.move(motion, of_first);
    second.move(motion, of_second);
    return gap_between(of_first, of_second);
  };
  std::vector<MeasureSource> all{
      {"energy", dimension::energy, "energy of the interaction",
       [this](const Motion& motion) { return *stored_energy(motion); }},
      {"gap", dimension::length, "least distance of the points of the two bodies", gap},
      {"gap_per_spacing", dimension::none, "least gap / distance of neighbouring points",
       [this, gap](const Motion& motion) { return gap(motion) / spacing(); }}};
  const bool revolved = visits_.first(0).body().geometry.grid.revolved;
  for (int i = revolved ? 1 : 0; i < D; ++i)
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
