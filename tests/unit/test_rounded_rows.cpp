// SPDX-License-Identifier: BSD-3-Clause
// Rows of the cell rule in single precision: allowed changes by rounding, and sums that stay exact.
#include "numbers/dense.hpp"
#include "support.hpp"

#include <gtest/gtest.h>

namespace meniscus::test_rounded_rows {
namespace {

template <int D>
Real largest_difference(const CellRule<D>& a, const CellRule<D>& b, const NodalVectors& field) {
  Real largest = 0;
  for (Index cell = 0; cell < a.groups(); ++cell) {
    Tensor<Lanes> of_a, of_b;
    a.gather(cell, field.data(), of_a);
    b.gather(cell, field.data(), of_b);
    for (int i = 0; i < D; ++i)
      for (int K = 0; K < D; ++K)
        for (int lane = 0; lane <= D; ++lane)
          largest = std::max(largest, std::abs(of_a(i, K)[lane] - of_b(i, K)[lane]));
  }
  return largest;
}

/// Gradients of quadratic fields are as exact as in double precision, also far from the origin,
/// where coordinates are large.
template <int D>
void expect_polynomials(Geometry<D> geometry) {
  for (Vec<D>& X : geometry.grid.X) X += Vec<D>::Constant(20);
  const auto body = test::body_of<D>(std::move(geometry));
  const CellRule<D> full = build_cell_rule(*body).rule,
                    rounded = build_cell_rule(*body, RowPrecision::rounded).rule;
  EXPECT_EQ(full.pairs(), rounded.pairs());
  EXPECT_GT(rounded.rounded.size(), rounded.coefficient.size());
  const NodalVectors quadratic = test::field_on<D>(*body, [](const Vec<D>& X) {
    const Vec<D> x = X - Vec<D>::Constant(20);
    Vec<D> u = 3 * x;
    u[0] += x[0] * x[1] - 2 * x[1] * x[1];
    u[1] += x.squaredNorm();
    return u;
  });
  EXPECT_LT(largest_difference(full, rounded, quadratic), 1e-12);
  const NodalVectors wave = test::field_on<D>(
      *body, [](const Vec<D>& X) { return Vec<D>::Constant(std::sin(2 * X[0]) * X[1]); });
  EXPECT_LT(largest_difference(full, rounded, wave), 1e-5);
  EXPECT_GT(largest_difference(full, rounded, wave), 1e-10);
}

TEST(RoundedRows, KeepTheGradientsOfQuadraticFields) {
  expect_polynomials<2>(test::disk(6, 3));
  expect_polynomials<3>(test::ball(4, 2));
  expect_polynomials<3>(test::brick<3>({7, 6, 7}, 0.3));
}

/// Stresses P with symmetric P F^T have no net force and no net moment on a body that is far from
/// its reference: bent, rotated by a right angle and moved.
TEST(RoundedRows, KeepMomentumAndAngularMomentum) {
  const auto body = test::body_of<3>(test::brick<3>({7, 6, 7}, 0.3));
  const CellRule<3> rule = build_cell_rule(*body, RowPrecision::rounded).rule;
  const NodalVectors u = test::field_on<3>(*body, [](const Vec<3>& X) {
    const Vec<3> bent(X[0], X[1] + 0.2 * std::sin(3 * X[0]), X[2] + 0.1 * std::cos(4 * X[1]));
    return Vec<3>(-bent[1] + 9 - X[0], bent[0] - 40 - X[1], bent[2] + 100 - X[2]);
  });
  NodalVectors force(u.size(), Lanes::zero());
  for (Index cell = 0; cell < rule.groups(); ++cell) {
    Tensor<Lanes> H;
    rule.gather(cell, u.data(), H);
    const Tensor<Lanes> F = add_diagonal(H, Lanes(1.0));
    // S = E: P = F E
    const Tensor<Lanes> E = Tensor<Lanes>::map([&](int K, int L) {
      return 0.5 * (F(0, K) * F(0, L) + F(1, K) * F(1, L) + F(2, K) * F(2, L)) -
             (K == L ? 0.5 : 0.0);
    });
    rule.scatter(cell, rule.weight(cell) * (F * E), force.data());
  }
  Vec<3> sum = Vec<3>::Zero(), moment = sum;
  Real size = 0;
  for (Index A = 0; A < body->size(); ++A) {
    const Vec<3> f(at(force, A)[0], at(force, A)[1], at(force, A)[2]),
        x = at(body->particles.X(), A) + Vec<3>(at(u, A)[0], at(u, A)[1], at(u, A)[2]);
    sum += f;
    moment += cross(x, f);
    size += f.norm();
  }
  EXPECT_GT(size, 0.01);
  EXPECT_LT(sum.norm(), 1e-14 * size);
  EXPECT_LT(moment.norm(), 1e-12 * size);  // arms of 100
}

}  // namespace
}  // namespace meniscus::test_rounded_rows
