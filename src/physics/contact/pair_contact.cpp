// SPDX-License-Identifier: BSD-3-Clause
// Contact of two deformable bodies: their points, the list of pairs, the limits of steps and
// measures.
#include "meniscus/core/error.hpp"
#include "meniscus/physics/contact.hpp"
#include "meniscus/physics/contact_demand.hpp"
#include "meniscus/physics/contact_list.hpp"
#include "meniscus/physics/contact_numbers.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "pair_sums.hpp"

namespace meniscus {
namespace {

/// Where the points of both bodies are.
template <int D>
struct PairPlaces {
  ContactPlaces<D> first, second;
};

template <int D>
ContactPoints<D> points_of(const ContactBody<D>& b, const ContactChoice& choice, std::size_t side) {
  if (choice.form == ContactForm::volume)
    return ContactPoints<D>::in_volume(b.body, b.beta, choice.points);
  return surface_contact_points(b.body, b.beta, choice, side);
}

template <int D>
class PairContact final : public ForceTerm {
 public:
  PairContact(const ContactBody<D>& first, const ContactBody<D>& second, const ContactLaw& law,
              const ContactChoice& choice)
      : name_(choice.name),
        law_(law),
        sums_(pair_sums<D>(law, choice.form)),
        interaction_(law, first.beta * second.beta),
        first_(points_of(first, choice, 0)),
        second_(points_of(second, choice, 1)),
        list_(law.reach(), choice.skin * law.sigma0),
        now_{first_.at_rest(), second_.at_rest()},
        first_result_(first_.clusters(), sums_->moment()),
        second_result_(second_.clusters(), sums_->moment()) {
    first_close_.reserve(static_cast<std::size_t>(first_.clusters()));
    second_close_.reserve(static_cast<std::size_t>(second_.clusters()));
  }

  std::string name() const override { return "contact '" + name_ + "'"; }
  std::string_view energy_kind() const override { return "contact"; }

  Report add_force(const Motion& motion, Forces force) override {
    move(motion, now_);
    list_.update(now_.first.x, now_.second.x);
    update_weights(motion, list_, now_);
    sums_->evaluate(now_.first, list_.of_first(), now_.second, first_result_);
    sums_->evaluate(now_.second, list_.of_second(), now_.first, second_result_);
    first_.add_force(now_.first, list_.of_first().active, first_result_.T, first_result_.S, force);
    second_.add_force(now_.second, list_.of_second().active, second_result_.T, second_result_.S,
                      force);
    return report(motion);
  }

  void add_tangent(const Motion& motion, const Motion& change, Forces force) override {
    move(motion, now_);
    list_.update(now_.first.x, now_.second.x);
    update_weights(motion, list_, now_);
    const ContactChanges<D> first =
                                first_.changes(list_.of_first().active, now_.first, motion, change),
                            second = second_.changes(list_.of_second().active, now_.second, motion,
                                                     change);
    add_change({first_, list_.of_first(), now_.first, first}, now_.second, second, motion, change,
               force);
    add_change({second_, list_.of_second(), now_.second, second}, now_.first, first, motion, change,
               force);
  }

