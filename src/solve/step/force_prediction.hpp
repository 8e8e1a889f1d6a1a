// SPDX-License-Identifier: BSD-3-Clause
// The forces of the step to come, from those of the steps before.
#pragma once
#include "parallel/step_reads.hpp"
#include "state/archive.hpp"

#include <array>
#include <vector>

namespace meniscus {

/// (performance note 4.1) With f_n and its differences of first and second order,
///   f_n+1 = f_n + b_0 f_n + b_1 (f_n - f_n-1) + b_2 (f_n - 2 f_n-1 + f_n-2),
/// the numbers b being those that would have predicted f_n best, by least squares of the
/// accelerations: smooth motion is extrapolated (b = 0, 1, 1), what rings is damped. None where
/// they predict f_n badly, as after a jump, or the length of steps has changed considerably.
class ForcePrediction {
 public:
  explicit ForcePrediction(std::size_t particles);

  using SharedHalo = std::shared_ptr<const Halo>;

  /// f_n+1, after a step of dt, to `next` by `now`, f_n, of the particles that are followed. This
  /// becomes a force of the past with step_stands() only.
  void predict(const NodalVectors& now, Real dt, const std::vector<Real>& mass, NodalVectors& next,
               const SharedHalo& halo = {});
  void step_stands();
  void tell_reads(StepReads& reads);
  void archive(const Archive& a, int components);

 private:
  static constexpr int order = 3;
  Eigen::Vector3d best(const std::vector<Real>& mass, const SharedHalo& halo) const;

  std::array<NodalVectors, order + 1> f_;  // f_n, f_n-1, f_n-2, f_n-3
  std::int64_t known_ = 0;                 // of those before f_n
  Real dt_ = 0, tried_dt_ = 0;             // the last step that stands, and the last one
};

}  // namespace meniscus
