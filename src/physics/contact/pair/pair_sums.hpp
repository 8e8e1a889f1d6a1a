// SPDX-License-Identifier: BSD-3-Clause
// The sums of contact over pairs of points, compiled for each form and kernel.
#pragma once
#include "numbers/dual.hpp"
#include "parallel/gathered.hpp"
#include "physics/contact/contact_terms.hpp"
#include "physics/contact/pair/facet_pairs.hpp"

#include <memory>
#include <vector>

namespace meniscus {

/// Forces on the points of one body.
template <int D>
struct PairEvaluation {
  AlignedVector<Lanes> T, S;  ///< [cluster][i], as in contact_forms.hpp
  std::vector<Real> nearest;  ///< [k of rows.clusters] smallest squared distance
  AlignedVector<Lanes> sent;  ///< work space: T and S, [k of rows.clusters][i]

  PairEvaluation(Index clusters, bool moment) {
    T.assign(static_cast<std::size_t>(clusters) * D, Lanes::zero());
    if (moment) S = T;
    nearest.reserve(static_cast<std::size_t>(clusters));
  }
  std::size_t bytes() const { return (T.size() + S.size() + sent.size()) * sizeof(Lanes); }

  /// Packs the results of this share for other processes; they are complete after take().
  Gathered packed(const FacetRows<D>& rows, const Portions& shares);
  Gathered nearest_of(const Portions& shares) { return {nearest.data(), shares}; }
  void take(const FacetRows<D>& rows, const Portions& shares);

 private:
  /// Copies T and S of these clusters to `sent`, or back.
  void copy(const FacetRows<D>& rows, const ItemRange& part, bool back);
};

/// Changes of T, and S with its changes, for the points of one body; [cluster][i].
struct PairChange {
  AlignedVector<Lanes> dT, S, dS;
};

template <int D>
class PairSums {
 public:
  virtual ~PairSums() = default;
  /// True if the form has S.
  virtual bool moment() const = 0;
  /// True if the force is minus the gradient of the energy.
  virtual bool conservative() const = 0;
  /// Forces of `others` on `points`, whose partners are in `rows`: on the share of this process in
  /// rows.clusters.
  virtual void evaluate(const ContactPlaces<D>& points, const FacetRows<D>& rows,
                        const ContactPlaces<D>& others, const ItemRange& share,
                        PairEvaluation<D>& result) const = 0;
  virtual PairChange change(const ContactPlaces<D>& points, const ContactChanges<D>& changes,
                            const FacetRows<D>& rows, const ContactPlaces<D>& others,
                            const ContactChanges<D>& other_changes) const = 0;
  /// Potential energy of a cluster of the points.
  virtual Real energy(const ContactPlaces<D>& points, Index cluster, const FacetRows<D>& rows,
                      const ContactPlaces<D>& others) const = 0;
};

/// Throws InputError if the kernel of the law has another dimension. `revolved`: points are circles
/// about the axis x = 0, which have the kernel `integrated` and the form `energy`.
template <int D>
std::unique_ptr<PairSums<D>> pair_sums(const ContactLaw& law, ContactForm form, bool revolved);

}  // namespace meniscus
