// SPDX-License-Identifier: BSD-3-Clause
// Contact of two deformable bodies: one loop over the pairs of a list, the form and the kernel are
// compiled into it.
#include "meniscus/core/error.hpp"
#include "meniscus/physics/contact.hpp"
#include "meniscus/physics/contact_demand.hpp"
#include "meniscus/physics/contact_forms.hpp"
#include "meniscus/physics/contact_list.hpp"
#include "meniscus/physics/contact_numbers.hpp"

#include <fmt/format.h>

#include <cmath>

namespace meniscus {
namespace {

/// One of the two bodies while forces are added up.
template <int D>
struct Side {
  ContactPoints<D> points;
  AlignedVector<Lanes> T, S;  ///< [cluster][i], as in contact_forms.hpp
  std::vector<Real> nearest;  ///< [active cluster] least squared distance to the other body

  explicit Side(ContactPoints<D> contact_points, bool moment) : points(std::move(contact_points)) {
    T.assign(static_cast<std::size_t>(points.clusters()) * D, Lanes::zero());
    if (moment) S = T;
    nearest.reserve(static_cast<std::size_t>(points.clusters()));
  }
};

template <int D>
ContactPoints<D> points_of(const ContactBody<D>& b, const ContactChoice& choice) {
  if (choice.form == ContactForm::volume)
    return ContactPoints<D>::in_volume(b.body, b.beta, choice.points);
  return ContactPoints<D>::on_surface(b.body, b.beta, choice.density, choice.points);
}

template <int D, class Form, PairKernel K>
class PairContact final : public ForceTerm {
 public:
  PairContact(const ContactBody<D>& first, const ContactBody<D>& second, const ContactLaw& law,
              const ContactChoice& choice)
      : name_(choice.name),
        law_(law),
        pair_law_(law),
        interaction_(law, first.beta * second.beta),
        now_(std::make_unique<Configuration>(
            Configuration{Side<D>(points_of(first, choice), Form::moment),
                          Side<D>(points_of(second, choice), Form::moment),
                          ContactList<D>(law.reach(), choice.skin * law.sigma0)})) {}

  std::string name() const override { return "contact '" + name_ + "'"; }
  std::string_view energy_kind() const override { return "contact"; }

  void add_force(const Motion& motion, std::span<Lanes> force) override {
    Configuration& now = *now_;
    bring_up(motion);
    sum_all<Form>(now.first, now.list.of_first(), now.second.points);
    sum_all<Form>(now.second, now.list.of_second(), now.first.points);
    now.first.points.add_force(now.list.of_first().active, now.first.T, now.first.S, force);
    now.second.points.add_force(now.list.of_second().active, now.second.T, now.second.S, force);
    note_closeness(motion);
  }

  std::optional<Real> stored_energy(const Motion& motion) const override {
    bring_up(motion);
    return energy();
  }

  std::optional<Failure> failure() const override { return failure_; }
  bool may_reject_steps() const override { return true; }
  StepDemand step_demand() const override { return demand_; }

  std::optional<std::string> warning(const Motion& motion) const override {
    bring_up(motion);
    return unresolved_gap(name_, std::sqrt(least_square()), spacing(), interaction_.range());
  }

  std::vector<MeasureSource> measures() const override;

  std::size_t bytes() const override {
    const Side<D>&a = now_->first, &b = now_->second;
    return a.points.bytes() + b.points.bytes() + now_->list.bytes() +
           (a.T.size() + a.S.size() + b.T.size() + b.S.size()) * sizeof(Lanes);
  }
  Offset pairs() const override {
    return now_->first.points.pairs() + now_->second.points.pairs() +
           2 * now_->list.pairs() * Lanes::width * Lanes::width;
  }

 private:
  /// Places, weights and list of the motion looked at last.
  struct Configuration {
    Side<D> first, second;
    ContactList<D> list;
  };
  using Rows = typename ContactList<D>::Rows;

