// SPDX-License-Identifier: BSD-3-Clause
// Forces on particles, computed by a function of the caller.
#include "run/particle_force.hpp"

#include "kernel/row_sums.hpp"
#include "meniscus/error.hpp"
#include "meniscus/scene/assembly.hpp"
#include "numbers/dense.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace meniscus {
namespace {

template <int D>
class ParticleForce final : public ForceTerm {
 public:
  ParticleForce(const Body<D>& body, ForceFunction function)
      : body_(body),
        function_(std::move(function)),
        sums_(body.chunk_sums(body.at_particles.start, body.at_particles.particle)),
        outside_(body.template tally<Resultant>()) {
    for (std::vector<Real>* values : {&x_, &v_, &last_x_, &force_})
      values->assign(static_cast<std::size_t>(body.size()) * D, 0);
  }

  std::string name() const override { return "force function on '" + body_.name + "'"; }

  Report add_force(const Motion& motion, Forces force) override {
    Report report;
    report.failure = compute(motion);
    if (report.failure) return report;
    sums_.accumulate(body_.part(force), [&](int, Index begin, Index end, NodalVector* f) {
      for (Index A = begin; A < end; ++A) scatter_value(body_.at_particles, A, force_at(A), f);
    });
    body_.for_chunks([&](int chunk, Index begin, Index end) {
      Resultant sum;
      for (Index A = begin; A < end; ++A) {
        const Eigen::Vector3d f = spatial(force_at(A)), x = spatial(vector_at(last_x_, A));
        sum += Resultant(f, cross(x, f));
      }
      outside_[chunk] = sum;
    });
    report.outside = outside_.sum(Resultant());
    return report;
  }
  Real load_power(const Motion& motion) override {
    find_positions(motion);
    if (motion.time != last_time_ || x_ != last_x_)
      if (const auto failure = compute(motion)) throw SolveError(failure->cause);
    return body_.sum_over_rows(body_.size(), 0.0, [&](Index A) {
      return sum(force_at(A) * value_at(body_.at_particles, A, motion.v.data() + body_.first));
    });
  }
  Real uncancelled_force(const Motion&) const override {
    return body_.sum_over_rows(body_.size(), 0.0,
                               [&](Index A) { return std::sqrt(sum(force_at(A) * force_at(A))); });
  }
  std::size_t bytes() const override {
    return (x_.size() + v_.size() + last_x_.size() + force_.size()) * sizeof(Real) + sums_.bytes();
  }

 private:
  static Lanes vector_at(const std::vector<Real>& values, Index A) {
    Lanes vector = Lanes::zero();
    for (int i = 0; i < D; ++i) vector.set(i, at(values, A * D + i));
    return vector;
  }
  Lanes force_at(Index A) const { return vector_at(force_, A); }

  void find_positions(const Motion& motion) {
    body_.for_chunks([&](int, Index begin, Index end) {
      for (Index A = begin; A < end; ++A) {
        const Lanes u = value_at(body_.at_particles, A, motion.u.data() + body_.first);
        for (int i = 0; i < D; ++i) at(x_, A * D + i) = at(body_.particles.X(), A)[i] + u[i];
      }
    });
  }

  /// Calls the function at a motion. Returns the failure if there is no valid force.
  std::optional<Failure> compute(const Motion& motion) {
    find_positions(motion);
    body_.for_chunks([&](int, Index begin, Index end) {
      for (Index A = begin; A < end; ++A) {
        const Lanes v = value_at(body_.at_particles, A, motion.v.data() + body_.first);
        for (int i = 0; i < D; ++i) at(v_, A * D + i) = v[i];
      }
    });
    last_time_ = motion.time;
    last_x_ = x_;
    std::fill(force_.begin(), force_.end(), 0.0);
    try {
      function_(motion.time, x_, v_, force_);
    } catch (const SolveError& error) {
      return Failure{-1, error.what()};
    }
    const auto wrong = std::find_if(force_.begin(), force_.end(),
                                    [](Real component) { return !std::isfinite(component); });
    if (wrong == force_.end()) return std::nullopt;
    const auto A = static_cast<Index>((wrong - force_.begin()) / D);
    return Failure{body_.first + A, fmt::format("the force on the particle is {}", *wrong)};
  }

  const Body<D>& body_;
  ForceFunction function_;
  ChunkSums sums_;
  ChunkTally<Resultant> outside_;
  std::vector<Real> x_, v_;           ///< [particle][component], arguments of the function
  std::vector<Real> last_x_, force_;  ///< of the last call
  Real last_time_ = -unbounded;
};

template <int D>
class ParticleForceLoad final : public Load<D> {
 public:
  ParticleForceLoad(std::string body, ForceFunction function)
      : body_(std::move(body)), function_(std::move(function)) {}
  void check(const Block&, const BodyPlans<D>&) const override {}
  void build(Assembly<D>& assembly) const override {
    assembly.add(std::make_unique<ParticleForce<D>>(assembly.body(body_), function_), body_);
  }

 private:
  std::string body_;
  ForceFunction function_;
};

}  // namespace

template <int D>
std::unique_ptr<const Load<D>> particle_force(const std::string& body, ForceFunction function) {
  return std::make_unique<ParticleForceLoad<D>>(body, std::move(function));
}
template std::unique_ptr<const Load<2>> particle_force(const std::string&, ForceFunction);
template std::unique_ptr<const Load<3>> particle_force(const std::string&, ForceFunction);

}  // namespace meniscus
