// SPDX-License-Identifier: BSD-3-Clause
// Springs and dampers on mean displacements.
#include "physics/loads/spring.hpp"

#include "kernel/row_sums.hpp"
#include "numbers/dense.hpp"
#include "physics/assembled_force.hpp"
#include "physics/point_elements.hpp"

#include <algorithm>

namespace meniscus {
namespace {

template <int D>
class Spring final : public ForceTerm, public AssembledForce {
 public:
  Spring(const Body<D>& body, std::string label, Springs<D> springs)
      : body_(body), label_(std::move(label)), springs_(std::move(springs)) {
    for (int i = 0; i < D; ++i) components_.set(i, springs_.components[i]);
    target_.resize(springs_.displacement.size());
    for (Index k = 0; k < size(); ++k) set_vector<D>(target_, k, at(springs_.displacement, k));
    NodalVectors X(static_cast<std::size_t>(body.size()));
    for (Index A = 0; A < body.size(); ++A) set_vector<D>(X, A, at(body.particles.X(), A));
    for (Index k = 0; k < size(); ++k) X_.push_back(value_at(springs_.mean, k, X.data()));
    viscous_ =
        std::any_of(springs_.damping.begin(), springs_.damping.end(), [](Real c) { return c > 0; });
  }

  std::string name() const override { return "spring '" + label_ + "'"; }
  std::string_view energy_kind() const override { return "spring"; }

  Report add_force(const Motion& motion, Forces force) override {
    Report report;
    const Real rate = springs_.ramp.rate(motion.time);
    for (Index k = 0; k < size(); ++k) {
      const Lanes pull = stretch(motion, k) * at(springs_.stiffness, k);
      report.external_power -= rate * sum(pull * at(target_, k));
      Lanes f = -pull;
      if (viscous_) {
        const Lanes v = mean(motion.v, k);
        f -= at(springs_.damping, k) * v;
        report.heat += at(springs_.damping, k) * sum(v * v);
      }
      scatter(k, f, force);
      const Lanes x = at(X_, k) + value_at(springs_.mean, k, motion.u.data() + body_.first);
      report.outside += Resultant(spatial(f), cross(spatial(x), spatial(f)));
    }
    return report;
  }
  void add_tangent(const Motion&, const Motion& change, Forces force) override {
    for (Index k = 0; k < size(); ++k)
      scatter(k,
              -at(springs_.stiffness, k) * mean(change.u, k) -
                  at(springs_.damping, k) * mean(change.v, k),
              force);
  }
  void announce(StiffnessMatrix& K) override {
    std::vector<std::vector<Index>> each;
    for (Index k = 0; k < size(); ++k) each.push_back({k});
    elements_.announce(springs_.mean, std::move(each), body_.first, K);
  }
  void add_stiffness(const Motion&, std::span<const Lanes>, StiffnessMatrix& K) override {
    if (!K.is_here()) return;
    elements_.add(springs_.mean, K, [&](Index k, Eigen::MatrixXd& stiffness) {
      for (int i = 0; i < D; ++i)
        stiffness(i, i) = at(springs_.stiffness, k) * springs_.components[i];
    });
  }

  bool viscous() const override { return viscous_; }
  void add_viscous(const Motion& motion, Forces force) override {
    for (Index k = 0; k < size(); ++k)
      scatter(k, -at(springs_.damping, k) * mean(motion.v, k), force);
  }
  void add_viscous_diagonal(Forces diagonal) override {
    for (Index k = 0; k < size(); ++k)
      for (Offset e = at(springs_.mean.start, k); e < at(springs_.mean.start, k + 1); ++e) {
        const Lanes C = shape_at(springs_.mean, e);
        at(diagonal, body_.first + at(springs_.mean.particle, e)) +=
            at(springs_.damping, k) * C * C * components_;
      }
  }
  std::optional<Real> stored_energy(const Motion& motion) const override {
    Real energy = 0;
    for (Index k = 0; k < size(); ++k) {
      const Lanes s = stretch(motion, k);
      energy += at(springs_.stiffness, k) / 2 * sum(s * s);
    }
    return energy;
  }
  bool reads(StepReads& reads) override {
    reads.particles(springs_.mean.particle, body_.first);
    return true;
  }
  Real steady_after() const override { return springs_.ramp.end; }
  bool stops_drift() const override { return true; }
  Real uncancelled_force(const Motion& motion) const override {
    Real total = 0;
    for (Index k = 0; k < size(); ++k) {
      const Lanes s = stretch(motion, k);
      total += at(springs_.stiffness, k) * std::sqrt(sum(s * s));
    }
    return total;
  }
  std::vector<MeasureSource> measures() const override {
    std::vector<MeasureSource> measures;
    for (int i = body_.geometry.grid.revolved ? 1 : 0; i < D; ++i)
      measures.push_back({std::string("force_") + "xyz"[i], of_sum(dimension::force, D),
                          "sum of the forces of the springs on the body",
                          [this, i](const Motion& motion) {
                            Real total = 0;
                            for (Index k = 0; k < size(); ++k)
                              total -= at(springs_.stiffness, k) * stretch(motion, k)[i];
                            return total;
                          }});
    return measures;
  }
  std::size_t bytes() const override { return springs_.mean.bytes(); }
  Offset pairs() const override { return springs_.mean.entries(); }

 private:
  Index size() const { return springs_.mean.size(); }
  Lanes mean(std::span<const NodalVector> field, Index k) const {
    return components_ * value_at(springs_.mean, k, field.data() + body_.first);
  }
  /// The extension u - g of a spring.
  Lanes stretch(const Motion& motion, Index k) const {
    return mean(motion.u, k) - springs_.ramp.fraction(motion.time) * (components_ * at(target_, k));
  }
  void scatter(Index k, const Lanes& f, std::span<NodalVector> force) const {
    scatter_value(springs_.mean, k, f, force.data() + body_.first);
  }

  const Body<D>& body_;
  std::string label_;
  Springs<D> springs_;
  NodalVectors target_, X_;
  Lanes components_ = Lanes::zero();
  MeanElements<D> elements_;
  bool viscous_ = false;
};

}  // namespace

template <int D>
std::unique_ptr<ForceTerm> spring(const Body<D>& body, std::string label, Springs<D> springs) {
  return std::make_unique<Spring<D>>(body, std::move(label), std::move(springs));
}
template std::unique_ptr<ForceTerm> spring(const Body<2>&, std::string, Springs<2>);
template std::unique_ptr<ForceTerm> spring(const Body<3>&, std::string, Springs<3>);

}  // namespace meniscus