  void bring_up(const Motion& motion) const {
    Configuration& now = *now_;
    now.first.points.move(motion);
    now.second.points.move(motion);
    now.list.update(now.first.points.x(), now.second.points.x());
    now.first.points.weigh(now.list.of_first().active, motion);
    now.second.points.weigh(now.list.of_second().active, motion);
  }

  template <class AnyForm>
  void sum_all(Side<D>& side, const Rows& rows, const ContactPoints<D>& others) const {
    side.nearest.resize(rows.active.size());
    parallel_for(
        static_cast<Index>(rows.active.size()),
        [&](Index k) {
          const Index c = at(rows.active, k);
          Lanes T[D], S[D];
          for (int i = 0; i < D; ++i) T[i] = S[i] = Lanes::zero();
          const Lanes nearest = contact::sum_over_partners<AnyForm, D>(
              pair_law_, law_.reach(), side.points.x(c), side.points.weight(c), rows.of(c), others,
              T, S);
          at(side.nearest, k) =
              std::min(std::min(nearest[0], nearest[1]), std::min(nearest[2], nearest[3]));
          for (int i = 0; i < D; ++i) {
            at(side.T, c * D + i) = T[i];
            if (AnyForm::moment) at(side.S, c * D + i) = S[i];
          }
        },
        4);
  }

  Real energy() const {
    const Side<D>& side = now_->first;
    const Rows& rows = now_->list.of_first();
    // Over all clusters: the order of summation must not depend on which are active.
    return parallel_sum(side.points.clusters(), 0.0, [&](Index c) {
      Lanes T[D], S[1];
      T[0] = Lanes::zero();
      contact::sum_over_partners<contact::Potential<D, Form::components>, D>(
          pair_law_, law_.reach(), side.points.x(c), side.points.weight(c), rows.of(c),
          now_->second.points, T, S);
      return sum(T[0]);
    });
  }

  /// Least squared distance between points within reach of the list; 1e300 if there are none.
  Real least_square() const {
    const Rows& rows = now_->list.of_first();
    Real least = 1e300;
    for (const Index c : rows.active) least = std::min(least, squares(c, rows.of(c)).minCoeff());
    return least;
  }
  /// Squared distances of the four points of a cluster to the nearest points of the partners.
  Eigen::Array4d squares(Index cluster, std::span<const Index> partners) const {
    Eigen::Array4d nearest = Eigen::Array4d::Constant(1e300);
    const ContactPoints<D>& others = now_->second.points;
    for (const Index partner : partners)
      for (int lane = 0; lane < Lanes::width; ++lane) {
        const Vec<D> y = others.place(std::min(partner * Lanes::width + lane, others.size() - 1));
        for (int own = 0; own < now_->first.points.points_in(cluster); ++own)
          nearest[own] =
              std::min(nearest[own],
                       (now_->first.points.place(cluster * Lanes::width + own) - y).squaredNorm());
      }
    return nearest;
  }

  void note_closeness(const Motion& motion);
  Failure describe_overlap(Real gap) const;
  Real spacing() const {
    return std::max(now_->first.points.spacing(), now_->second.points.spacing());
  }
  Vec<D> force_on_first(const Motion& motion) const;

