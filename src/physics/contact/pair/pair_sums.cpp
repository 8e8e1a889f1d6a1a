// SPDX-License-Identifier: BSD-3-Clause
// The sums of contact over pairs of points. Scenes with two bodies in contact spend most of their
// time in these loops.
#include "physics/contact/pair/pair_sums.hpp"

#include "meniscus/error.hpp"
#include "parallel/parallel.hpp"
#include "physics/contact/pair/contact_forms.hpp"

#include <algorithm>

namespace meniscus {
namespace {

/// Sums of a form, with its potential energy, for a law of pairs of points.
template <int D, class Form, class Energy, class Law>
class PairSumsOf final : public PairSums<D> {
 public:
  explicit PairSumsOf(const ContactLaw& law) : law_(law), reach_(law.reach()) {}

  bool moment() const override { return Form::moment; }
  bool conservative() const override {
    return std::is_same_v<Form, contact::Energy<D>> || std::is_same_v<Form, contact::Volume<D>> ||
           std::is_same_v<Form, contact::RingEnergy>;
  }

  void evaluate(const ContactPlaces<D>& points, const FacetRows<D>& rows,
                const ContactPlaces<D>& others, const ItemRange& share,
                PairEvaluation<D>& result) const override {
    result.nearest.resize(rows.clusters.size());
    parallel_for(
        share,
        [&](Index k) {
          const Index c = at(rows.clusters, k);
          Lanes T[D], S[D];
          for (int i = 0; i < D; ++i) T[i] = S[i] = Lanes::zero();
          const Lanes nearest = contact::sum_over_partners<Form, D>(
              law_, reach_, points.x_of(c), points.weight_of(c), rows.partners_of(c),
              rows.clusters_per_facet, others, T, S);
          at(result.nearest, k) =
              std::min(std::min(nearest[0], nearest[1]), std::min(nearest[2], nearest[3]));
          for (int i = 0; i < D; ++i) {
            at(result.T, c * D + i) = T[i];
            if (Form::moment) at(result.S, c * D + i) = S[i];
          }
        },
        4);
  }

  PairChange change(const ContactPlaces<D>& points, const ContactChanges<D>& changes,
                    const FacetRows<D>& rows, const ContactPlaces<D>& others,
                    const ContactChanges<D>& other_changes) const override {
    PairChange result{AlignedVector<Lanes>(points.x.size(), Lanes::zero()), {}, {}};
    if (Form::moment) result.S = result.dS = result.dT;
    parallel_for(
        static_cast<Index>(rows.clusters.size()),
        [&](Index k) {
          const Index c = at(rows.clusters, k);
          Dual<Lanes> t[D], s[D];
          for (int i = 0; i < D; ++i) t[i] = s[i] = 0.0;
          contact::sum_changes_over_partners<Form, D>(
              law_, reach_, points.x_of(c), changes.x_of(c), points.weight_of(c),
              &at(changes.weight, c * Form::components), rows.partners_of(c),
              rows.clusters_per_facet, others, other_changes, t, s);
          for (int i = 0; i < D; ++i) {
            at(result.dT, c * D + i) = t[i].d;
            if (!Form::moment) continue;
            at(result.S, c * D + i) = s[i].v;
            at(result.dS, c * D + i) = s[i].d;
          }
        },
        4);
    return result;
  }

  Real energy(const ContactPlaces<D>& points, Index c, const FacetRows<D>& rows,
              const ContactPlaces<D>& others) const override {
    Lanes T[D], S[1];
    T[0] = Lanes::zero();
    contact::sum_over_partners<Energy, D>(law_, reach_, points.x_of(c), points.weight_of(c),
                                          rows.partners_of(c), rows.clusters_per_facet, others, T,
                                          S);
    return sum(T[0]);
  }

 private:
  Law law_;
  Real reach_;
};

template <int D, PairKernel K>
std::unique_ptr<PairSums<D>> with_form(const ContactLaw& law, ContactForm form) {
  using namespace contact;
  const auto sums = [&]<class Form>() -> std::unique_ptr<PairSums<D>> {
    return std::make_unique<PairSumsOf<D, Form, Potential<D, Form::components>, PairLaw<K>>>(law);
  };
  switch (form) {
    case ContactForm::pressure:
      return sums.template operator()<Pressure<D>>();
    case ContactForm::volume:
      return sums.template operator()<Volume<D>>();
    case ContactForm::dissertation:
      return sums.template operator()<Dissertation<D>>();
    case ContactForm::energy:
      break;
  }
  return sums.template operator()<Energy<D>>();
}

}  // namespace

template <int D>
void PairEvaluation<D>::copy(const FacetRows<D>& rows, const ItemRange& part, bool back) {
  const std::size_t each = S.empty() ? D : 2 * D;
  for (Index k = part.begin; k < part.end; ++k) {
    Lanes* next = sent.data() + static_cast<std::size_t>(k) * each;
    for (AlignedVector<Lanes>* field : {&T, &S}) {
      if (field->empty()) continue;
      Lanes* const own = &at(*field, at(rows.clusters, k) * D);
      back ? std::copy_n(next, D, own) : std::copy_n(own, D, next);
      next += D;
    }
  }
}

template <int D>
Gathered PairEvaluation<D>::packed(const FacetRows<D>& rows, const Portions& shares) {
  const std::size_t each = S.empty() ? D : 2 * D;
  if (shares.are_sent()) {
    sent.resize(rows.clusters.size() * each);
    copy(rows, shares.own(), false);
  }
  return {sent.data(), shares, each};
}

template <int D>
void PairEvaluation<D>::take(const FacetRows<D>& rows, const Portions& shares) {
  if (!shares.are_sent()) return;
  const ItemRange own = shares.own();
  copy(rows, {0, own.begin}, true);
  copy(rows, {own.end, static_cast<Index>(rows.clusters.size())}, true);
}

template <int D>
std::unique_ptr<PairSums<D>> pair_sums(const ContactLaw& law, ContactForm form, bool revolved) {
  if (dimension_of(law.kernel) != D)
    throw InputError("the kernel of the contact has another dimension than the bodies");
  if constexpr (D == 3)
    return with_form<D, PairKernel::space>(law, form);
  else if (revolved && (law.kernel != PairKernel::integrated || form != ContactForm::energy))
    throw InputError("bodies of revolution touch by their energy in space alone");
  else if (revolved)
    return std::make_unique<PairSumsOf<D, contact::RingEnergy, contact::RingPotential, RingLaw>>(
        law);
  else if (law.kernel == PairKernel::planar)
    return with_form<D, PairKernel::planar>(law, form);
  else
    return with_form<D, PairKernel::integrated>(law, form);
}

template struct PairEvaluation<2>;
template struct PairEvaluation<3>;
template std::unique_ptr<PairSums<2>> pair_sums(const ContactLaw&, ContactForm, bool);
template std::unique_ptr<PairSums<3>> pair_sums(const ContactLaw&, ContactForm, bool);

}  // namespace meniscus
