// SPDX-License-Identifier: BSD-3-Clause
// The internal force with every law and rule: gradient of the energy, balance, dissipation,
// failure.
#include "meniscus/error.hpp"
#include "physics/internal/internal_force.hpp"
#include "support.hpp"
#include "thrown.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cstring>
#include <functional>
#include <limits>

namespace meniscus::test_internal_force {
namespace {

template <int D>
Geometry<D> small_body() {
  if constexpr (D == 3)
    return test::brick<3>({3, 3, 3}, 0.2);
  else
    return test::brick<2>({5, 4}, 0.2);
}

template <int D>
void for_all(const std::function<void(Body<D>&, ForceTerm&)>& check) {
  const auto body = test::body_of<D>(small_body<D>());
  for (const auto& [law, text] : test::law_texts())
    for (const Integration& integration : test::integrations()) {
      SCOPED_TRACE(law + ", " + integration.rule + ", " + integration.volumetric + ", " +
                   std::to_string(D) + "D");
      const auto term = test::internal_force<D>(*body, law, integration);
      check(*body, *term);
    }
}

template <int D>
void expect_gradient(Body<D>& body, ForceTerm& term) {
  for (unsigned seed = 0; seed < 3; ++seed) {
    const NodalVectors u = test::random_field<D>(body.size(), 0.06, seed);
    const NodalVectors direction = test::random_field<D>(body.size(), 1, 100 + seed);
    EXPECT_LT(test::gradient_error(term, u, direction, 5e-4), 1e-7);
  }
}

TEST(InternalForce, IsMinusTheGradientOfItsEnergy) {
  for_all<2>(expect_gradient<2>);
  for_all<3>(expect_gradient<3>);
}

/// The energy computed together with the force equals the energy computed alone.
template <int D>
void expect_reported_energy(Body<D>& body, ForceTerm& term) {
  const NodalVectors u = test::random_field<D>(body.size(), 0.06, 5), v = test::zeros(u);
  NodalVectors force = v, without = v;
  const Motion motion{0.3, u, v};
  term.add_force(motion, without);
  std::vector<StoredEnergy> energies;
  Forces asked(force);
  asked.energies = &energies;
  term.add_force(motion, asked);
  ASSERT_EQ(energies.size(), 1U);
  EXPECT_EQ(energies[0].term, &term);
  const Real energy = term.stored_energy(motion).value();
  EXPECT_NEAR(energies[0].value, energy, 1e-13 * std::abs(energy));
  EXPECT_EQ(test::norm(test::sum_of(force, -1, without)), 0);
}

TEST(InternalForce, ReportsItsEnergyWhereItIsAskedFor) {
  for_all<2>(expect_reported_energy<2>);
  for_all<3>(expect_reported_energy<3>);
}

template <int D>
void expect_balance(Body<D>& body, ForceTerm& term) {
  const NodalVectors u = test::random_field<D>(body.size(), 0.08, 7);
  const NodalVectors v = test::random_field<D>(body.size(), 1, 8);
  const test::Balance net = test::balance_of<D>(body, u, test::force_of(term, u, v));
  EXPECT_LT(net.force, 1e-14);
  EXPECT_LT(net.torque, 1e-14);
}

TEST(InternalForce, HasNoNetForceOrTorque) {
  for_all<2>(expect_balance<2>);
  for_all<3>(expect_balance<3>);
}

template <int D>
void expect_rest(Body<D>& body, ForceTerm& term) {
  NodalVectors u = NodalVectors(static_cast<std::size_t>(body.size()), Lanes::zero());
  EXPECT_EQ(test::norm(test::force_of(term, u)), 0);
  EXPECT_EQ(test::energy_of(term, u), 0);
  // The body is translated and rotated as a whole.
  const Real c = std::cos(0.7), s = std::sin(0.7);
  u = test::field_on<D>(body, [&](const Vec<D>& X) {
    Vec<D> x = X;
    x[0] = c * X[0] - s * X[1] + 3;
    x[1] = s * X[0] + c * X[1] - 2;
    return Vec<D>(x - X);
  });
  EXPECT_LT(test::norm(test::force_of(term, u)), 1e-12);
  EXPECT_LT(std::abs(test::energy_of(term, u)), 1e-13);
  // The body spins as a whole: no heat.
  const NodalVectors spin = test::field_on<D>(body, [&](const Vec<D>& X) {
    Vec<D> v = Vec<D>::Zero();
    v[0] = -(s * X[0] + c * X[1]);
    v[1] = c * X[0] - s * X[1];
    return v;
  });
  EXPECT_LT(test::norm(test::force_of(term, u, spin)), 1e-12);
  EXPECT_LT(std::abs(test::report_of(term, u, spin).heat), 1e-13);
}

TEST(InternalForce, VanishesForRigidMotions) {
  for_all<2>(expect_rest<2>);
  for_all<3>(expect_rest<3>);
}

template <int D>
void expect_dissipation(Body<D>& body, ForceTerm& term) {
  const NodalVectors u = test::random_field<D>(body.size(), 0.06, 17);
  const NodalVectors v = test::random_field<D>(body.size(), 1, 18);
  const NodalVectors both = test::force_of(term, u, v);
  const Real heat = test::report_of(term, u, v).heat;
  const NodalVectors viscous = test::sum_of(both, -1, test::force_of(term, u));
  EXPECT_EQ(test::report_of(term, u).heat, 0);  // at rest
  if (!term.viscous()) {
    EXPECT_EQ(heat, 0);
    EXPECT_EQ(test::norm(viscous), 0);
    return;
  }
  EXPECT_GT(heat, 0);
  EXPECT_NEAR(-test::dot(viscous, v), heat, 1e-12 * heat);
  // The viscous force is linear in the velocity.
  const NodalVectors twice = test::force_of(term, u, test::sum_of(v, 1, v));
  EXPECT_LT(test::norm(test::sum_of(test::sum_of(twice, -1, both), -1, viscous)),
            1e-12 * test::norm(viscous));
}

TEST(InternalForce, HeatIsTheViscousPower) {
  for_all<2>(expect_dissipation<2>);
  for_all<3>(expect_dissipation<3>);
}

TEST(InternalForce, IsElasticWhereTheViscosityIsZero) {
  const auto body = test::body_of<3>(small_body<3>());
  const NodalVectors u = test::random_field<3>(body->size(), 0.06, 19);
  const NodalVectors v = test::random_field<3>(body->size(), 1, 20);
  const std::string fluid = "density = 1.25\nbulk_modulus = 2.5\nviscosity = ";
  for (const Integration& integration : test::integrations()) {
    SCOPED_TRACE(integration.rule + ", " + integration.volumetric);
    const auto viscous = test::internal_force<3>(*body, "newtonian", fluid + "0.5", integration);
    const auto inviscid = test::internal_force<3>(*body, "newtonian", fluid + "0", integration);
    EXPECT_TRUE(viscous->viscous());
    EXPECT_FALSE(inviscid->viscous());
    const NodalVectors at_rest = test::force_of(*viscous, u);
    const NodalVectors moving = test::force_of(*inviscid, u, v);
    EXPECT_LT(test::norm(test::sum_of(moving, -1, at_rest)), 1e-14 * test::norm(at_rest));
    EXPECT_EQ(test::energy_of(*inviscid, u), test::energy_of(*viscous, u));
    const auto bulk =
        test::internal_force<3>(*body, "newtonian", fluid + "0\nbulk_viscosity = 1", integration);
    EXPECT_TRUE(bulk->viscous());
  }
}

template <int D>
void expect_formulas() {
  const auto body = test::body_of<D>(small_body<D>());
  const NodalVectors u = test::random_field<D>(body->size(), 0.06, 27);
  for (const Integration& integration : test::integrations()) {
    SCOPED_TRACE(integration.rule);
    const auto uniform = test::internal_force<D>(
        *body, "neo_hookean", "density = 1.25\nmu = 0.75\nlambda = 3", integration);
    const auto mass = body->mass;
    const auto constant = test::internal_force<D>(
        *body, "neo_hookean", "density = \"1.25 + 0*x\"\nmu = \"0.75 + 0*x\"\nlambda = \"3 + 0*y\"",
        integration);
    for (std::size_t A = 0; A < mass.size(); ++A) EXPECT_DOUBLE_EQ(body->mass[A], mass[A]);
    const NodalVectors expected = test::force_of(*uniform, u);
    const NodalVectors difference = test::sum_of(test::force_of(*constant, u), -1, expected);
    EXPECT_LT(test::norm(difference), 1e-14 * test::norm(expected));
    EXPECT_NEAR(test::energy_of(*constant, u), test::energy_of(*uniform, u),
                1e-14 * test::energy_of(*uniform, u));

    // With a modulus that really varies: still a gradient, balanced, and stiffer where the modulus
    // is larger.
    const auto varying = test::internal_force<D>(
        *body, "neo_hookean",
        "density = 1.25\nmu = \"0.75*(1 + 0.3*x)\"\nlambda = \"3*(1 + 0.3*x)\"", integration);
    expect_gradient<D>(*body, *varying);
    expect_balance<D>(*body, *varying);
    const auto stretch = [&](Real sign) {
      return test::field_on<D>(*body, [&](const Vec<D>& X) {
        const Real pull = sign * X[0] > 0 ? 0.05 * X[0] * X[0] : 0;
        return Vec<D>(pull * Vec<D>::Unit(0));
      });
    };
    EXPECT_GT(test::energy_of(*varying, stretch(1)), 1.2 * test::energy_of(*varying, stretch(-1)));
  }
}

TEST(InternalForce, FormulasOfPlaceReachTheStressPoints) {
  expect_formulas<2>();
  expect_formulas<3>();
}

TEST(InternalForce, FormulasThatLeaveTheirRangeAreRefused) {
  const auto body = test::body_of<2>(small_body<2>());
  for (const Integration& integration : test::integrations())
    EXPECT_THROW_WITH(
        test::internal_force<2>(*body, "neo_hookean",
                                "density = 1.25\nmu = \"0.75 + x\"\nlambda = 1.5", integration),
        InputError, "mu: ");
}

/// Owner of the first stress point with J <= 0, by a separate loop over a separate rule.
template <int D, class Rule>
Index first_folded(const Rule& rule, const NodalVectors& u) {
  for (Index g = 0; g < rule.groups(); ++g) {
    Tensor<Lanes> H;
    rule.gather(g, u.data(), H);
    const Lanes J = determinant(deformation_gradient(H)), w = rule.weight(g);
    for (int lane = 0; lane < 4; ++lane)
      if (w[lane] > 0 && !(J[lane] > 0)) return rule.owner(g, lane);
  }
  return -1;
}

template <int D>
void expect_failures() {
  const auto body = test::body_of<D>(
      test::brick<D>(D == 3 ? std::vector<Real>{6, 5, 5} : std::vector<Real>{9, 8}));
  for (const Integration& integration : test::integrations()) {
    SCOPED_TRACE(integration.rule);
    body->first = 0;
    const auto term = test::internal_force<D>(*body, "neo_hookean", integration);
    const auto expected = [&](const NodalVectors& u) {
      if (integration.rule == "q_scni") return first_folded<D>(build_cell_rule(*body).rule, u);
      if (integration.rule == "gauss") return first_folded<D>(build_gauss_rule(*body, 2), u);
      return first_folded<D>(build_nodal_rule(*body), u);
    };
    for (const Vec<D>& centre : {Vec<D>(Vec<D>::Constant(-1.2)), Vec<D>(Vec<D>::Constant(1.1))}) {
      // The displacement is mirrored along x about `centre`.
      const NodalVectors u = test::field_on<D>(*body, [&](const Vec<D>& X) {
        const Vec<D> arm = X - centre;
        return Vec<D>(-3 * std::exp(-arm.squaredNorm() / 3) * arm[0] * Vec<D>::Unit(0));
      });
      const auto failure = test::report_of(*term, u).failure;
      ASSERT_TRUE(failure.has_value());
      EXPECT_EQ(failure->particle, expected(u));
      EXPECT_LT((at(body->particles.X(), failure->particle) - centre).norm(), 2.5);
      EXPECT_NE(failure->cause.find("J = det F = -"), std::string::npos) << failure->cause;

      EXPECT_FALSE(test::report_of(*term, test::zeros(u)).failure.has_value());
    }
    NodalVectors broken(static_cast<std::size_t>(body->size()), Lanes::zero());
    broken[20].set(0, std::numeric_limits<Real>::quiet_NaN());
    const auto failure = test::report_of(*term, broken).failure;
    ASSERT_TRUE(failure.has_value());
    EXPECT_EQ(failure->particle, expected(broken));
  }
}

TEST(InternalForce, NamesTheParticleWhereTheBodyFolds) {
  expect_failures<2>();
  expect_failures<3>();
}

TEST(InternalForce, TouchesOnlyItsOwnParticles) {
  const auto body = test::body_of<3>(small_body<3>());
  constexpr std::size_t before = 7, after = 3;
  const NodalVectors u = test::random_field<3>(body->size(), 0.06, 37);
  const NodalVectors v = test::random_field<3>(body->size(), 1, 38);
  for (const Integration& integration : test::integrations()) {
    body->first = 0;
    const auto term = test::internal_force<3>(*body, "newtonian", integration);
    const NodalVectors alone = test::force_of(*term, u, v);
    body->first = before;
    const Lanes junk(1e3);
    NodalVectors all_u(before + u.size() + after, junk), all_v = all_u;
    std::copy(u.begin(), u.end(), all_u.begin() + before);
    std::copy(v.begin(), v.end(), all_v.begin() + before);
    const NodalVectors force = test::force_of(*term, all_u, all_v);
    for (std::size_t A = 0; A < force.size(); ++A) {
      const Lanes expected =
          A < before || A >= before + u.size() ? Lanes::zero() : alone[A - before];
      EXPECT_EQ(std::memcmp(&force[A], &expected, sizeof(Lanes)), 0) << A;
    }
    all_u[before + 9].set(1, 40);
    const auto failure = test::report_of(*term, all_u, all_v).failure;
    ASSERT_TRUE(failure.has_value());
    EXPECT_GE(failure->particle, static_cast<Index>(before));
  }
}

TEST(InternalForce, FieldsOfAHomogeneousStateAreConstant) {
  const auto body = test::body_of<2>(small_body<2>());
  const Mat<2> H = (Mat<2>() << 0.1, 0.05, -0.02, 0.2).finished();
  const NodalVectors u = test::field_on<2>(*body, [&](const Vec<2>& X) { return H * X; });
  const NodalVectors v = test::zeros(u);
  const Real J = (Mat<2>::Identity() + H).determinant();
  std::vector<Integration> all = test::integrations();
  all.push_back({"gauss", 1});  // many particles own no stress point
  for (const Integration& integration : all) {
    const auto term = test::internal_force<2>(*body, "newtonian", integration);
    for (const FieldSource& field : term->fields()) {
      std::vector<Real> values(static_cast<std::size_t>(body->size() * field.components), -7);
      field.compute({0, u, v}, values);
      for (Index A = 0; A < body->size(); ++A) {
        if (field.name == "J") {
          EXPECT_NEAR(at(values, A), J, 1e-13);
        }
        if (field.name == "pressure") {
          EXPECT_NEAR(at(values, A), -2.5 * std::log(J), 1e-12);
        }
        if (field.name == "F") {
          EXPECT_NEAR(at(values, 9 * A + 1), 0.05, 1e-13);
        }
        if (field.name == "von_mises") {
          EXPECT_NEAR(at(values, A), 0, 1e-12);
        }
      }
    }
    for (const MeasureSource& measure : term->measures()) {
      const Real value = measure.compute({0, u, v});
      if (measure.name == "volume") {
        EXPECT_NEAR(value, 20 * J, 1e-11);
      }
      if (measure.name == "min_J") {
        EXPECT_NEAR(value, J, 1e-13);
      }
      if (measure.name == "mean_pressure") {
        EXPECT_NEAR(value, -2.5 * std::log(J), 1e-12);
      }
    }
  }
}

}  // namespace
}  // namespace meniscus::test_internal_force