  std::string name_;
  ContactLaw law_;
  PairLaw<K> pair_law_;
  LennardJones interaction_;
  std::unique_ptr<Configuration> now_;
  std::optional<Failure> failure_;
  StepDemand demand_;
};

/// What the places and velocities of the last add_force() mean for the step.
template <int D, class Form, PairKernel K>
void PairContact<D, Form, K>::note_closeness(const Motion& motion) {
  failure_.reset();
  demand_ = {};
  const std::vector<Real>& nearest = now_->first.nearest;
  if (nearest.empty()) return;
  const Real gap = std::sqrt(*std::min_element(nearest.begin(), nearest.end()));
  if (gap < interaction_.least_gap()) failure_ = describe_overlap(gap);
  const ContactPoints<D>&a = now_->first.points, &b = now_->second.points;
  const Real speed = closing_speed<D>(a, now_->list.of_first().active, &b,
                                      now_->list.of_second().active, Vec<D>::Zero(), motion);
  demand_ =
      contact_demand({interaction_, 1 / a.inertia() + 1 / b.inertia(), spacing(), D}, gap, speed);
}

template <int D, class Form, PairKernel K>
Failure PairContact<D, Form, K>::describe_overlap(Real gap) const {
  const auto& active = now_->list.of_first().active;
  const auto k = std::min_element(now_->first.nearest.begin(), now_->first.nearest.end()) -
                 now_->first.nearest.begin();
  const Index cluster = at(active, k);
  Eigen::Index lane = 0;
  squares(cluster, now_->list.of_first().of(cluster)).minCoeff(&lane);
  const Index point = cluster * Lanes::width + static_cast<Index>(lane);
  return {now_->first.points.particle_at(point),
          fmt::format("surfaces overlap: the gap between '{}' and '{}' is {:.4g} = {:.3g} sigma0, "
                      "least is {:.2g} sigma0",
                      now_->first.points.body().name, now_->second.points.body().name, gap,
                      gap / law_.sigma0, law_.guard),
          true};
}

template <int D, class Form, PairKernel K>
Vec<D> PairContact<D, Form, K>::force_on_first(const Motion& motion) const {
  bring_up(motion);
  sum_all<Form>(now_->first, now_->list.of_first(), now_->second.points);
  Vec<D> force = Vec<D>::Zero();
  for (const Index c : now_->list.of_first().active)
    for (int i = 0; i < D; ++i) force[i] -= sum(at(now_->first.T, c * D + i));
  return force;
}

template <int D, class Form, PairKernel K>
std::vector<MeasureSource> PairContact<D, Form, K>::measures() const {
  const auto gap = [this](const Motion& motion) {
    bring_up(motion);
    return gap_between(now_->first.points, now_->second.points);
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

template <int D, PairKernel K>
std::unique_ptr<ForceTerm> with_form(const ContactBody<D>& first, const ContactBody<D>& second,
                                     const ContactLaw& law, const ContactChoice& choice) {
  using namespace contact;
  switch (choice.form) {
    case ContactForm::pressure:
      return std::make_unique<PairContact<D, Pressure<D>, K>>(first, second, law, choice);
    case ContactForm::volume:
      return std::make_unique<PairContact<D, Volume<D>, K>>(first, second, law, choice);
    case ContactForm::dissertation:
      return std::make_unique<PairContact<D, Dissertation<D>, K>>(first, second, law, choice);
    case ContactForm::energy:
      break;
  }
  return std::make_unique<PairContact<D, Energy<D>, K>>(first, second, law, choice);
}

}  // namespace

template <int D>
std::unique_ptr<ForceTerm> contact_pair(const ContactBody<D>& first, const ContactBody<D>& second,
                                        const ContactLaw& law, const ContactChoice& choice) {
  if (!law.cut()) throw InputError("The contact of two deformable bodies needs a cut-off.");
  if (dimension_of(law.kernel) != D)
    throw InputError("The kernel of the contact has another dimension than the bodies.");
  if constexpr (D == 3)
    return with_form<D, PairKernel::space>(first, second, law, choice);
  else if (law.kernel == PairKernel::planar)
    return with_form<D, PairKernel::planar>(first, second, law, choice);
  else
    return with_form<D, PairKernel::integrated>(first, second, law, choice);
}

template std::unique_ptr<ForceTerm> contact_pair(const ContactBody<2>&, const ContactBody<2>&,
                                                 const ContactLaw&, const ContactChoice&);
template std::unique_ptr<ForceTerm> contact_pair(const ContactBody<3>&, const ContactBody<3>&,
                                                 const ContactLaw&, const ContactChoice&);

}  // namespace meniscus
