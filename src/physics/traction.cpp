// SPDX-License-Identifier: BSD-3-Clause
// Tractions on face cells.
#include "meniscus/physics/traction.hpp"

#include "meniscus/approx/row_sums.hpp"
#include "meniscus/body/face_means.hpp"
#include "meniscus/core/dense.hpp"

#include <limits>

namespace meniscus {
namespace {

/// cof F, by which areas turn and grow.
template <int D>
Mat<D> cofactors(const Mat<D>& F) {
  Mat<D> C;
  if constexpr (D == 3) {
    C.col(0) = cross(F.col(1), F.col(2));
    C.col(1) = cross(F.col(2), F.col(0));
    C.col(2) = cross(F.col(0), F.col(1));
  } else {
    C << F(1, 1), -F(1, 0), -F(0, 1), F(0, 0);
  }
  return C;
}

/// Its change with dF; it is of degree D - 1.
template <int D>
Mat<D> change_of_cofactors(const Mat<D>& F, const Mat<D>& dF) {
  return 0.5 * (cofactors<D>(F + dF) - cofactors<D>(F - dF));
}

template <int D>
class Traction final : public ForceTerm {
 public:
  Traction(const Body<D>& body, std::string label, FaceCells<D> cells, const TractionLoad& load)
      : body_(body),
        label_(std::move(label)),
        dead_(!load.force.empty()),
        ramp_(load.ramp),
        means_(cells, dead_ ? load.force : std::vector<Expression>{load.pressure}),
        cells_(std::move(cells)),
        force_(cells_.area.size(), Lanes::zero()),
        thrust_(dead_ ? 0 : cells_.area.size()) {}

  std::string name() const override { return "traction '" + label_ + "'"; }

  Report add_force(const Motion& motion, Forces force) override {
    evaluate(motion);
    scatter(force);
    return {};
  }
  void add_tangent(const Motion& motion, const Motion& change, Forces force) override {
    if (dead_) return;
    const std::vector<Real>& p = means_.at(motion.time);
    for (Index k = 0; k < cells_.size(); ++k) {
      const Mat<D> F = Mat<D>::Identity() + gradient(motion.u, k), dF = gradient(change.u, k);
      set_thrust(k, ramp_.fraction(motion.time) * at(p, k), change_of_cofactors<D>(F, dF));
    }
    scatter(force);
  }
  std::optional<Real> potential(const Motion& motion) override {
    if (!dead_) return std::nullopt;
    return -power(motion, motion.u);
  }
  Real load_power(const Motion& motion) override { return power(motion, motion.v); }
  bool tell_reads(StepReads& reads) override {
    reads.particles(cells_.mean.particle, body_.first);
    return true;
  }
  Real steady_after() const override {
    return means_.change() ? std::numeric_limits<Real>::infinity() : ramp_.end;
  }
  Real uncancelled_force(const Motion& motion) const override {
    Traction copy(*this);
    copy.evaluate(motion);
    Real sum = 0;
    for (const Lanes& f : copy.force_) sum += std::sqrt(meniscus::sum(f * f));
    return sum;
  }
  std::vector<MeasureSource> measures() const override {
    std::vector<MeasureSource> measures;
    for (int i = 0; i < D; ++i) {
      measures.push_back({std::string("force_") + "xyz"[i], of_sum(dimension::force, D),
                          "sum of the forces of the traction", [this, i](const Motion& motion) {
                            Traction copy(*this);
                            copy.evaluate(motion);
                            Real sum = 0;
                            for (const Lanes& f : copy.force_) sum += f[i];
                            return sum;
                          }});
      measures.push_back({std::string("displacement_") + "xyz"[i], dimension::length,
                          "mean over the face", [this, i](const Motion& motion) {
                            const NodalVector* u = motion.u.data() + body_.first;
                            Real sum = 0;
                            for (Index k = 0; k < cells_.size(); ++k)
                              sum += at(cells_.area, k) * value_at(cells_.mean, k, u)[i];
                            return sum / cells_.total_area();
                          }});
    }
    return measures;
  }
  std::size_t bytes() const override {
    return cells_.mean.bytes() + means_.bytes() + cells_.directed.size() * sizeof(Vec<D>) +
           thrust_.size() * sizeof(Mat<D>);
  }
  Offset pairs() const override { return cells_.mean.entries(); }

