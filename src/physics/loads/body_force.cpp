// SPDX-License-Identifier: BSD-3-Clause
// Body forces: accelerations given by formulas, times masses.
#include "physics/loads/body_force.hpp"

#include "numbers/dense.hpp"

#include <algorithm>

namespace meniscus {
namespace {

template <int D>
class BodyForce final : public ForceTerm {
 public:
  BodyForce(const Body<D>& body, const std::vector<Real>& mass,
            std::vector<Expression> acceleration)
      : body_(body),
        mass_(mass),
        acceleration_(std::move(acceleration)),
        load_(mass.size()),
        outside_(body.template tally<Resultant>()) {
    for (const Expression& a : acceleration_) {
      steady_ = steady_ && !a.depends_on_time();
      steady_after_ = std::max(steady_after_, a.steady_after());
    }
  }

  std::string name() const override { return "body force on '" + body_.name + "'"; }

  Report add_force(const Motion& motion, Forces force) override {
    evaluate(motion.time);
    for (Index A = 0; A < body_.size(); ++A) at(force, body_.first + A) += at(load_, A);
    body_.for_chunks([&](int chunk, Index begin, Index end) {
      Resultant sum;
      for (Index A = begin; A < end; ++A) {
        const Eigen::Vector3d f = spatial(at(load_, A)), X = spatial<D>(at(body_.particles.X(), A));
        sum = sum + Resultant(f, cross(X + spatial(at(motion.u, body_.first + A)), f));
      }
      outside_[chunk] = sum;
    });
    return force.gather({outside_.gathered()}, motion, [this](const Motion&, const Forces&) {
      const Resultant all = outside_.sum(Resultant());
      Report report;
      report.outside = {all.force, all.moment};
      return report;
    });
  }
  void add_tangent(const Motion&, const Motion&, Forces) override {}  // a constant force
  bool reads(StepReads& reads) override {
    const ItemRange own = body_.own_particles();
    reads.range(body_.first + own.begin, body_.first + own.end);
    return true;
  }
  std::optional<Real> potential(const Motion& motion) override {
    evaluate(motion.time);
    return -parallel_sum(body_.size(), 0.0, [&](Index A) {
      return sum(at(load_, A) * at(motion.u, body_.first + A));
    });
  }
  Real steady_after() const override { return steady_after_; }
  Real load_power(const Motion& motion) override {
    evaluate(motion.time);
    return body_.sum_over_rows(body_.size(), 0.0, [&](Index A) {
      return sum(at(load_, A) * at(motion.v, body_.first + A));
    });
  }
  std::size_t bytes() const override { return load_.size() * sizeof(Lanes); }

 private:
  /// Computes load_ at a time, unless it is known from the last call.
  void evaluate(Real time) {
    if (time == evaluated_at_ || (steady_ && evaluated_at_ > never)) return;
    for (Index A = 0; A < body_.size(); ++A) {
      const Eigen::Vector3d X = spatial<D>(body_.origin(A));
      at(load_, A) = Lanes::zero();
      for (int i = 0; i < D; ++i) at(load_, A).set(i, at(mass_, A) * at(acceleration_, i)(X, time));
    }
    evaluated_at_ = time;
  }

  const Body<D>& body_;
  const std::vector<Real>& mass_;
  std::vector<Expression> acceleration_;
  NodalVectors load_;
  ChunkTally<Resultant> outside_;
  bool steady_ = true;  // at all times
  Real steady_after_ = 0;
  static constexpr Real never = -unbounded;
  Real evaluated_at_ = never;
};

}  // namespace

template <int D>
std::unique_ptr<ForceTerm> body_force(const Body<D>& body, const std::vector<Real>& mass,
                                      std::vector<Expression> acceleration) {
  return std::make_unique<BodyForce<D>>(body, mass, std::move(acceleration));
}
template std::unique_ptr<ForceTerm> body_force(const Body<2>&, const std::vector<Real>&,
                                               std::vector<Expression>);
template std::unique_ptr<ForceTerm> body_force(const Body<3>&, const std::vector<Real>&,
                                               std::vector<Expression>);

}  // namespace meniscus
