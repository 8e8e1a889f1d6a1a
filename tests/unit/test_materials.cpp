// SPDX-License-Identifier: BSD-3-Clause
// Every registered material law passes the same tests. The laws of the program also reproduce the
// reference values of tests/data/constitutive.json.
#include "meniscus/error.hpp"
#include "meniscus/physics/law_registry.hpp"
#include "thrown.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <ostream>
#include <random>

namespace meniscus::test_materials {
namespace {

using Matrix = Tensor<Real>;
constexpr Real epsilon = std::numeric_limits<Real>::epsilon();

std::unique_ptr<AnyLaw> law_from(std::string_view name, const std::string& toml) {
  const SceneInput scene = SceneInput::from_text(toml);
  auto law = laws().at(name).read(scene.root());
  scene.check();
  return law;
}

std::string fluid_text(const std::string& equation) {
  return "density = 1.25\nbulk_modulus = 2.5\nexponent = 7.0\nviscosity = 0.5\n"
         "bulk_viscosity = 0.25\nequation_of_state = \"" +
         equation + "\"\n";
}

Real largest(const Matrix& x) {
  Real m = 0;
  for (int k = 0; k < 9; ++k) m = std::max(m, std::abs(x(k / 3, k % 3)));
  return m;
}

void expect_near(const Matrix& actual, const Matrix& expected, Real tolerance, const char* what) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      EXPECT_NEAR(actual(i, j), expected(i, j), tolerance) << what << " " << i << j;
}

Matrix minus_identity(const Matrix& F) {
  return add_diagonal(F, -1.0);
}

/// Deformations from round-off size to large, all with J > 0.2, with and without rotation.
class Samples {
 public:
  Matrix random(Real size) {
    return Matrix::map([&](int, int) { return size * uniform_(generator_); });
  }

  Matrix rotation() {
    const Real a = 3 * uniform_(generator_), b = 3 * uniform_(generator_);
    const Matrix about_z{
        {{std::cos(a), -std::sin(a), 0}, {std::sin(a), std::cos(a), 0}, {0, 0, 1}}};
    const Matrix about_x{
        {{1, 0, 0}, {0, std::cos(b), -std::sin(b)}, {0, std::sin(b), std::cos(b)}}};
    return about_z * about_x * transpose(about_z);
  }

  std::vector<Matrix> displacement_gradients() {
    std::vector<Matrix> all;
    for (const Real size : {1e-9, 1e-5, 1e-3, 0.1, 0.3, 0.5})
      for (int n = 0; n < 12; ++n) {
        const Matrix H = random(size);
        if (1 + volume_change(H) > 0.2) all.push_back(H);
      }
    for (int n = 0; n < 12; ++n)
      all.push_back(minus_identity(rotation() * deformation_gradient(random(0.2))));
    return all;
  }

 private:
  std::mt19937_64 generator_{20240117};
  std::uniform_real_distribution<Real> uniform_{-1, 1};
};

/// A law under test: with its typical numbers, or with given ones.
struct Subject {
  std::string name, label, toml;
  std::unique_ptr<AnyLaw> law() const {
    return toml.empty() ? laws().at(name).typical() : law_from(name, toml);
  }
  friend std::ostream& operator<<(std::ostream& out, const Subject& s) { return out << s.label; }
};

std::vector<Subject> subjects() {
  std::vector<Subject> all;
  for (const auto& [name, entry] : laws())
    all.push_back({std::string(name), std::string(name), ""});
  for (const std::string equation : {"linear", "log", "tait"})
    all.push_back({"newtonian", "newtonian_" + equation, fluid_text(equation)});
  const std::string elastomer = "density = 1.25\nmu = 0.75\nbulk_modulus = 1.5\n";
  all.push_back({"liquid_crystal_elastomer", "liquid_crystal_elastomer_convected",
                 elastomer + "step_length = 2.5\ndirector = \"convected\"\n"
                             "reference_director = [0, 1, 0]\n"});
  all.push_back({"liquid_crystal_elastomer", "liquid_crystal_elastomer_oblate",
                 elastomer + "step_length = 0.4\nvolume_energy = \"logarithmic\"\n"
                             "reference_director = [1, 0, 0]\n"});
  return all;
}

class EveryLaw : public testing::TestWithParam<Subject> {
 protected:
  std::unique_ptr<AnyLaw> law = GetParam().law();
  Real modulus = law->p_wave_modulus();
  Samples samples;

