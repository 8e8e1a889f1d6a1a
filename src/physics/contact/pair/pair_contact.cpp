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

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace meniscus {
namespace {

/// The cluster of the first body that is nearest to the second body.
struct NearestCluster {
  Real distance = unbounded;
  std::size_t grade = 0;
  Index cluster = 0;  ///< number among the clusters with partners
};

template <int D>
class PairContact final : public ForceTerm, public ContactVisits {
 public:
  PairContact(const ContactBody<D>& first, const ContactBody<D>& second, const ContactLaw& law,
              const ContactChoice& choice)
      : name_(choice.name),
        overlap_(choice.overlap),
        law_(law),
        sums_(pair_sums<D>(law, choice.form)),
        interaction_(law, first.beta * second.beta),
        visits_(first, second, interaction_, law, choice) {
    for (std::size_t g = 0; g < visits_.grades(); ++g) {
      first_result_.emplace_back(visits_.first(g).clusters(), sums_->moment());
      second_result_.emplace_back(visits_.second(g).clusters(), sums_->moment());
    }
    close_.first.reserve(static_cast<std::size_t>(visits_.first(0).clusters()));
    close_.second.reserve(static_cast<std::size_t>(visits_.second(0).clusters()));
  }

  std::string name() const override { return "contact '" + name_ + "'"; }
  std::string_view energy_kind() const override { return "contact"; }

  Report add_force(const Motion& motion, Forces force) override {
    return visits_.ranks().report_of([&] { return add_known_force(motion, force); });
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
        energy += sums_->energy(visited.first[g], visits_.first(g).clusters(), visited.of_first(g),
                                visited.second[g], division());
      return energy;
    });
  }

  /// The stored energy, if the forces are its gradient. Some forms have none.
  std::optional<Real> potential(const Motion& motion) override {
    if (!sums_->conservative()) return std::nullopt;
    return stored_energy(motion);
  }

  bool tell_reads(StepReads& reads) override {
    visits_.tell_reads(reads);
    return true;
  }
  bool reads_changed() const override { return visits_.reads_changed(); }
  bool may_outgrow_halo() const override { return !visits_.ranks().are_few(); }
  bool may_reject_steps() const override { return true; }
  bool stops_drift() const override { return true; }

  std::optional<std::string> warning(const Motion& motion) const override {
    return visits_.look_at(motion, [&](const VisitedPair<D>& visited) {
      return unresolved_gap(name_, nearest_of(evaluated(visited)).distance, spacing(),
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
  const Division& division() const { return visits_.ranks().division(); }
  /// Adds the force on a rank that takes part in the contact.
  Report add_known_force(const Motion& motion, Forces force) {
    const bool reports = visits_.ranks().reports();
    visits_.visit(motion);
    count(visits_.point_pairs());
    const VisitedPair<D>& now = visits_.now();
    for (std::size_t g = 0; g < visits_.grades(); ++g) {
      const FacetRows<D> first = now.of_first(g), second = now.of_second(g);
      if (reports) {
        sums_->evaluate(now.first[g], first, now.second[g], division(), first_result_[g]);
        if (!first.clusters.empty())
          visits_.first(g).add_force(now.first[g], first.clusters, first_result_[g].T,
                                     first_result_[g].S, force);
      }
      sums_->evaluate(now.second[g], second, now.first[g], division(), second_result_[g]);
      if (!second.clusters.empty())
        visits_.second(g).add_force(now.second[g], second.clusters, second_result_[g].T,
                                    second_result_[g].S, force);
    }
    return reports ? report(motion) : Report();
  }
  /// Sums on the first body, by grade.
  std::vector<PairEvaluation<D>> evaluated(const VisitedPair<D>& visited) const {
    std::vector<PairEvaluation<D>> results;
    for (std::size_t g = 0; g < visits_.grades(); ++g) {
      results.emplace_back(visits_.first(g).clusters(), sums_->moment());
      sums_->evaluate(visited.first[g], visited.of_first(g), visited.second[g], division(),
                      results.back());
    }
    return results;
  }
  static NearestCluster nearest_of(const std::vector<PairEvaluation<D>>& results) {
    NearestCluster least;
    for (std::size_t g = 0; g < results.size(); ++g)
      for (std::size_t k = 0; k < results[g].nearest.size(); ++k)
        if (const Real distance = std::sqrt(results[g].nearest[k]); distance < least.distance)
          least = {distance, g, static_cast<Index>(k)};
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

  Report report(const Motion& motion);
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
  // Work space of a force.
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
  return closing_speed<D>(visits_.first(grade), close_.first, &visits_.second(grade), close_.second,
                          Vec<D>::Zero(), motion);
}

/// Report of the last force: failures, and the limit of the step from present positions and
/// velocities. Pairs of the list that are out of reach have no influence.
template <int D>
Report PairContact<D>::report(const Motion& motion) {
  Report report;
  const ContactPoints<D>&first = visits_.first(0), &second = visits_.second(0);
  const NearestCluster nearest = nearest_of(first_result_);
  const Approach any = approach(first, second, motion);
  if (!(nearest.distance < law_.reach())) {
    report.demand = approach_demand(any, law_.reach());
    return report;
  }
  if (nearest.distance < interaction_.least_gap())
    report.failure = describe_overlap(nearest, motion.time);
  const Real within = std::min(close_by(nearest.distance), law_.reach());
  Real speed = 0;
  for (std::size_t g = 0; g < visits_.grades(); ++g)
    speed = std::max(speed, closing_speed_of(g, within, motion));
  const Real inverse_inertia = 1 / first.inertia() + 1 / second.inertia();
  report.demand = contact_demand({interaction_, inverse_inertia, spacing(), D}, nearest.distance,
                                 {speed, within, any.speed});
  return report;
}

template <int D>
Failure PairContact<D>::describe_overlap(const NearestCluster& nearest, Real time) const {
  const ContactPoints<D>& points = visits_.first(nearest.grade);
  const Index cluster =
      visits_.now().of_first(nearest.grade).clusters[static_cast<std::size_t>(nearest.cluster)];
  return {points.particle_at(cluster * Lanes::width),
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