 private:
  Mat<D> gradient(std::span<const NodalVector> field, Index k) const {
    const auto column = gradient_at(cells_.mean, k, field.data() + body_.first);
    Mat<D> H;
    for (int K = 0; K < D; ++K)
      for (int i = 0; i < D; ++i) H(i, K) = at(column, K)[i];
    return H;
  }
  /// Of a pressure on the face cell k with these cofactors.
  void set_thrust(Index k, Real pressure, const Mat<D>& cofactors) {
    at(thrust_, k) = -pressure * at(cells_.area, k) * cofactors;
    set_vector<D>(force_, k, Vec<D>(at(thrust_, k) * at(cells_.normal, k)));
  }
  /// force_ and thrust_ at a motion.
  void evaluate(const Motion& motion) {
    const std::vector<Real>& mean = means_.at(motion.time);
    const Real fraction = ramp_.fraction(motion.time);
    for (Index k = 0; k < cells_.size(); ++k) {
      if (dead_)
        set_vector<D>(force_, k,
                      Vec<D>(fraction * at(cells_.area, k) *
                             Vec<D>::Map(mean.data() + static_cast<std::size_t>(k) * D)));
      else
        set_thrust(k, fraction * at(mean, k),
                   cofactors<D>(Mat<D>::Identity() + gradient(motion.u, k)));
    }
  }
  void scatter(std::span<NodalVector> force) const {
    NodalVector* own = force.data() + body_.first;
    for (Index k = 0; k < cells_.size(); ++k)
      if (dead_)
        scatter_value(cells_.mean, k, at(force_, k), own);
      else
        for (Offset e = at(cells_.mean.start, k); e < at(cells_.mean.start, k + 1); ++e)
          own[at(cells_.mean.particle, e)] += directed_thrust(k, e);
  }
  /// On the particle of an entry of face cell k.
  NodalVector directed_thrust(Index k, Offset entry) const {
    const Vec<D> f = at(thrust_, k) * at(cells_.directed, entry);
    NodalVector lanes = NodalVector::zero();
    for (int i = 0; i < D; ++i) lanes.set(i, f[i]);
    return lanes;
  }
  /// sum of f_A . field_A.
  Real power(const Motion& motion, std::span<const NodalVector> field) {
    evaluate(motion);
    const NodalVector* own = field.data() + body_.first;
    Real sum = 0;
    for (Index k = 0; k < cells_.size(); ++k)
      if (dead_)
        sum += meniscus::sum(at(force_, k) * value_at(cells_.mean, k, own));
      else
        for (Offset e = at(cells_.mean.start, k); e < at(cells_.mean.start, k + 1); ++e)
          sum += meniscus::sum(directed_thrust(k, e) * own[at(cells_.mean.particle, e)]);
    return sum;
  }

  const Body<D>& body_;
  std::string label_;
  bool dead_;
  Ramp ramp_;
  FaceMeans<D> means_;
  FaceCells<D> cells_;
  NodalVectors force_;          // of each face cell
  std::vector<Mat<D>> thrust_;  // of a pressure: force_ = thrust N
};

}  // namespace

template <int D>
std::unique_ptr<ForceTerm> traction(const Body<D>& body, std::string label, FaceCells<D> cells,
                                    const TractionLoad& load) {
  return std::make_unique<Traction<D>>(body, std::move(label), std::move(cells), load);
}
template std::unique_ptr<ForceTerm> traction(const Body<2>&, std::string, FaceCells<2>,
                                             const TractionLoad&);
template std::unique_ptr<ForceTerm> traction(const Body<3>&, std::string, FaceCells<3>,
                                             const TractionLoad&);

}  // namespace meniscus