  /// Size of the terms that add up to the stress at H: the scale for round-off.
  Real scale(const Matrix& H) const { return largest(law->stress(H)) + modulus * largest(H); }
};

INSTANTIATE_TEST_SUITE_P(Laws, EveryLaw, testing::ValuesIn(subjects()),
                         [](const auto& tested) { return tested.param.label; });

TEST_P(EveryLaw, IsStressFreeAtTheReference) {
  EXPECT_EQ(largest(law->stress(Matrix::zero())), 0);
  EXPECT_EQ(law->energy_density(Matrix::zero()), 0);
  EXPECT_EQ(law->check(), std::nullopt);
  EXPECT_EQ(law->warning(Matrix::zero()), std::nullopt);
  EXPECT_GT(law->density(), 0);
  EXPECT_GT(modulus, 0);
}

TEST_P(EveryLaw, IsObjective) {
  for (const Matrix& H : samples.displacement_gradients()) {
    const Matrix F = deformation_gradient(H), Q = samples.rotation(), F_rate = samples.random(1);
    const Matrix HQ = minus_identity(Q * F);
    expect_near(law->stress(HQ), Q * law->stress(H), 100 * epsilon * (scale(H) + modulus), "P");
    EXPECT_NEAR(law->energy_density(HQ), law->energy_density(H),
                100 * epsilon * (law->energy_density(H) + modulus));

    const Real w = 0.7;
    const Matrix spin{{{0, -w, 0.4}, {w, 0, -0.9}, {-0.4, 0.9, 0}}};
    const Matrix rotated_rate = Q * F_rate + spin * Q * F;
    const Matrix P = law->viscous_stress(H, F_rate);
    expect_near(law->viscous_stress(HQ, rotated_rate), Q * P, 300 * epsilon * (1 + largest(P)),
                "viscous P");
  }
}

TEST_P(EveryLaw, HasSymmetricKirchhoffStress) {
  for (const Matrix& H : samples.displacement_gradients()) {
    const Matrix Ft = transpose(deformation_gradient(H)), F_rate = samples.random(1);
    const Matrix elastic = law->stress(H) * Ft, viscous = law->viscous_stress(H, F_rate) * Ft;
    expect_near(elastic, transpose(elastic), 30 * epsilon * scale(H), "elastic");
    expect_near(viscous, transpose(viscous), 30 * epsilon * (1 + largest(viscous)), "viscous");
  }
}

TEST_P(EveryLaw, StressIsTheDerivativeOfTheEnergy) {
  constexpr Real step = 1e-100;
  for (const Matrix& H : samples.displacement_gradients()) {
    const Matrix derivative = Matrix::map([&](int i, int j) {
      auto z = Tensor<Complex>::map([&](int k, int l) { return Complex(H(k, l)); });
      z(i, j) += Complex(0, step);
      return law->energy_density(z).imag() / step;
    });
    expect_near(derivative, law->stress(H), 1e-12 * scale(H), "dW/dF");
  }
}

TEST_P(EveryLaw, EnergyIsNowhereNegative) {
  for (const Matrix& H : samples.displacement_gradients()) {
    EXPECT_GE(law->energy_density(H), 0);
    EXPECT_NEAR(law->energy_density(minus_identity(samples.rotation())), 0, 10 * epsilon * modulus);
  }
}

TEST_P(EveryLaw, FourPointsAtOnceGiveTheSame) {
  const auto all = samples.displacement_gradients();
  const auto rotated = [&](std::size_t first, int shift) {  // four samples, in shifted lanes
    Tensor<Lanes> t;
    for (int k = 0; k < 9; ++k)
      for (int lane = 0; lane < Lanes::width; ++lane)
        t(k / 3, k % 3)
            .set((lane + shift) % Lanes::width,
                 at(all, first + static_cast<std::size_t>(lane))(k / 3, k % 3));
    return t;
  };
  for (std::size_t first = 0; first + Lanes::width <= all.size(); ++first) {
    const Tensor<Lanes> H = rotated(first, 0), moved = rotated(first, 1);
    const Tensor<Lanes> F_rate = rotated((first * 7) % (all.size() - 4), 0);
    const Tensor<Lanes> P = law->stress(H), P_moved = law->stress(moved);
    const Tensor<Lanes> Pv = law->viscous_stress(H, F_rate);
    const Lanes W = law->energy_density(H);
    for (int lane = 0; lane < Lanes::width; ++lane) {
      const Matrix h = at(all, first + static_cast<std::size_t>(lane));
      const auto of_lane = [&](const Tensor<Lanes>& t, int n) {
        return Matrix::map([&](int i, int j) { return t(i, j)[n]; });
      };
      const Matrix rate = of_lane(F_rate, lane), exact_v = law->viscous_stress(h, rate);
      expect_near(of_lane(P, lane), law->stress(h), 8 * epsilon * scale(h), "P");
      expect_near(of_lane(Pv, lane), exact_v, 8 * epsilon * (largest(exact_v) + largest(rate)),
                  "Pv");
      EXPECT_NEAR(W[lane], law->energy_density(h),
                  16 * epsilon * (law->energy_density(h) + modulus * largest(h) * largest(h)));
      for (int k = 0; k < 9; ++k)
        EXPECT_EQ(P(k / 3, k % 3)[lane], P_moved(k / 3, k % 3)[(lane + 1) % Lanes::width]);
    }
  }
}

/// A law with fibres along z has the modulus of the stiffer direction.
TEST_P(EveryLaw, PWaveModulusIsThatOfUniaxialStrain) {
  for (int axis = GetParam().name == "guccione" ? 2 : 0; axis < 3; ++axis) {
    auto H = Tensor<Complex>::zero();
    H(axis, axis) = Complex(0, 1e-100);
    EXPECT_NEAR(law->stress(H)(axis, axis).imag() / 1e-100, modulus, 4 * epsilon * modulus);
    // The energy is also accurate, without cancellation.
    auto small = Matrix::zero();
    small(axis, axis) = 1e-9;
    EXPECT_NEAR(law->energy_density(small) / (0.5e-18 * modulus), 1, 1e-7);
  }
}

TEST_P(EveryLaw, ViscousStressIsLinearAndDissipates) {
  Real dissipated = 0;
  for (const Matrix& H : samples.displacement_gradients()) {
    const Matrix a = samples.random(1), b = samples.random(1);
    const Matrix Pa = law->viscous_stress(H, a), Pb = law->viscous_stress(H, b);
    expect_near(law->viscous_stress(H, a - 2.0 * b), Pa - 2.0 * Pb,
                30 * epsilon * (1 + largest(Pa) + largest(Pb)), "linear");
    EXPECT_GE(contract(Pa, a), 0);
    dissipated += contract(Pa, a);
  }
  EXPECT_EQ(dissipated > 0, laws().at(GetParam().name).viscous);
}

class ReferenceValues : public testing::Test {
 protected:
  nlohmann::json data =
      nlohmann::json::parse(std::ifstream(MENISCUS_TEST_DATA "/constitutive.json"));

