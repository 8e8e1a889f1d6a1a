// SPDX-License-Identifier: BSD-3-Clause
// Branches of Maxwell against their equations in the present configuration, moduli of small
// oscillations, energy and heat, and bodies in load steps and in motion.
#include "cases.hpp"
#include "physics/internal/maxwell_branches.hpp"
#include "physics/internal/viscoelasticity.hpp"
#include "solved.hpp"
#include "support.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>

namespace meniscus::test_viscoelasticity {
namespace {

using Matrix = Eigen::Matrix3d;
using Path = std::function<Matrix(Real time)>;  // F - I

const std::vector<MaxwellBranch> branches{{0.7, 0.3}, {0.4, 5}};

Tensor<Lanes> lanes(const Matrix& x) {
  return Tensor<Lanes>::map([&](int i, int j) { return Lanes(x(i, j)); });
}
Matrix first_lane(const Tensor<Lanes>& x) {
  Matrix m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m(i, j) = x(i, j)[0];
  return m;
}

MaxwellPoints one_group(std::vector<MaxwellBranch> of = branches) {
  return {std::move(of), 1, Division()};
}

/// A motion that shears, stretches and changes the volume.
Matrix winding(Real t) {
  Matrix H = Matrix::Zero();
  H(0, 1) = 0.8 * std::sin(2 * t);
  H(1, 1) = 0.3 * t;
  H(2, 0) = 0.2 * t * t;
  H(2, 2) = -0.15 * std::sin(3 * t);
  return H;
}

/// The stress P of one branch, whose conformation b = F' A F'^T follows the upper-convected
/// equation db/dt = l b + b l^T - (b - I)/time with the deviator l of the velocity gradient. By
/// many steps of Runge and Kutta.
Matrix stress_by_conformation(const MaxwellBranch& branch, const Path& path, Real end) {
  constexpr int steps = 4000;
  constexpr Real d = 1e-5;
  const auto rate = [&](Real t, const Matrix& b) -> Matrix {
    const Matrix F = Matrix::Identity() + path(t);
    Matrix l = (path(t + d) - path(t - d)) / (2 * d) * F.inverse();
    l -= Matrix::Identity() * (l.trace() / 3);
    return l * b + b * l.transpose() - (b - Matrix::Identity()) / branch.time;
  };
  Matrix b = Matrix::Identity();
  const Real h = end / steps;
  for (int k = 0; k < steps; ++k) {
    const Real t = k * h;
    const Matrix r1 = rate(t, b), r2 = rate(t + h / 2, b + h / 2 * r1),
                 r3 = rate(t + h / 2, b + h / 2 * r2), r4 = rate(t + h, b + h * r3);
    b += h / 6 * (r1 + 2 * r2 + 2 * r3 + r4);
  }
  const Matrix F = Matrix::Identity() + path(end);
  const Matrix kirchhoff = branch.modulus * (b - Matrix::Identity() * (b.trace() / 3));
  return kirchhoff * F.inverse().transpose();
}

Matrix stress_in_steps(MaxwellPoints points, const Path& path, Real end, int steps) {
  for (int k = 0; k < steps; ++k) {
    const Real t = end * (k + 1) / steps;
    points.accept(0, points.weights(t), lanes(path(t)));
    points.accept_time(t);
  }
  return first_lane(points.stress(0, points.weights(end), lanes(path(end))));
}

TEST(Viscoelasticity, IsTheUpperConvectedModelOfIsochoricDeformations) {
  constexpr Real end = 1.2;
  Matrix exact = Matrix::Zero();
  for (const MaxwellBranch& branch : branches)
    exact += stress_by_conformation(branch, winding, end);
  const auto error = [&](int steps) {
    return (stress_in_steps(one_group(), winding, end, steps) - exact).norm() / exact.norm();
  };
  EXPECT_LT(error(320), 2e-5);
  EXPECT_NEAR(error(40) / error(80), 4, 0.2);
  EXPECT_NEAR(error(80) / error(160), 4, 0.1);
}

/// After a sudden strain the stress of each branch falls by exp(-t/time), in steps of any length.
TEST(Viscoelasticity, AStepOfStrainRelaxesExactly) {
  const Matrix H = winding(0.7);
  for (const int steps : {1, 7}) {
    for (const MaxwellBranch& branch : branches) {
      MaxwellPoints points = one_group({branch});
      const Matrix sudden = first_lane(points.stress(0, points.weights(0), lanes(H)));
      points.accept(0, points.weights(0), lanes(H));
      const Matrix later = stress_in_steps(
          std::move(points), [&](Real) { return H; }, 2, steps);
      EXPECT_LT((later - std::exp(-2 / branch.time) * sudden).norm(), 1e-14 * sudden.norm());
    }
  }
}

/// Storage and loss modulus, mu w^2 time^2/(1 + w^2 time^2) and mu w time/(1 + w^2 time^2).
TEST(Viscoelasticity, HasTheModuliOfMaxwellOverFourDecades) {
  const Real pi = std::numbers::pi;
  for (const Real w : {0.01, 0.1, 1.0, 10.0, 100.0}) {
    // Steps are shorter than the least time.
    const int steps = std::max(400, static_cast<int>(2 * pi / w / 0.2));
    std::complex<Real> found = 0, exact = 0;
    for (const MaxwellBranch& branch : branches) {
      const std::complex<Real> x(0, w * branch.time);
      exact += branch.modulus * x / (1.0 + x);
      const Real period = 2 * pi / w;
      const int before = static_cast<int>(std::ceil(25 * branch.time / period)) * steps;
      MaxwellPoints points = one_group({branch});
      for (int k = 1; k <= before + steps; ++k) {
        const Real t = period * k / steps;
        Matrix H = Matrix::Zero();
        H(0, 1) = 0.4 * std::sin(w * t);
        const auto weights = points.weights(t);
        const Matrix P = first_lane(points.stress(0, weights, lanes(H)));
        points.accept(0, weights, lanes(H));
        points.accept_time(t);
        const Matrix kirchhoff = P * (Matrix::Identity() + H).transpose();
        if (k > before)
          found += 2.0 / steps / 0.4 * kirchhoff(0, 1) * std::polar(1.0, pi / 2 - w * t);
      }
    }
    EXPECT_NEAR(found.real() / exact.real(), 1, 1e-3) << w;
    EXPECT_NEAR(found.imag() / exact.imag(), 1, 1e-3) << w;
  }
}

/// The work of the stress is stored or lost, to second order in the step.
TEST(Viscoelasticity, WorkIsStoredOrHeat) {
  const auto error = [](int steps) {
    constexpr Real end = 2;
    MaxwellPoints points = one_group();
    Matrix before = Matrix::Zero(), P_before = Matrix::Zero();
    Real work = 0, lost = 0, heat_before = 0, stored = 0;
    for (int k = 1; k <= steps; ++k) {
      const Real t = end * k / steps;
      const Matrix H = winding(t);
      const auto weights = points.weights(t);
      const Matrix P = first_lane(points.stress(0, weights, lanes(H)));
      const Real heat = points.heat_density(0, weights, lanes(H))[0];
      EXPECT_GE(heat, 0);
      work += 0.5 * ((P + P_before).cwiseProduct(H - before)).sum();
      lost += 0.5 * end / steps * (heat + heat_before);
      stored = points.energy_density(0, weights, lanes(H))[0];
      points.accept(0, weights, lanes(H));
      points.accept_time(t);
      before = H, P_before = P, heat_before = heat;
    }
    return std::abs(work - stored - lost) / work;
  };
  EXPECT_LT(error(400), 1e-4);
  EXPECT_NEAR(error(100) / error(200), 4, 0.2);
}

/// Near the reference state nothing cancels: stress, energy and heat of a strain of 1e-9 are those
/// of linear viscoelasticity.
TEST(Viscoelasticity, IsAccurateForSmallStrains) {
  constexpr Real tiny = 1e-9, end = 0.6;
  const MaxwellBranch branch{0.7, 0.3};
  MaxwellPoints points = one_group({branch});
  Matrix H = Matrix::Zero();
  H(0, 1) = tiny, H(0, 0) = tiny, H(1, 1) = -tiny;
  points.accept(0, points.weights(0), lanes(H));
  const auto weights = points.weights(end);
  const Real left = std::exp(-end / branch.time), stress = branch.modulus * left * tiny;
  const Matrix P = first_lane(points.stress(0, weights, lanes(H)));
  EXPECT_NEAR(P(0, 1) / stress, 1, 1e-7);
  EXPECT_NEAR(P(1, 0) / stress, 1, 1e-7);
  EXPECT_NEAR(P(0, 0) / (2 * stress), 1, 1e-7);
  // Elastic strain e with 2 e:e mu/2 = 5/2 mu tiny^2 ... e12 = tiny/2, e11 = -e22 = tiny.
  const Real squared = 2 * tiny * tiny + 0.5 * tiny * tiny;
  EXPECT_NEAR(
      points.energy_density(0, weights, lanes(H))[0] / (branch.modulus * squared * left * left), 1,
      1e-6);
  EXPECT_NEAR(points.heat_density(0, weights, lanes(H))[0] /
                  (2 * branch.modulus / branch.time * squared * left * left),
              1, 1e-6);
}

/// The force of a body with a past is minus the gradient of its potential, balanced, and has an
/// exact tangent.
template <int D>
void expect_gradient_with_a_past() {
  const auto body = test::body_of<D>(test::brick<D>(std::vector<Real>(D, 3), 0.2));
  const auto term = viscoelasticity(*body, branches);
  for (int k = 0; k < 3; ++k) {
    const NodalVectors u = test::random_field<D>(body->size(), 0.05, static_cast<unsigned>(k));
    term->commit({0.1 * k, u, test::zeros(u)});
  }
  const NodalVectors u = test::random_field<D>(body->size(), 0.05, 11), rest = test::zeros(u),
                     way = test::random_field<D>(body->size(), 1, 12);
  constexpr Real time = 0.35, h = 1e-4;
  const auto potential = [&](Real s) {
    return *term->potential({time, test::sum_of(u, s, way), rest});
  };
  const auto force = [&](const NodalVectors& at_u) {
    NodalVectors f = rest;
    term->add_force({time, at_u, rest}, f);
    return f;
  };
  const NodalVectors f = force(u);
  const Real slope =
      (8 * (potential(h) - potential(-h)) - (potential(2 * h) - potential(-2 * h))) / (12 * h);
  EXPECT_NEAR(test::dot(f, way) / -slope, 1, 1e-8);
  const test::Balance net = test::balance_of<D>(*body, u, f);
  EXPECT_LT(net.force, 1e-12);
  EXPECT_LT(net.torque, 1e-12);
  NodalVectors change = rest;
  term->add_tangent({time, u, rest}, {time, way, rest}, change);
  NodalVectors difference =
      test::sum_of(force(test::sum_of(u, h, way)), -1, force(test::sum_of(u, -h, way)));
  for (Lanes& x : difference) x *= 1 / (2 * h);
  EXPECT_LT(test::norm(test::sum_of(difference, -1, change)), 1e-5 * test::norm(change));
}
TEST(Viscoelasticity, ForcesWithAPastAreAGradient) {
  expect_gradient_with_a_past<2>();
  expect_gradient_with_a_past<3>();
}

}  // namespace
}  // namespace meniscus::test_viscoelasticity