  std::optional<Real> stored_energy(const Motion& motion) const override {
    return look_at(motion, [&](const PairPlaces<D>& places, const ContactList<D>& list) {
      return sums_->energy(places.first, first_.clusters(), list.of_first(), places.second);
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
    return look_at(motion, [&](const PairPlaces<D>& places, const ContactList<D>& list) {
      return unresolved_gap(name_, std::sqrt(least_square(places, list.of_first())), spacing(),
                            interaction_.range());
    });
  }

  std::vector<MeasureSource> measures() const override;

  std::size_t bytes() const override {
    return first_.bytes() + second_.bytes() + now_.first.bytes() + now_.second.bytes() +
           list_.bytes() + first_result_.bytes() + second_result_.bytes();
  }
  Offset pairs() const override {
    return first_.pairs() + second_.pairs() + 2 * list_.pairs() * Lanes::width * Lanes::width;
  }

 private:
  using Rows = typename ContactList<D>::Rows;

  void move(const Motion& motion, PairPlaces<D>& places) const {
    first_.move(motion, places.first);
    second_.move(motion, places.second);
  }
  void update_weights(const Motion& motion, const ContactList<D>& list,
                      PairPlaces<D>& places) const {
    first_.update_weights(list.of_first().active, motion, places.first);
    second_.update_weights(list.of_second().active, motion, places.second);
  }

  /// f(places, list) at any motion; takes memory. The list of the forces serves where it holds.
  template <class F>
  auto look_at(const Motion& motion, F&& f) const {
    PairPlaces<D> places{first_.at_rest(), second_.at_rest()};
    move(motion, places);
    std::optional<ContactList<D>> own;
    if (!list_.valid(places.first.x, places.second.x))
      own.emplace(list_.reach(), list_.skin()).update(places.first.x, places.second.x);
    const ContactList<D>& list = own ? *own : list_;
    update_weights(motion, list, places);
    return f(places, list);
  }

  /// The points of one body with their changes.
  struct Changing {
    ContactPoints<D>& points;
    const Rows& rows;
    const ContactPlaces<D>& places;
    const ContactChanges<D>& changes;
  };
  void add_change(const Changing& own, const ContactPlaces<D>& others,
                  const ContactChanges<D>& changes, const Motion& motion, const Motion& change,
                  Forces force) const {
    const PairChange by = sums_->change(own.places, own.changes, own.rows, others, changes);
    own.points.add_force_change(own.places, own.changes, motion, change, own.rows.active, by.dT,
                                by.S, by.dS, force);
  }

  /// Least squared distance between points within reach of the list; `unbounded` if there are none.
  static Real least_square(const PairPlaces<D>& places, const Rows& rows) {
    Real least = unbounded;
    for (const Index c : rows.active)
      least = std::min(least, squares(places, c, rows.of(c)).minCoeff());
    return least;
  }
  /// Squared distances of the four points of a cluster to the nearest points of the partners.
  static Eigen::Array4d squares(const PairPlaces<D>& places, Index cluster,
                                std::span<const Index> partners) {
    Eigen::Array4d nearest = Eigen::Array4d::Constant(unbounded);
    const Index begin = cluster * Lanes::width;
    const Index points = std::min<Index>(Lanes::width, places.first.size - begin);
    for (const Index partner : partners)
      for (int lane = 0; lane < Lanes::width; ++lane) {
        const Vec<D> y =
            places.second.place(std::min(partner * Lanes::width + lane, places.second.size - 1));
        for (Index k = 0; k < points; ++k)
          nearest[k] = std::min(nearest[k], (places.first.place(begin + k) - y).squaredNorm());
      }
    return nearest;
  }

  Report report(const Motion& motion);
  Failure describe_overlap(Real gap) const;
  static void find_close(const Rows& rows, const std::vector<Real>& nearest, Real gap,
                         std::vector<Index>& close);
  Real spacing() const { return std::max(first_.spacing(), second_.spacing()); }
  Vec<D> force_on_first(const Motion& motion) const;

  std::string name_;
  ContactLaw law_;
  std::unique_ptr<PairSums<D>> sums_;
  LennardJones interaction_;
  ContactPoints<D> first_, second_;
  ContactList<D> list_;
  // Work space of a force.
  PairPlaces<D> now_;
  PairEvaluation<D> first_result_, second_result_;
  std::vector<Index> first_close_, second_close_;  // clusters that decide how fast the gap closes
};

/// Clusters with points that are no farther than `close_by` gaps from the other body.
template <int D>
void PairContact<D>::find_close(const Rows& rows, const std::vector<Real>& nearest, Real gap,
                                std::vector<Index>& close) {
  close.clear();
  for (std::size_t k = 0; k < nearest.size(); ++k)
    if (nearest[k] <= close_by * close_by * gap * gap) close.push_back(rows.active[k]);
}

/// What the places and velocities of a force mean for the step: by the present motion alone, not by
/// what else the list has.
template <int D>
Report PairContact<D>::report(const Motion& motion) {
  Report report;
  const std::vector<Real>& nearest = first_result_.nearest;
  Real gap = unbounded;
  for (const Real square : nearest) gap = std::min(gap, std::sqrt(square));
  const Approach any = approach(first_, second_, motion);
  if (!(gap < law_.reach())) {
    report.demand = approach_demand(any, law_.reach());
    return report;
  }
  if (gap < interaction_.least_gap()) report.failure = describe_overlap(gap);
  find_close(list_.of_first(), nearest, gap, first_close_);
  find_close(list_.of_second(), second_result_.nearest, gap, second_close_);
  const Real speed =
      closing_speed<D>(first_, first_close_, &second_, second_close_, Vec<D>::Zero(), motion);
  report.demand =
      contact_demand({interaction_, 1 / first_.inertia() + 1 / second_.inertia(), spacing(), D},
                     gap, speed, any.speed);
  return report;
}

template <int D>
Failure PairContact<D>::describe_overlap(Real gap) const {
  const auto& active = list_.of_first().active;
  const std::vector<Real>& nearest = first_result_.nearest;
  const auto k = std::min_element(nearest.begin(), nearest.end()) - nearest.begin();
  const Index cluster = at(active, k);
  Eigen::Index lane = 0;
  squares(now_, cluster, list_.of_first().of(cluster)).minCoeff(&lane);
  const Index point = cluster * Lanes::width + static_cast<Index>(lane);
  return {first_.particle_at(point),
          fmt::format("surfaces overlap: the gap between '{}' and '{}' is {:.4g} = {:.3g} sigma0, "
                      "least is {:.2g} sigma0",
                      first_.body().name, second_.body().name, gap, gap / law_.sigma0, law_.guard),
          true};
}

template <int D>
Vec<D> PairContact<D>::force_on_first(const Motion& motion) const {
  return look_at(motion, [&](const PairPlaces<D>& places, const ContactList<D>& list) {
    PairEvaluation<D> result(first_.clusters(), sums_->moment());
    sums_->evaluate(places.first, list.of_first(), places.second, result);
    Vec<D> force = Vec<D>::Zero();
    for (const Index c : list.of_first().active)
      for (int i = 0; i < D; ++i) force[i] -= sum(at(result.T, c * D + i));
    return force;
  });
}

template <int D>
std::vector<MeasureSource> PairContact<D>::measures() const {
  const auto gap = [this](const Motion& motion) {
    PairPlaces<D> places{first_.at_rest(), second_.at_rest()};
    move(motion, places);
    return gap_between(places.first, places.second);
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