  static Matrix matrix(const nlohmann::json& rows) {
    return Matrix::map(
        [&](int i, int j) { return rows.at(at_index(i)).at(at_index(j)).get<Real>(); });
  }

  std::unique_ptr<AnyLaw> solid(const std::string& name) const {
    std::string toml = "density = 1.0\n";
    for (const auto& [key, value] : data["parameters"][name].items())
      toml += key + " = " + value.dump() + "\n";
    return law_from(name, toml);
  }

  std::unique_ptr<AnyLaw> fluid(const std::string& equation) const {
    const auto& p = data["parameters"]["newtonian"];
    const Real mu = p["viscosity"], lambda_v = p["lambda_v"];
    nlohmann::json bulk_viscosity = lambda_v + 2 * mu / 3;
    return law_from("newtonian", "density = 1.0\nbulk_modulus = " + p["bulk_modulus"].dump() +
                                     "\nexponent = " + p["exponent"].dump() +
                                     "\nviscosity = " + p["viscosity"].dump() +
                                     "\nbulk_viscosity = " + bulk_viscosity.dump() +
                                     "\nequation_of_state = \"" + equation + "\"\n");
  }

  /// 1e-12 of the modulus, and 1e-13 of the stress itself near the identity.
  static void expect_reference(const AnyLaw& law, const Matrix& H, Real W, const Matrix& P,
                               const Matrix& sigma) {
    const Real near = largest(H) < 0.01 ? 1e-13 : 1e-12;
    const Real stress = largest(H) < 0.01 ? largest(P) : law.p_wave_modulus();
    EXPECT_NEAR(law.energy_density(H), W, near * (largest(H) < 0.01 ? W : law.p_wave_modulus()));
    expect_near(law.stress(H), P, near * stress, "P");
    const Real over_J = 1 / (1 + volume_change(H));
    expect_near(over_J * (law.stress(H) * transpose(deformation_gradient(H))), sigma, near * stress,
                "sigma");
  }

