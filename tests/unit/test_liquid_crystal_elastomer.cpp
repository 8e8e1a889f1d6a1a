// SPDX-License-Identifier: BSD-3-Clause
// Liquid crystal elastomer: reference values, the meaning of its parameters, and bodies made of it.
#include "meniscus/error.hpp"
#include "one_body.hpp"
#include "solve/step/central_difference.hpp"
#include "thrown.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <Eigen/Dense>
#include <fstream>

namespace meniscus::test_liquid_crystal_elastomer {
namespace {

using Matrix = Eigen::Matrix3d;
using Vector = Eigen::Vector3d;

Tensor<Real> tensor(const Matrix& x) {
  return Tensor<Real>::map([&](int i, int j) { return x(i, j); });
}
Matrix matrix(const Tensor<Real>& x) {
  Matrix m;
  for (int k = 0; k < 9; ++k) m(k / 3, k % 3) = x(k / 3, k % 3);
  return m;
}
Matrix matrix(const nlohmann::json& rows) {
  Matrix m;
  for (std::size_t k = 0; k < 9; ++k)
    m(static_cast<int>(k / 3), static_cast<int>(k % 3)) = rows.at(k / 3).at(k % 3).get<Real>();
  return m;
}
Vector vector(const nlohmann::json& x) {
  return {x.at(0).get<Real>(), x.at(1).get<Real>(), x.at(2).get<Real>()};
}

/// The elastomer with a director h that is an independent variable (constitutive note 4.1, 4.3).
struct FreeDirector {
  Real mu, s, lambda;

  Matrix l0(const Vector& h0) const { return Matrix::Identity() + (s - 1) * h0 * h0.transpose(); }
  Matrix over_l(const Vector& h) const {
    return Matrix::Identity() - (s - 1) / s * h * h.transpose();
  }
  Real energy(const Matrix& F, const Vector& h0, const Vector& h) const {
    const Real J = F.determinant();
    return mu / 2 * ((l0(h0) * F.transpose() * over_l(h) * F).trace() - 3 - 2 * std::log(J)) +
           lambda / 2 * (J - 1) * (J - 1);
  }
  /// dW/dF at fixed h
  Matrix stress(const Matrix& F, const Vector& h0, const Vector& h) const {
    const Real J = F.determinant();
    const Matrix Fit = F.inverse().transpose();
    return mu * (over_l(h) * F * l0(h0) - Fit) + lambda * J * (J - 1) * Fit;
  }
  Vector director_force(const Matrix& F, const Vector& h0, const Vector& h) const {
    return -mu * (s - 1) / s * F * l0(h0) * F.transpose() * h;
  }
};

class LiquidCrystalElastomer : public testing::Test {
 protected:
  nlohmann::json data =
      nlohmann::json::parse(std::ifstream(MENISCUS_TEST_DATA "/liquid_crystal_elastomer.json"));
  Real mu = data["parameters"]["mu"], s0 = data["parameters"]["step_length"];
  FreeDirector free{mu, s0, data["parameters"]["bulk_modulus"]};

