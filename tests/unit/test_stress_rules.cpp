// SPDX-License-Identifier: BSD-3-Clause
// Integration rules of the internal force: reference values, reproduction, transposition, patch
// test.
#include "body/grid/stress_rules.hpp"
#include "rkpm_reference.hpp"
#include "support.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <map>
#include <random>

namespace meniscus::test_stress_rules {
namespace {

TEST(CellRule, MatchesReferenceOnALattice) {
  Brick<3> shape;
  shape.size = shape.cells = {2, 2, 2};
  shape.corner = {0, 0, 0};
  Geometry<3> geometry = shape.geometry();
  ParticleSet<3> particles(geometry.grid.X, 2.6, KernelFunction::cubic_spline);
  const Body<3> body("lattice", std::move(geometry), std::move(particles));
  const CellRule<3> rule = build_cell_rule(body).rule;
  const auto number_at = [&](int node) {
    const Vec<3> place(node / 9, node / 3 % 3, node % 3);
    Index A = 0;
    while ((at(body.particles.X(), A) - place).norm() > 1e-12) ++A;
    return A;
  };
  const auto cases = test::rkpm_cases("qscni/");
  ASSERT_EQ(cases.size(), 2u);
  for (const auto& test : cases) {
    SCOPED_TRACE(test.at("name").get<std::string>());
    const auto& value = test.at("value");
    const Index cell = number_at(test.at("inputs").at("node"));
    // The reference has 5 x 5 points in each part of a facet. The rule has 2 x 2 points in all if
    // cells continue beyond the particle; BelongsToTheSamplesOfACube tests these to rounding.
    const bool inside = at(body.particles.X(), cell) == Vec<3>(1, 1, 1);
    const Real tolerance_a = test.at("tolerance").at("a"),
               tolerance_B = test.at("tolerance").at("B").get<Real>() * (inside ? 4 : 1);
    EXPECT_NEAR(at(rule.volume, cell), value.at("V").get<Real>(), 1e-13);
    for (int node = 0; node < 27; ++node) {
      const Index A = number_at(node);
      Offset entry = at(rule.start, cell);
      while (entry < at(rule.start, cell + 1) && at(rule.particle, entry) != A) ++entry;
      const bool reached = entry < at(rule.start, cell + 1);
      for (int K = 0; K < 3; ++K) {
        const Lanes g = reached ? at(rule.coefficient, 3 * entry + K) : Lanes::zero();
        EXPECT_NEAR(g[0], value.at("a").at(node).at(K).get<Real>(), tolerance_a);
        for (int M = 0; M < 3; ++M)
          EXPECT_NEAR(g[1 + M], value.at("B_KM").at(node).at(K).at(M).get<Real>(), tolerance_B);
      }
    }
  }
}

/// The nodal cell inside a lattice is a cube. It has 2 x 2 Gauss points per facet and the 14 points
/// of Irons.
TEST(CellRule, BelongsToTheSamplesOfACube) {
  Brick<3> shape;
  shape.size = shape.cells = {4, 4, 4};
  shape.corner = {-2, -2, -2};
  Geometry<3> geometry = shape.geometry();
  ParticleSet<3> particles(geometry.grid.X, 2.3, KernelFunction::cubic_spline);
  const Body<3> body("lattice", std::move(geometry), std::move(particles));
  const CellRule<3> rule = build_cell_rule(body).rule;
  Index cell = 0;
  while (at(body.particles.X(), cell).norm() > 1e-12) ++cell;

  struct Integrals {
    Real volume = 0;               // of N
    Vec<3> a = Vec<3>::Zero();     // of N n_K
    Mat<3> flux = Mat<3>::Zero();  // of N n_K X_Q
  };
  std::map<Index, Integrals> expected;
  const auto for_shapes = [&](const Vec<3>& x, const auto& visit) {
    std::vector<Candidate<3>> near;
    body.particles.candidates({x, x, x, x}, near);
    ReproducingKernel<3> kernel(body.particles.kernel_function());
    kernel.evaluate({x, x, x, x}, near, Derivatives::none);
    for (std::size_t k = 0; k < near.size(); ++k) visit(near[k].particle, kernel.value(k)[0]);
  };
  const auto add_volume = [&](const Vec<3>& x, Real w) {
    for_shapes(x, [&](Index A, Real N) { expected[A].volume += w * N; });
  };
  const Real towards_corner = 0.5 * std::sqrt(19. / 33), on_axis = 0.5 * std::sqrt(19. / 30),
             on_facet = 0.5 / std::sqrt(3.0);
  for (const Real x : {-1, 1})
    for (const Real y : {-1, 1})
      for (const Real z : {-1, 1}) add_volume(towards_corner * Vec<3>(x, y, z), 121. / 361 / 8);
  for (int K = 0; K < 3; ++K)
    for (const Real side : {-1, 1}) {
      add_volume(side * on_axis * Vec<3>::Unit(K), 320. / 361 / 8);
      for (const Real s : {-1, 1})
        for (const Real t : {-1, 1}) {
          Vec<3> x = 0.5 * side * Vec<3>::Unit(K);
          x[(K + 1) % 3] = s * on_facet;
          x[(K + 2) % 3] = t * on_facet;
          for_shapes(x, [&](Index A, Real N) {
            expected[A].a[K] += 0.25 * side * N;
            expected[A].flux.row(K) += 0.25 * side * N * x;
          });
        }
    }
  Offset entries = 0;
  for (Offset e = at(rule.start, cell); e < at(rule.start, cell + 1); ++e, ++entries) {
    const Integrals& own = expected.at(at(rule.particle, e));
    for (int K = 0; K < 3; ++K) {
      const Lanes g = at(rule.coefficient, 3 * e + K);
      EXPECT_NEAR(g[0], own.a[K], 1e-14);
      for (int M = 0; M < 3; ++M)
        EXPECT_NEAR(g[1 + M], 12 * (own.flux(K, M) - (K == M ? own.volume : 0)), 1e-13);
    }
  }
  EXPECT_EQ(entries, std::ssize(expected));
}

/// A quadratic vector field and its gradient.
template <int D>
struct Quadratic {
  Mat<D> A;
  std::array<Mat<D>, D> G;