 private:
  static std::size_t at_index(int i) { return static_cast<std::size_t>(i); }
};

TEST_F(ReferenceValues, Solids) {
  for (const std::string name : {"st_venant_kirchhoff", "neo_hookean", "mooney_rivlin"})
    for (const auto& [label, c] : data["cases"].items()) {
      SCOPED_TRACE(name + " " + label);
      const auto& r = c[name];
      expect_reference(*solid(name), minus_identity(matrix(c["F"])), r["W"], matrix(r["P"]),
                       matrix(r["sigma"]));
    }
}

TEST_F(ReferenceValues, EquationsOfState) {
  for (const std::string equation : {"linear", "log", "tait"})
    for (const auto& [label, c] : data["cases"].items()) {
      SCOPED_TRACE(equation + " " + label);
      const auto& r = c["newtonian"][equation];
      expect_reference(*fluid(equation), minus_identity(matrix(c["F"])), r["U"], matrix(r["P"]),
                       Matrix::diagonal(r["sigma_m"].get<Real>()));
    }
}

TEST_F(ReferenceValues, Viscosity) {
  for (const auto& [label, c] : data["cases"].items()) {
    SCOPED_TRACE(label);
    const Matrix F = matrix(c["F"]), H = minus_identity(F);
    const Matrix P = fluid("linear")->viscous_stress(H, matrix(c["Fdot"]));
    const auto& r = c["newtonian"]["viscous"];
    expect_near(P, matrix(r["P_v"]), 1e-13, "P");
    expect_near((1 / (1 + volume_change(H))) * (P * transpose(F)), matrix(r["sigma_v"]), 1e-13,
                "sigma");
  }
}

TEST_F(ReferenceValues, SimpleShear) {
  const auto& r = data["simple_shear"];
  auto H = Matrix::zero();
  H(0, 1) = r["gamma"];
  const auto cauchy = [&](const std::string& name) {  // J = 1
    return solid(name)->stress(H) * transpose(deformation_gradient(H));
  };
  EXPECT_NEAR(cauchy("neo_hookean")(0, 1), r["nh_sigma12=mu*g"].get<Real>(), 4 * epsilon);
  EXPECT_NEAR(cauchy("neo_hookean")(0, 0), r["nh_sigma11=mu*g^2"].get<Real>(), 4 * epsilon);
  EXPECT_NEAR(cauchy("mooney_rivlin")(0, 1), r["mr_sigma12=2(c1+c2)g"].get<Real>(), 4 * epsilon);
}

TEST(StVenantKirchhoff, WarnsWhereEllipticityIsLost) {
  // Hydrostatic compression, for which the condition is exact: v^2 = (3 lambda + 2 mu)/(3 lambda +
  // 4 mu).
  for (const Real nu : {0.3, 0.45, 0.493}) {
    const Real lambda = 2 * nu / (1 - 2 * nu);  // with mu = 1
    const auto law = law_from("st_venant_kirchhoff",
                              "density = 1.0\nmu = 1.0\nlambda = " + nlohmann::json(lambda).dump());
    const Real critical = std::sqrt((3 * lambda + 2) / (3 * lambda + 4));
    EXPECT_FALSE(law->warning(Matrix::diagonal(critical * (1 + 1e-9) - 1)));
    EXPECT_TRUE(law->warning(Matrix::diagonal(critical * (1 - 1e-9) - 1)));
    EXPECT_FALSE(law->warning(Matrix::diagonal(1.0)));
  }
}

TEST(MooneyRivlin, WarnsWhereTheVolumetricEnergyIsNotConvex) {
  const auto law = laws().at("mooney_rivlin").typical();
  EXPECT_FALSE(law->warning(Matrix::diagonal(std::exp(1.0 / 3) * (1 - 1e-9) - 1)));
  EXPECT_TRUE(law->warning(Matrix::diagonal(std::exp(1.0 / 3) * (1 + 1e-9) - 1)));
}

TEST(LawRegistry, RefusesNumbersThatContradictEachOther) {
  EXPECT_THROW_WITH(law_from("mooney_rivlin", "density = 1.0\nc1 = 0.0\nc2 = 0.0\nlambda = 1.0\n"),
                    InputError, "the shear modulus 2 (c1 + c2) must be positive");
  EXPECT_THROW_WITH(law_from("neo_hookean", "density = 1.0\nmu = 3.0\nlambda = -2.0\n"), InputError,
                    "the bulk modulus lambda + 2/3 mu must be positive");
  EXPECT_THROW_WITH(law_from("st_venant_kirchhoff", "density = 1.0\nmu = 3.0\nlambda = -2.0\n"),
                    InputError, "the bulk modulus lambda + 2/3 mu must be positive");
}

TEST(LawRegistry, KnowsItsLaws) {
  for (const char* name : {"newtonian", "st_venant_kirchhoff", "neo_hookean", "mooney_rivlin",
                           "liquid_crystal_elastomer"})
    EXPECT_EQ(laws().at(name).name, name);
  EXPECT_EQ(laws().at("newtonian").keys().size(), 6U);
  EXPECT_THROW(register_entry(laws().at("newtonian")), std::logic_error);
  try {
    laws().at("neohookean");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("neo_hookean"), std::string::npos);
  }
}

}  // namespace
}  // namespace meniscus::test_materials
