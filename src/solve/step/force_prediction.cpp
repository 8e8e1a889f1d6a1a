// SPDX-License-Identifier: BSD-3-Clause
// Predicts the next force from past forces by least squares.
#include "solve/step/force_prediction.hpp"

#include "solve/state.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace meniscus {
namespace {

/// The latest of three successive forces, its change, and the change of that change. `a` is the
/// latest.
std::array<Lanes, 3> differences(Lanes a, Lanes b, Lanes c) {
  return {a, a - b, (a - b) - (b - c)};
}

/// Sums of a least-squares problem: products of the differences with each other (`matrix`) and with
/// the predicted quantity (`side`), and the square of that quantity.
struct Products {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  Eigen::Vector3d side = Eigen::Vector3d::Zero();
  Real square = 0;
  friend Products operator+(const Products& a, const Products& b) {
    return {a.matrix + b.matrix, a.side + b.side, a.square + b.square};
  }
};

/// Solves S x = b by Cholesky factorisation. S is positive definite.
Eigen::Vector3d solve(const Eigen::Matrix3d& S, const Eigen::Vector3d& b) {
  Eigen::Matrix3d L = Eigen::Matrix3d::Zero();
  Eigen::Vector3d x;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j <= i; ++j) {
      Real rest = S(i, j);
      for (int k = 0; k < j; ++k) rest -= L(i, k) * L(j, k);
      L(i, j) = i == j ? std::sqrt(rest) : rest / L(j, j);
    }
    x[i] = b[i];
    for (int k = 0; k < i; ++k) x[i] -= L(i, k) * x[k];
    x[i] /= L(i, i);
  }
  for (int i = 2; i >= 0; --i) {
    for (int k = i + 1; k < 3; ++k) x[i] -= L(k, i) * x[k];
    x[i] /= L(i, i);
  }
  return x;
}

}  // namespace

ForcePrediction::ForcePrediction(std::size_t particles) {
  f_.fill(NodalVectors(particles, Lanes::zero()));
}

/// The best coefficients b. A difference that is nearly a combination of the others, or is unknown,
/// has the coefficient 0.
Eigen::Vector3d ForcePrediction::best(const std::vector<Real>& mass,
                                      const FollowedParticles& particles) const {
  const auto n = static_cast<Index>(mass.size());
  const Products all = particles.sum(n, Products{}, [&](Index A) {
    const auto d = differences(at(f_[1], A), at(f_[2], A), at(f_[3], A));
    const Lanes missing = at(f_[0], A) - at(f_[1], A);
    Products p;
    for (int i = 0; i < known_; ++i) {
      for (int j = 0; j <= i; ++j)
        p.matrix(i, j) = p.matrix(j, i) = sum(at(d, i) * at(d, j)) / at(mass, A);
      p.side[i] = sum(at(d, i) * missing) / at(mass, A);
    }
    p.square = sum(missing * missing) / at(mass, A);
    return p;
  });
  constexpr Real nearly = 1e-8, least_share = 0.5, most = 4;
  Eigen::Vector3d scale;
  for (int i = 0; i < order; ++i)
    scale[i] = all.matrix(i, i) > 0 ? 1 / std::sqrt(all.matrix(i, i)) : 0;
  Eigen::Matrix3d matrix = scale.asDiagonal() * all.matrix * scale.asDiagonal();
  for (int i = 0; i < order; ++i) matrix(i, i) = 1 + nearly;
  const Eigen::Vector3d side = scale.cwiseProduct(all.side);
  const Eigen::Vector3d b = scale.cwiseProduct(solve(matrix, side));
  const bool good = all.side.dot(b) > least_share * all.square && b.cwiseAbs().maxCoeff() < most;
  return good ? b : Eigen::Vector3d(Eigen::Vector3d::Zero());
}

void ForcePrediction::predict(const NodalVectors& now, Real dt, const std::vector<Real>& mass,
                              NodalVectors& next, const FollowedParticles& particles) {
  constexpr Real considerably = 1.3;
  const auto n = static_cast<Index>(now.size());
  particles.for_each(n, [&](Index begin, Index end) {
    std::copy(now.begin() + begin, now.begin() + end, f_[0].begin() + begin);
  });
  tried_dt_ = dt;
  if (dt > considerably * dt_ || dt < dt_ / considerably) known_ = 0;
  const Eigen::Vector3d b = best(mass, particles);
  particles.for_each(n, [&](Index begin, Index end) {
    for (Index A = begin; A < end; ++A) {
      const auto d = differences(at(f_[0], A), at(f_[1], A), at(f_[2], A));
      at(next, A) = at(now, A) + b[0] * d[0] + b[1] * d[1] + b[2] * d[2];
    }
  });
}

void ForcePrediction::step_stands() {
  std::rotate(f_.begin(), f_.end() - 1, f_.end());
  known_ = std::min<std::int64_t>(known_ + 1, order);
  dt_ = tried_dt_;
}

void ForcePrediction::list_reads(StepReads& reads) {
  for (NodalVectors& f : f_) reads.keeps(f);
}

void ForcePrediction::archive(const Archive& a, int components) {
  a("past_forces", known_);
  a("past_step", dt_, dimension::time);
  require_saved(known_ >= 0 && known_ <= order && dt_ >= 0, a, "past_forces");
  for (std::size_t k = 1; k <= order; ++k) a("force_" + std::to_string(k), f_[k], components);
}

}  // namespace meniscus
