// SPDX-License-Identifier: BSD-3-Clause
// Dead loads (tractions of fixed direction) on face cells.
#include "physics/loads/traction.hpp"

#include "body/surface/face_means.hpp"
#include "kernel/row_sums.hpp"
#include "numbers/dense.hpp"
#include "physics/loads/face_measures.hpp"

#include <algorithm>

namespace meniscus {
namespace {

template <int D>
class Traction final : public ForceTerm {
 public:
  Traction(const Body<D>& body, std::string label, FaceCells<D> cells,
           std::vector<Expression> force, const Ramp& ramp, Real factor)
      : body_(body),
        label_(std::move(label)),
        ramp_(ramp),
        factor_(factor),
        means_(cells, std::move(force)),
        cells_(std::move(cells)),
        force_(cells_.area.size(), Lanes::zero()) {}

  std::string name() const override { return "traction '" + label_ + "'"; }

  Report add_force(const Motion& motion, Forces force) override {
    evaluate(motion.time);
    NodalVector* own = force.data() + body_.first;
    Resultant all;
    for (Index k = 0; k < cells_.size(); ++k) {
      scatter_value(cells_.mean, k, at(force_, k), own);
      const Eigen::Vector3d f = spatial(at(force_, k));
      all += {f, cross(place(motion, k), f)};
    }
    Report report;
    report.outside = {all.force, all.moment};
    return report;
  }
  void add_tangent(const Motion&, const Motion&, Forces) override {}
  std::optional<Real> potential(const Motion& motion) override { return -power(motion, motion.u); }
  Real load_power(const Motion& motion) override { return power(motion, motion.v); }
  bool reads(StepReads& reads) override {
    reads.particles(cells_.mean.particle, body_.first);
    return true;
  }
  Real steady_after() const override { return std::max(means_.steady_after(), ramp_.end); }
  Real uncancelled_force(const Motion& motion) const override {
    Traction copy(*this);
    copy.evaluate(motion.time);
    Real sum = 0;
    for (const Lanes& f : copy.force_) sum += std::sqrt(meniscus::sum(f * f));
    return sum;
  }
  std::vector<MeasureSource> measures() const override {
    return face_measures(body_, cells_, [this](const Motion& motion) {
      Traction copy(*this);
      copy.evaluate(motion.time);
      Vec<D> sum = Vec<D>::Zero();
      for (Index k = 0; k < cells_.size(); ++k) sum += vector_at<D>(copy.force_, k);
      return sum;
    });
  }
  std::size_t bytes() const override { return cells_.mean.bytes() + means_.bytes(); }
  Offset pairs() const override { return cells_.mean.entries(); }

 private:
  /// Mean position of a face cell.
  Eigen::Vector3d place(const Motion& motion, Index k) const {
    return spatial<D>(at(cells_.centre, k)) +
           spatial(value_at(cells_.mean, k, motion.u.data() + body_.first));
  }
  /// Computes force_ at a time.
  void evaluate(Real time) {
    const std::vector<Real>& mean = means_.at(time);
    const Real fraction = factor_ * ramp_.fraction(time);
    for (Index k = 0; k < cells_.size(); ++k)
      set_vector<D>(force_, k,
                    Vec<D>(fraction * at(cells_.area, k) *
                           Vec<D>::Map(mean.data() + static_cast<std::size_t>(k) * D)));
  }
  /// The power: sum of f_A . field_A.
  Real power(const Motion& motion, std::span<const NodalVector> field) {
    evaluate(motion.time);
    const NodalVector* own = field.data() + body_.first;
    Real sum = 0;
    for (Index k = 0; k < cells_.size(); ++k)
      sum += meniscus::sum(at(force_, k) * value_at(cells_.mean, k, own));
    return sum;
  }

  const Body<D>& body_;
  std::string label_;
  Ramp ramp_;
  Real factor_;
  FaceMeans<D> means_;
  FaceCells<D> cells_;
  NodalVectors force_;  // force of each face cell
};

}  // namespace

template <int D>
std::unique_ptr<ForceTerm> traction(const Body<D>& body, std::string label, FaceCells<D> cells,
                                    std::vector<Expression> force, const Ramp& ramp, Real factor) {
  return std::make_unique<Traction<D>>(body, std::move(label), std::move(cells), std::move(force),
                                       ramp, factor);
}
template std::unique_ptr<ForceTerm> traction(const Body<2>&, std::string, FaceCells<2>,
                                             std::vector<Expression>, const Ramp&, Real);
template std::unique_ptr<ForceTerm> traction(const Body<3>&, std::string, FaceCells<3>,
                                             std::vector<Expression>, const Ramp&, Real);

}  // namespace meniscus