  explicit Quadratic(Real length) {
    for (int i = 0; i < D; ++i)
      for (int K = 0; K < D; ++K) {
        A(i, K) = std::sin(1.0 + 3 * i + K) / length;
        for (int L = 0; L < D; ++L)
          at(G, i)(K, L) = std::cos(2.0 + 5 * i + 2 * (K + L) + K * L) / (length * length);
      }
  }
  Vec<D> operator()(const Vec<D>& X) const {
    Vec<D> u = A * X;
    for (int i = 0; i < D; ++i) u[i] += 0.5 * X.dot(at(G, i) * X);
    return u;
  }
  Mat<D> gradient(const Vec<D>& X) const {
    Mat<D> H = A;
    for (int i = 0; i < D; ++i) H.row(i) += (at(G, i) * X).transpose();
    return H;
  }
};

/// Largest difference, in units of 1/h, between gather() and the gradient at the stress points
/// place(group, lane).
template <int D, class Rule, class Place>
Real gather_error(const Rule& rule, const Body<D>& body, Place&& place) {
  Real size = 0;
  for (const auto& X : body.particles.X()) size = std::max(size, X.norm());
  const Real h = std::pow(volume(body.geometry.grid) / body.size(), 1.0 / D);
  const Quadratic<D> exact(size);
  const NodalVectors u = test::field_on<D>(body, exact);
  Real worst = 0;
  for (Index g = 0; g < rule.groups(); ++g) {
    Tensor<Lanes> H;
    rule.gather(g, u.data(), H);
    const Lanes w = rule.weight(g);
    for (int lane = 0; lane < 4; ++lane) {
      if (w[lane] == 0) continue;
      const Mat<D> expected = exact.gradient(place(g, lane));
      for (int i = 0; i < 3; ++i)
        for (int K = 0; K < 3; ++K)
          worst = std::max(worst,
                           h * std::abs(H(i, K)[lane] - (i < D && K < D ? expected(i, K) : 0.0)));
    }
  }
  return worst;
}

/// Tests the rule with the boundary points of loads, and with few boundary points.
template <int D>
Real cell_rule_error(Geometry<D> geometry) {
  const auto body = test::body_of<D>(std::move(geometry));
  Real worst = 0;
  for (const bool loaded : {true, false}) {
    body->loaded_faces = loaded;
    const CellRule<D> rule = build_cell_rule(*body).rule;
    worst = std::max(worst, gather_error<D>(rule, *body, [&](Index cell, int lane) {
                       Vec<D> X = body->cells.centroid(cell);
                       for (int M = 0; M < D; ++M) X[M] += at(rule.point, cell * D + M)[lane];
                       return X;
                     }));
  }
  return worst;
}

TEST(CellRule, ReproducesQuadraticFieldsAtItsPoints) {
  EXPECT_LT(cell_rule_error<2>(test::brick<2>({8, 6}, 0.4)), 1e-12);
  EXPECT_LT(cell_rule_error<2>(test::disk(6, 3)), 1e-12);
  EXPECT_LT(cell_rule_error<3>(test::brick<3>({4, 5, 4}, 0.4)), 1e-12);
  EXPECT_LT(cell_rule_error<3>(test::ball(4, 2)), 1e-12);
  EXPECT_LT(cell_rule_error<3>(test::potato<3>()), 1e-12);
  Cylinder cylinder;
  cylinder.core = 6;
  cylinder.rings = 3;
  EXPECT_LT(cell_rule_error<3>(cylinder.geometry()), 1e-12);
}

template <int D>
void expect_point_rules_reproduce(Geometry<D> geometry) {
  const auto body = test::body_of<D>(std::move(geometry));
  const auto points = cell_gauss_points(body->geometry.grid, 3).X;
  const auto gauss = build_gauss_rule(*body, 3);
  const auto nodal = build_nodal_rule(*body);
  EXPECT_LT(gather_error<D>(gauss, *body, [&](Index g, int l) { return at(points, 4 * g + l); }),
            1e-12);
  EXPECT_LT(gather_error<D>(nodal, *body,
                            [&](Index g, int l) { return at(body->particles.X(), 4 * g + l); }),
            1e-12);
  for (Index g = 0; g < nodal.groups(); ++g)
    for (int lane = 0; lane < 4; ++lane)
      if (nodal.weight(g)[lane] > 0) {
        EXPECT_EQ(nodal.owner(g, lane), 4 * g + lane);
      }
}

TEST(PointRule, ReproducesQuadraticFields) {
  expect_point_rules_reproduce<2>(test::brick<2>({7, 6}, 0.3));
  expect_point_rules_reproduce<3>(test::ball(4, 2));
}

/// Volume, centroid and covariance of a cell from its stress points.
template <int D>
void expect_moments(Geometry<D> geometry) {
  const auto body = test::body_of<D>(std::move(geometry));
  const CellRule<D> rule = build_cell_rule(*body).rule;
  for (Index L = 0; L < rule.groups(); ++L) {
    const Lanes w = rule.weight(L);
    const Real V = body->cells.volume(L), length = std::pow(V, 1.0 / D);
    EXPECT_NEAR(sum(w), V, 1e-15 * V);
    if (D == 2) {
      EXPECT_EQ(w[3], 0);
    }
    Vec<D> mean = Vec<D>::Zero();
    Mat<D> spread = Mat<D>::Zero();
    for (int q = 0; q < D + 1; ++q) {
      Vec<D> xi;
      for (int M = 0; M < D; ++M) xi[M] = at(rule.point, L * D + M)[q];
      mean += w[q] / V * xi;
      spread += w[q] / V * xi * xi.transpose();
    }
    EXPECT_LT(mean.norm(), 1e-15 * length);
    EXPECT_LT((spread - body->cells.covariance(L)).norm(), 1e-15 * length * length);
  }
}

/// In 2D a cell has three stress points. The fourth lane repeats one of them, so that it is folded
/// or NaN only if a stress point is.
TEST(CellRule, RepeatsAPointWhereALaneIsLeft) {
  const auto body = test::body_of<2>(test::disk(4, 2));
  const CellRule<2> rule = build_cell_rule(*body).rule;
  const NodalVectors u = test::random_field<2>(body->size(), 1, 4);
  for (Index L = 0; L < rule.groups(); ++L) {
    Tensor<Lanes> H;
    rule.gather(L, u.data(), H);
    EXPECT_EQ(rule.weight(L)[3], 0);
    for (int i = 0; i < 2; ++i)
      for (int K = 0; K < 2; ++K) EXPECT_EQ(H(i, K)[3], H(i, K)[2]);
  }
}

TEST(CellRule, PointsHaveTheMomentsOfTheCell) {
  expect_moments<2>(test::disk(4, 2));
  expect_moments<3>(test::brick<3>({3, 3, 4}, 0.3));
}

/// P : gather(u) = scatter(P) . u in every group.
template <int D, class Rule>
void expect_transposes(const Rule& rule, Index particles) {
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<Real> uniform(-1, 1);
  const NodalVectors u = test::random_field<D>(particles, 1, 4);
  for (Index g = 0; g < rule.groups(); ++g) {
    Tensor<Lanes> H, P;
    rule.gather(g, u.data(), H);
    for (int i = 0; i < 3; ++i)
      for (int K = 0; K < 3; ++K)
        for (int q = 0; q < 4; ++q) P(i, K).set(q, i < D && K < D ? uniform(generator) : 0.0);
    NodalVectors force(u.size(), Lanes::zero());
    rule.scatter(g, P, force.data());
    Real scale = 0;
    for (std::size_t A = 0; A < u.size(); ++A) {
      EXPECT_EQ(force[A][3], 0);
      if (D == 2) {
        EXPECT_EQ(force[A][2], 0);
      }
      scale += std::sqrt(sum(force[A] * force[A]) * sum(u[A] * u[A]));
    }
    ASSERT_NEAR(sum(contract(P, H)), test::dot(force, u), 1e-14 * scale);
  }
}

template <int D>
void expect_all_transpose(Geometry<D> geometry) {
  const auto body = test::body_of<D>(std::move(geometry));
  expect_transposes<D>(build_cell_rule(*body).rule, body->size());
  expect_transposes<D>(build_gauss_rule(*body, 2), body->size());
  PointRule<D> single = build_gauss_rule(*body, 1);
  single.per_group = 1;
  expect_transposes<D>(single, body->size());
  expect_transposes<D>(build_nodal_rule(*body), body->size());
}

TEST(StressRules, ScatterIsTheTransposeOfGather) {
  expect_all_transpose<2>(test::disk(4, 2));
  expect_all_transpose<3>(test::brick<3>({3, 4, 3}, 0.2));
}

/// Integrals of N_A n dA over the surface of the body, by the points of the nodal cells.
template <int D>
std::vector<Vec<D>> boundary_fluxes(const Body<D>& body) {
  std::vector<Vec<D>> points, dA;
  CellQuadrature<D> q;
  for (Index L = 0; L < body.size(); ++L) {
    body.cells.quadrature(L, q);
    for (std::size_t p = q.body_facets_begin; p < q.facet_X.size(); ++p) {
      points.push_back(q.facet_X[p]);
      dA.push_back(q.facet_dA[p]);
    }
  }
  const auto rows = build_point_rows<D>(body.particles, points, {.value = true}, body.name);
  std::vector<Vec<D>> flux(static_cast<std::size_t>(body.size()), Vec<D>::Zero());
  for (Index p = 0; p < rows.size(); ++p)
    for (Offset e = at(rows.start, p); e < at(rows.start, p + 1); ++e)
      at(flux, at(rows.particle, e)) += at(rows.value, e) * at(dA, p);
  return flux;
}

/// A constant stress has forces at the boundary only: f_A = -P oint N_A N dA, which is zero for
/// particles whose supports do not reach the boundary.
template <int D>
void expect_linear_patch(Geometry<D> geometry) {
  const auto body = test::body_of<D>(std::move(geometry));
  const auto term = test::internal_force<D>(*body, "neo_hookean");
  Mat<D> H;
  for (int i = 0; i < D; ++i)
    for (int K = 0; K < D; ++K) H(i, K) = 0.2 * std::sin(1.0 + 3 * i + K);
  const NodalVectors u = test::field_on<D>(*body, [&](const Vec<D>& X) { return H * X; });
  const NodalVectors force = test::force_of(*term, u);

  const SceneInput numbers = SceneInput::from_text(test::law_texts().at("neo_hookean"));
  const auto law = laws().at("neo_hookean").read(numbers.root());
  const Tensor<Real> P =
      law->stress(Tensor<Real>::map([&](int i, int K) { return i < D && K < D ? H(i, K) : 0.0; }));
  const auto flux = boundary_fluxes(*body);
  Real scale = 0;
  for (const auto& f : flux) scale = std::max(scale, f.norm());
  Index inner = 0;
  for (Index A = 0; A < body->size(); ++A) {
    for (int i = 0; i < D; ++i) {
      Real expected = 0;
      for (int K = 0; K < D; ++K) expected -= P(i, K) * at(flux, A)[K];
      EXPECT_NEAR(at(force, A)[i], expected, 1e-12 * scale);
    }
    inner += at(flux, A) == Vec<D>::Zero();
  }
  EXPECT_GT(inner, 0);
  const Real volume_energy =
      volume(body->geometry.grid) * law->energy_density(Tensor<Real>::map([&](int i, int K) {
        return i < D && K < D ? H(i, K) : 0.0;
      }));
  EXPECT_NEAR(test::energy_of(*term, u), volume_energy, 1e-12 * volume_energy);
}

TEST(CellRule, PassesTheLinearPatchTest) {
  expect_linear_patch<2>(test::brick<2>({9, 8}, 0.3));
  expect_linear_patch<2>(test::disk(8, 4));
  expect_linear_patch<3>(test::brick<3>({8, 8, 8}, 0.3));
}

/// Row sums of N_A over the body are the volume, and give the first moment.
template <int D>
void expect_shape_integrals(Geometry<D> geometry, Real tolerance) {
  const auto body = test::body_of<D>(std::move(geometry));
  const auto by_cells = build_cell_rule(*body).shape_integral;
  const auto by_gauss = shape_integrals(*body);
  const Real V = volume(body->geometry.grid);
  for (const auto* integral : {&by_cells, &by_gauss}) {
    Real total = 0;
    Vec<D> first = Vec<D>::Zero(), exact = first;
    for (Index A = 0; A < body->size(); ++A) {
      total += at(*integral, A);
      first += at(*integral, A) * at(body->particles.X(), A);
      exact += body->cells.volume(A) * body->cells.centroid(A);
    }
    EXPECT_NEAR(total, V, 1e-12 * V);
    EXPECT_LT((first - exact).norm(), 1e-12 * V);
  }
  for (Index A = 0; A < body->size(); ++A)
    EXPECT_NEAR(at(by_cells, A), at(by_gauss, A), tolerance * V / body->size());
}

TEST(StressRules, ShapeIntegralsHaveTheMomentsOfTheBody) {
  expect_shape_integrals<2>(test::potato<2>(), 0.05);
  expect_shape_integrals<3>(test::potato<3>(), 0.05);
}

}  // namespace
}  // namespace meniscus::test_stress_rules
