// SPDX-License-Identifier: BSD-3-Clause
// Decompositions of small matrices.
#include "numbers/dense.hpp"
#include "support.hpp"

#include <gtest/gtest.h>

namespace meniscus::test_dense {
namespace {

/// A x = q M x with the greatest q: no other direction has a greater quotient.
void expect_greatest_quotient(const Mat<3>& A, const Mat<3>& M, int n) {
  const Vec<3> x = greatest_quotient(A, M, n);
  const Real q = x.dot(A * x);
  EXPECT_NEAR(x.dot(M * x), 1, 1e-14);
  for (int i = n; i < 3; ++i) EXPECT_EQ(x[i], 0);
  const Vec<3> residual = A * x - q * (M * x);
  EXPECT_LT(residual.head(n).norm(), 1e-13 * A.norm() * x.norm());
  const NodalVectors directions = test::random_field<3>(200, 1, 11);
  for (Index k = 0; k < 200; ++k) {
    Vec<3> y = vector_at<3>(directions, k);
    for (int i = n; i < 3; ++i) y[i] = 0;
    EXPECT_LE(y.dot(A * y) / y.dot(M * y), q + 1e-13 * std::abs(q));
  }
}

TEST(Dense, GreatestQuotientOfTwoForms) {
  const NodalVectors entries = test::random_field<3>(60, 1, 7);
  for (Index k = 0; k + 6 <= 60; k += 6) {
    Mat<3> A, G;
    for (int i = 0; i < 3; ++i) {
      A.row(i) = vector_at<3>(entries, k + i);
      G.row(i) = vector_at<3>(entries, k + 3 + i);
    }
    A = (A + A.transpose()).eval();
    const Mat<3> M = G * G.transpose() + 0.1 * Mat<3>::Identity();
    for (const int n : {2, 3}) {
      expect_greatest_quotient(A, M, n);
      expect_greatest_quotient(-A, M, n);
      expect_greatest_quotient(A * A.transpose(), Mat<3>::Identity(), n);
    }
  }
  // Diagonal matrices: the quotients are 2, 3/4 and 5.
  const Mat<3> A = Vec<3>(2, 3, 5).asDiagonal(), M = Vec<3>(1, 4, 1).asDiagonal();
  EXPECT_LT((greatest_quotient(A, M, 2).cwiseAbs() - Vec<3>(1, 0, 0)).norm(), 1e-15);
  EXPECT_LT((greatest_quotient(A, M, 3).cwiseAbs() - Vec<3>(0, 0, 1)).norm(), 1e-15);
}

}  // namespace
}  // namespace meniscus::test_dense
