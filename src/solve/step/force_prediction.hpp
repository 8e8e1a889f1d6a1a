// SPDX-License-Identifier: BSD-3-Clause
// Predicts the forces of the next step from the forces of earlier steps.
#pragma once
#include "parallel/followed_particles.hpp"
#include "state/archive.hpp"

#include <array>
#include <vector>

namespace meniscus {

/// The prediction (performance note 4.1) from f_n and its first and second differences:
///   f_n+1 = f_n + b_0 f_n + b_1 (f_n - f_n-1) + b_2 (f_n - 2 f_n-1 + f_n-2).
/// The b are the coefficients that would have predicted f_n best, by least squares of the
/// accelerations. Smooth motion is thus extrapolated (b = 0, 1, 1), and vibrations are damped. The
/// prediction is f_n itself if f_n is predicted badly, as after a jump, or if the step has changed
/// considerably.
class ForcePrediction {
 public:
  explicit ForcePrediction(std::size_t particles);

  /// Predicts f_n+1 into `next`, from `now` = f_n after a step of dt, for followed particles. `now`
  /// is kept for later predictions only when step_stands() is called.
  void predict(const NodalVectors& now, Real dt, const std::vector<Real>& mass, NodalVectors& next,
               const FollowedParticles& particles = {});
  void step_stands();
  void list_reads(StepReads& reads);
  void archive(const Archive& a, int components);

 private:
  static constexpr int order = 3;
  Eigen::Vector3d best(const std::vector<Real>& mass, const FollowedParticles& particles) const;

  std::array<NodalVectors, order + 1> f_;  // f_n, f_n-1, f_n-2, f_n-3
  std::int64_t known_ = 0;                 // number of known forces before f_n
  Real dt_ = 0, tried_dt_ = 0;             // last accepted step, last tried step
};

}  // namespace meniscus
