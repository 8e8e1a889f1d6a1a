// SPDX-License-Identifier: BSD-3-Clause
// Body force of a drop: the gradient of the height of the centroid of the volume inside its
// patches.
#include "body/surface/surface_patches.hpp"
#include "numbers/dense.hpp"
#include "physics/loads/body_force.hpp"
#include "physics/surface/wall_report.hpp"

#include <numeric>

namespace meniscus {
namespace {

/// The potential is - M a . centroid, with the mass M of the body and the acceleration a(t).
template <int D>
class WeightOnPatches final : public ForceTerm {
 public:
  WeightOnPatches(const Body<D>& body, std::vector<Expression> acceleration)
      : body_(body),
        acceleration_(std::move(acceleration)),
        mass_(std::accumulate(body.mass_integral.begin(), body.mass_integral.end(), 0.0)),
        patches_(body) {
    const NodalVectors rest(static_cast<std::size_t>(body.size()), Lanes::zero());
    for (int i = 0; i < D; ++i) centre_[i] = patches_.height(Vec<D>::Unit(i), rest.data());
    for (const Expression& a : acceleration_)
      steady_after_ = std::max(steady_after_, a.steady_after());
  }

  std::string name() const override { return "body force on '" + body_.name + "'"; }

  Report add_force(const Motion& motion, Forces force) override {
    patches_.at_time(motion.time);
    patches_.place(own(motion.u));
    return force.gather(
        {patches_.places()}, motion,
        [this](const Motion& at_motion, const Forces& all) { return add_weight(at_motion, all); });
  }
  void add_tangent(const Motion& motion, const Motion& change, Forces force) override {
    patches_.at_time(motion.time);
    patches_.add_height_gradient_change(weight_at(motion.time), own(motion.u), own(change.u), 1,
                                        body_.part(force));
  }
  bool reads(StepReads& reads) override {
    patches_.list_reads(reads, body_.first);
    return true;
  }
  std::optional<Real> potential(const Motion& motion) override {
    patches_.at_time(motion.time);
    const Vec<D> weight = weight_at(motion.time);
    return weight.dot(centre_) - patches_.height(weight, own(motion.u));
  }
  Real steady_after() const override { return steady_after_; }
  Real load_power(const Motion& motion) override {
    patches_.at_time(motion.time);
    patches_.place(own(motion.u));
    GatherTogether()({{patches_.places()}});
    patches_.follow_height(weight_at(motion.time));
    return patches_.followed_change(own(motion.v));
  }
  std::size_t bytes() const override { return patches_.bytes(); }
  Offset pairs() const override { return patches_.pairs(); }

 private:
  /// Adds the force when the surface is placed.
  Report add_weight(const Motion& motion, Forces force) {
    patches_.follow_height(weight_at(motion.time));
    patches_.add_gradient(1, body_.part(force));
    ChunkTally<Eigen::Vector3d>& moments = patches_.followed_moments();
    return force.gather({moments.gathered()}, motion,
                        [this, &moments](const Motion& at_motion, const Forces& all) {
                          Report report;
                          report.outside = {spatial<D>(weight_at(at_motion.time)),
                                            moments.sum(Eigen::Vector3d::Zero())};
                          if (patches_.on_walls())
                            report += report_of_walls(patches_, -1, at_motion, all, 0);
                          return report;
                        });
  }
  const NodalVector* own(std::span<const NodalVector> field) const {
    return field.data() + body_.first;
  }
  Vec<D> weight_at(Real time) const {
    Vec<D> weight;
    for (int i = 0; i < D; ++i) weight[i] = mass_ * at(acceleration_, i)({0, 0, 0}, time);
    return weight;
  }

  const Body<D>& body_;
  std::vector<Expression> acceleration_;
  Real mass_;
  SurfacePatches<D> patches_;
  Vec<D> centre_;  // centroid in the reference
  Real steady_after_ = 0;
};

}  // namespace

template <int D>
std::unique_ptr<ForceTerm> weight_on_patches(const Body<D>& body,
                                             std::vector<Expression> acceleration) {
  return std::make_unique<WeightOnPatches<D>>(body, std::move(acceleration));
}
template std::unique_ptr<ForceTerm> weight_on_patches(const Body<2>&, std::vector<Expression>);
template std::unique_ptr<ForceTerm> weight_on_patches(const Body<3>&, std::vector<Expression>);

}  // namespace meniscus