  std::string numbers(const std::string& more) const {
    return "density = 1\nmu = " + data["parameters"]["mu"].dump() +
           "\nstep_length = " + data["parameters"]["step_length"].dump() +
           "\nbulk_modulus = " + data["parameters"]["bulk_modulus"].dump() + "\n" + more;
  }
  std::unique_ptr<AnyLaw> law(const std::string& more) const {
    const SceneInput scene = SceneInput::from_text(numbers(more));
    auto read = laws().at("liquid_crystal_elastomer").read(scene.root());
    scene.check();
    return read->at_time(0);
  }
};

TEST_F(LiquidCrystalElastomer, ModelOfTheFreeDirectorHasTheReferenceValues) {
  for (const auto& [label, c] : data["cases"].items()) {
    SCOPED_TRACE(label);
    const Matrix F = matrix(c["F"]);
    const Vector h0 = vector(c["director"]), h = vector(c["h"]);
    const auto& r = c["free"];
    const Matrix P = free.stress(F, h0, h), sigma = P * F.transpose() / F.determinant();
    EXPECT_NEAR(free.energy(F, h0, h), r["W"].get<Real>(), 1e-12 * mu);
    EXPECT_LT((P - matrix(r["P"])).norm(), 1e-12 * mu);
    EXPECT_LT((sigma - matrix(r["sigma"])).norm(), 1e-12 * mu);
    const Vector g = free.director_force(F, h0, h), s = g / F.determinant();
    EXPECT_LT((g - vector(r["dW_dh"])).norm(), 1e-12 * mu);
    // Without the reaction stress of the director, the Cauchy stress is not symmetric.
    const Real aligning = 0.625;
    const Matrix hs = h * s.transpose();
    const Matrix reaction = aligning / 2 * (hs + hs.transpose()) - 0.5 * (hs - hs.transpose());
    EXPECT_LT((reaction - matrix(r["reaction_sigma_lambda"])).norm(), 1e-12 * mu);
    EXPECT_LT((sigma + reaction - matrix(r["sigma_total"])).norm(), 1e-12 * mu);
    EXPECT_GT((sigma - sigma.transpose()).norm(), 1e-2 * mu);
    const Matrix total = sigma + reaction;
    EXPECT_LT((total - total.transpose()).norm(), 1e-12 * mu);
  }
}

TEST_F(LiquidCrystalElastomer, IsTheFreeDirectorMovedWithTheDeformation) {
  for (const std::string rule : {"normal", "convected"})
    for (const auto& [label, c] : data["cases"].items()) {
      SCOPED_TRACE(rule + " " + label);
      const auto material =
          law("director = \"" + rule + "\"\nreference_director = " + c["director"].dump());
      const Matrix F = matrix(c["F"]), over_F = F.inverse();
      const Vector h0 = vector(c["director"]).normalized();
      const Vector h =
          (rule == "normal" ? Vector(over_F.transpose() * h0) : Vector(F * h0)).normalized();
      // For the normal, dh = -(I - h h) F^-T dF^T h; for the line, dh = (I - h h) dF F^-1 h.
      const Vector g = free.director_force(F, h0, h), across = g - h * h.dot(g);
      const Matrix chain = rule == "normal" ? Matrix(-h * (over_F * across).transpose())
                                            : Matrix(across * (over_F * h).transpose());
      const Tensor<Real> H = tensor(F - Matrix::Identity());
      EXPECT_NEAR(material->energy_density(H), free.energy(F, h0, h), 1e-12 * mu);
      EXPECT_LT((matrix(material->stress(H)) - free.stress(F, h0, h) - chain).norm(), 1e-12 * mu);

      // The active Kirchhoff stress of the law is -zeta h h. The reference values use the Cauchy
      // stress -zeta h h, which is larger by the factor J.
      const auto active = law("activity = 0.4375\ndirector = \"" + rule +
                              "\"\nreference_director = " + c["director"].dump());
      const Matrix Pa = -0.4375 * h * (over_F * h).transpose();
      EXPECT_LT((matrix(active->stress(H)) - matrix(material->stress(H)) - Pa).norm(), 1e-12 * mu);
      const Vector given = vector(c["h"]);
      const Matrix reference = -0.4375 * F.determinant() * given * (over_F * given).transpose();
      EXPECT_LT((reference - matrix(c["free_active_P"])).norm(), 1e-12 * mu);
    }
}

TEST_F(LiquidCrystalElastomer, HasTheReferenceValues) {
  for (const auto& [label, c] : data["cases"].items())
    for (const auto& [rule, variants] : c["following"].items())
      for (const auto& [variant, r] : variants.items()) {
        SCOPED_TRACE(label + " " + rule + " " + variant);
        const auto material =
            law("director = \"" + rule + "\"\nreference_director = " + c["director"].dump() +
                "\nvolume_energy = " + r["volume_energy"].dump() +
                "\nstep_length_end = " + r["s"].dump() + "\nactivity = " + r["zeta"].dump());
        const Matrix F = matrix(c["F"]);
        const Tensor<Real> H = tensor(F - Matrix::Identity());
        const Matrix P = matrix(r["P"]);
        // At small strains, round-off is relative to the stress itself.
        const Real scale = label == "B_near_identity" ? std::min(mu, P.norm()) : mu;
        EXPECT_NEAR(material->energy_density(H), r["W"].get<Real>(), 1e-12 * scale);
        EXPECT_LT((matrix(material->stress(H)) - P).norm(), 1e-12 * scale);
        const auto four = Tensor<Lanes>::map([&](int i, int j) { return Lanes(H(i, j)); });
        const Tensor<Lanes> P_four = material->stress(four);
        for (int k = 0; k < 9; ++k)
          EXPECT_NEAR(P_four(k / 3, k % 3)[2], P(k / 3, k % 3), 1e-12 * scale);
      }
}

TEST_F(LiquidCrystalElastomer, FreeBarsAreInEquilibrium) {
  for (const std::string rule : {"normal", "convected"})
    for (const auto& bar : data["bars"]["kirchhoff"]) {
      const auto material =
          law("director = \"" + rule + "\"\nreference_director = [0, 0, 2]\nstep_length_end = " +
              bar["s"].dump() + "\nactivity = " + bar["zeta"].dump());
      const Vector stretch(bar["t"].get<Real>(), bar["t"].get<Real>(), bar["v"].get<Real>());
      const Tensor<Real> H = tensor(Matrix(stretch.asDiagonal()) - Matrix::Identity());
      EXPECT_LT(matrix(material->stress(H)).norm(), 1e-12 * mu) << bar.dump();
    }
  // A constant active Cauchy stress is a Kirchhoff stress that is larger by the factor J.
  const auto& fixed = data["bars"]["fixed_cauchy"];
  const Real t = fixed["t"], v = fixed["v"], zeta = fixed["zeta_cauchy"];
  EXPECT_NEAR(v, 1.12223, 5e-6);
  EXPECT_NEAR(t * t * v * zeta, data["bars"]["kirchhoff"][1]["zeta"].get<Real>(), 1e-15);
  EXPECT_NEAR(v, data["bars"]["kirchhoff"][1]["v"].get<Real>(), 1e-15);
}

TEST_F(LiquidCrystalElastomer, ShearModuliAlongAndAcrossTheDirector) {
  const auto modulus = [&](const AnyLaw& material, int i, int j) {
    auto H = Tensor<Complex>::zero();
    H(i, j) = Complex(0, 1e-100);
    return material.stress(H)(i, j).imag() / 1e-100;
  };
  const auto normal = law("reference_director = [0, 0, 1]");
  const auto convected = law("director = \"convected\"\nreference_director = [0, 0, 1]");
  for (const auto& material : {normal.get(), convected.get()})
    EXPECT_NEAR(modulus(*material, 0, 1), mu, 1e-15);
  EXPECT_NEAR(modulus(*normal, 0, 2), s0 * mu, 1e-14);
  EXPECT_NEAR(modulus(*normal, 2, 1), s0 * mu, 1e-14);
  EXPECT_NEAR(modulus(*convected, 0, 2), mu / s0, 1e-15);
  EXPECT_NEAR(modulus(*convected, 2, 1), mu / s0, 1e-15);
  // A director tilted by an angle has the energy mu (s - 1)^2/(2 s) sin^2.
  const Real angle = data["rest_tilt"]["angle"];
  const Real tilt =
      free.energy(Matrix::Identity(), Vector(0, 0, 1), Vector(std::sin(angle), 0, std::cos(angle)));
  EXPECT_NEAR(tilt, data["rest_tilt"]["W"].get<Real>(), 1e-15);
}

TEST_F(LiquidCrystalElastomer, RampsDoTheWorkTheyAreBookedFor) {
  const Tensor<Real> H{{{0.2, -0.1, 0.3}, {0.05, -0.2, 0.1}, {-0.15, 0.2, 0.1}}};
  const auto four = Tensor<Lanes>::map([&](int i, int j) { return Lanes(H(i, j)); });
  for (const std::string rule : {"normal", "convected"}) {
    const auto material = law(
        "director = \"" + rule +
        "\"\nreference_director = [1, 2, -2]\nstep_length_end = 1.2\nstep_length_ramp = [1, 3]\n"
        "activity = -0.7\nactivity_ramp = [0, 2]\n");
    const auto energy = [&](Real t) { return material->at_time(t)->energy_density(H); };
    for (const Real t : {0.3, 0.9, 1.6, 2.2, 2.9}) {
      const Real e = 1e-3;
      const Real rate =
          (8 * (energy(t + e) - energy(t - e)) - (energy(t + 2 * e) - energy(t - 2 * e))) /
          (12 * e);
      EXPECT_NEAR(material->at_time(t)->energy_rate(four)[1], rate, 1e-11);
    }
    EXPECT_EQ(material->at_time(3)->energy_rate(four)[0], 0);
    EXPECT_EQ(energy(3), energy(100));
    EXPECT_NE(energy(2.5), energy(3));
    EXPECT_EQ(
        energy(0),
        law("director = \"" + rule + "\"\nreference_director = [1, 2, -2]")->energy_density(H));
  }
}

template <int D>
Geometry<D> block() {
  return D == 3 ? test::brick<D>({3, 3, 4}, 0.2) : test::brick<D>({5, 4}, 0.2);
}

std::string body_text(const std::string& more) {
  return "density = 1.25\nmu = 0.75\nbulk_modulus = 1.5\nstep_length = 2\n" + more;
}

template <int D>
void expect_no_force_at_rest() {
  for (const Integration& integration : test::integrations())
    for (const std::string rule : {"normal", "convected"}) {
      const auto body = test::body_of<D>(block<D>());
      const auto term = test::internal_force<D>(
          *body, "liquid_crystal_elastomer",
          body_text("director = \"" + rule + "\"\nreference_director = " +
                    (D == 3 ? R"t(["1 + x", "sin(y)", "z*x - 2"])t" : R"t(["1 + x", "sin(y)"])t")),
          integration);
      const NodalVectors u(static_cast<std::size_t>(body->size()), Lanes::zero());
      NodalVectors force = u;
      term->add_force({0, u, u}, force);
      for (const NodalVector& f : force) EXPECT_EQ(sum(f * f), 0);
      EXPECT_EQ(term->stored_energy({0, u, u}), 0);
    }
}

TEST(LiquidCrystalElastomerBody, HasNoForceAtRest) {
  expect_no_force_at_rest<2>();
  expect_no_force_at_rest<3>();
}

TEST(LiquidCrystalElastomerBody, ForceIsTheGradientOfTheEnergyAlsoOfActivity) {
  for (const Integration& integration : test::integrations())
    for (const std::string rule : {"normal", "convected"}) {
      const auto body = test::body_of<3>(block<3>());
      const auto term = test::internal_force<3>(
          *body, "liquid_crystal_elastomer",
          body_text("activity = -0.6\nstep_length_end = 1.5\ndirector = \"" + rule +
                    "\"\nreference_director = [\"1 + x\", \"sin(y)\", \"z*x - 2\"]"),
          integration);
      const NodalVectors u = test::random_field<3>(body->size(), 0.06, 3);
      const NodalVectors direction = test::random_field<3>(body->size(), 1, 4);
      EXPECT_LT(test::gradient_error(*term, u, direction, 2e-3), 1e-7);
    }
}

TEST(LiquidCrystalElastomerBody, TakesItsDirectorFromTheWallsOrAFormula) {
  const auto force = [](const std::string& director,
                        const std::function<Vec<3>(const Vec<3>&)>& normal) {
    Geometry<3> geometry = block<3>();
    geometry.director = normal;
    const auto body = test::body_of<3>(std::move(geometry));
    const SceneInput scene = SceneInput::from_text(body_text(director));
    const auto material = laws().at("liquid_crystal_elastomer").material<3>(scene.root());
    scene.check();
    const NodalVectors u = test::random_field<3>(body->size(), 0.1, 5);
    NodalVectors f = test::zeros(u);
    material->build(*body, {}).force->add_force({0, u, u}, f);
    return f;
  };
  const auto outward = [](const Vec<3>& X) { return (X + Vec<3>(0, 0, 9)).normalized().eval(); };
  const NodalVectors walls = force("", outward);
  const NodalVectors formula = force("reference_director = [\"x\", \"y\", \"z + 9\"]", {});
  const NodalVectors constant = force("reference_director = [0, 0, 1]", outward);
  Real difference = 0, size = 0, other = 0;
  for (std::size_t A = 0; A < walls.size(); ++A) {
    size += sum(walls[A] * walls[A]);
    difference += sum((walls[A] - formula[A]) * (walls[A] - formula[A]));
    other += sum((walls[A] - constant[A]) * (walls[A] - constant[A]));
  }
  EXPECT_LT(difference, 1e-28 * size);
  EXPECT_GT(other, 1e-6 * size);
  try {
    force("", {});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("reference_director is missing"), std::string::npos);
  }
  EXPECT_THROW_WITH(force("reference_director = [\"x - x\", 0, 0]", {}), InputError,
                    "reference_director: (0, 0, 0) has no direction at X = (");
  EXPECT_THROW_WITH(force("reference_director = [1, 0]", {}), InputError,
                    "reference_director: has 2 ");
  EXPECT_THROW_WITH(force("reference_director = [1, 0, \"t\"]", {}), InputError,
                    "reference_director[2]: formula 't'");
  EXPECT_THROW_WITH(force("reference_director = [1, 0, 0]\nactivity_ramp = [2, 1]", {}), InputError,
                    "activity_ramp: ");
}

TEST(LiquidCrystalElastomerBody, ReportsFrankElasticity) {
  Geometry<3> geometry = block<3>();
  const auto body = test::body_of<3>(std::move(geometry));
  const auto note = [&](const std::string& more) {
    const SceneInput scene =
        SceneInput::from_text(body_text("reference_director = [1, 0, 0]\n" + more));
    return laws().at("liquid_crystal_elastomer").material<3>(scene.root())->build(*body, {}).note;
  };
  EXPECT_EQ(note(""), std::nullopt);
  const std::string text = note("frank_constant = 0.0075\n").value_or("");  // (0.1 spacings)^2 mu
  EXPECT_NE(text.find("is 0.1 of the mean spacing, which does not resolve it"), std::string::npos)
      << text;
  EXPECT_NE(text.find("0.0025 mu"), std::string::npos) << text;
  EXPECT_EQ(note("frank_constant = 3\n")->find("does not resolve"), std::string::npos);
}

/// Ramped activity in a body that spins and turns over: the error of the energy is of second order
/// in the step, and momenta are exact.
TEST(LiquidCrystalElastomerBody, KeepsEnergyAndMomenta) {
  const auto balance_error = [](const std::string& rule, int steps) {
    test::OneBody<3> one(
        block<3>(), "liquid_crystal_elastomer",
        body_text("director = \"" + rule +
                  "\"\nreference_director = [\"1\", \"0.3*x\", \"0.2*y\"]\nactivity = 0.3\n"
                  "activity_ramp = [0, 2]\nstep_length_end = 1.4\nstep_length_ramp = [0.5, 1.5]"));
    one.state.v = test::field_on<3>(
        one.body(), [](const Vec<3>& X) { return Vec<3>(Vec<3>(0.2, 0.1, -0.3).cross(X)); });
    start(one.system, one.state);
    Audit audit;
    const Ledger begin = take_ledger(one.system, one.state);
    one.state.books.momentum = begin.momentum;
    one.state.books.angular_momentum = begin.angular_momentum;
    audit.begin(begin);
    Real worst = 0;
    for (int n = 0; n < steps; ++n) {
      advance(one.system, one.state, 4.0 / steps);
      const Ledger ledger = take_ledger(one.system, one.state);
      audit.follow(one.system, one.state, ledger);
      worst = std::max(worst, std::abs(audit.balance_error(ledger)));
      EXPECT_LT(audit.momentum_error(ledger), 1e-13);
      EXPECT_LT(audit.angular_momentum_error(ledger), 1e-13);
    }
    EXPECT_GT(std::abs(one.state.books.external_work), 1e-3);
    return worst;
  };
  for (const std::string rule : {"normal", "convected"}) {
    const Real coarse = balance_error(rule, 40), fine = balance_error(rule, 80);
    EXPECT_LT(coarse, 0.05);
    EXPECT_LT(fine, 0.3 * coarse);
  }
}

}  // namespace
}  // namespace meniscus::test_liquid_crystal_elastomer
