// SPDX-License-Identifier: BSD-3-Clause
// Young's modulus and Poisson's ratio of every isotropic law, measured in a tension test.
#include "input_scene.hpp"
#include "meniscus/error.hpp"
#include "meniscus/physics/law_registry.hpp"
#include "physics/internal/elastic_moduli.hpp"
#include "surface_scenes.hpp"

#include <gtest/gtest.h>

namespace meniscus::test_elastic_moduli {
namespace {

bool knows_moduli(const LawEntry& law) {
  const std::vector<KeyText> keys = law.keys();
  return std::any_of(keys.begin(), keys.end(),
                     [](const KeyText& key) { return key.key == "youngs_modulus"; });
}

std::unique_ptr<AnyLaw> read(const std::string& law, const std::string& lines) {
  const SceneInput input = SceneInput::from_text("density = 1\n" + lines, "s.toml");
  auto read = laws().at(law).read(input.root());
  input.root().done();
  input.check();
  return read;
}

std::string complaint(const std::string& law, const std::string& lines) {
  return input_test::report("density = 1\n" + lines, [&](const Block& root) {
    laws().at(law).material<3>(root);
    root.done();
  });
}

TEST(ElasticModuli, ABarStretchesByForceOverYoungsModulusAndThinsByPoissonsRatio) {
  int isotropic = 0;
  for (const auto& [name, law] : laws()) {
    if (!knows_moduli(law)) continue;
    ++isotropic;
    for (const Real nu : {-0.5, 0.0, 0.3, 0.4999}) {
      const Real E = 3e6, stretch = 1e-9;
      const std::string c2 = name == "mooney_rivlin" ? "c2 = 2e5\n" : "";
      const auto bar =
          read(std::string(name),
               fmt::format("youngs_modulus = '3 MPa'\npoissons_ratio = {}\n{}", nu, c2));
      Tensor<Real> H = Tensor<Real>::zero();
      H(0, 0) = stretch;
      H(1, 1) = H(2, 2) = -nu * stretch;
      const Tensor<Real> P = bar->stress(H);
      const Real tolerance = 1e-7 * bar->p_wave_modulus() * stretch;
      EXPECT_NEAR(P(0, 0), E * stretch, tolerance) << name << " " << nu;
      EXPECT_NEAR(P(1, 1), 0, tolerance) << name << " " << nu;
      EXPECT_NEAR(bar->p_wave_modulus(), E * (1 - nu) / ((1 + nu) * (1 - 2 * nu)),
                  1e-12 * bar->p_wave_modulus())
          << name << " " << nu;
    }
  }
  EXPECT_EQ(isotropic, 4);
}

TEST(ElasticModuli, MayBeFormulasOfPlaceAndOfConstants) {
  const SceneInput input = SceneInput::from_text(
      "youngs_modulus = 'stiff*(1 + x/length)'\npoissons_ratio = '0.1 + y'\n"
      "[constants]\nstiff = '2 MPa'\nlength = '10 m'",
      "s.toml");
  const Block& root = input.root();
  supply_moduli(root, std::to_array<OfModuli>({{"mu", "{E}/(2*(1 + {nu}))"}}));
  const Expression mu =
      root.expression("mu", dimension::pressure, {}, range::positive, Variables::place);
  root.done();
  input.check();
  EXPECT_DOUBLE_EQ(mu({5, 0.2, 0}), 3e6 / (2 * 1.3));
  EXPECT_EQ(mu.place(), "s.toml:1:18: youngs_modulus: mu, which follows from it");
}

TEST(ElasticModuli, CompleteInputReadsBackTheSame) {
  const auto p_wave = [](const SceneInput& input) {
    const Real M = laws().at("neo_hookean").read(input.root())->p_wave_modulus();
    input.root().done();
    input.check();
    return M;
  };
  const SceneInput input = SceneInput::from_text(
      "units.system = 'um-us-ng'\ndensity = 1\nyoungs_modulus = '3.3 kPa'\npoissons_ratio = 0.37");
  const Real M = p_wave(input);
  const std::string complete = input.complete();
  EXPECT_EQ(complete.find("mu"), std::string::npos) << complete;
  EXPECT_NE(complete.find("youngs_modulus = "), std::string::npos) << complete;
  EXPECT_EQ(p_wave(SceneInput::from_text(complete)), M);
}

/// If a graded modulus makes a derived parameter leave its range, the message names the modulus.
TEST(ElasticModuli, AGradedModulusIsNamedWhereItIsBad) {
  std::string said;
  try {
    test::scene_of<2>(
        "dimension = 2\n[time]\nend = 1\n" + test::ball_of(2, 4, 2) +
        "[body.material]\ntype = \"neo_hookean\"\ndensity = 1\nyoungs_modulus = \"1 + 2*x\"\n"
        "poissons_ratio = 0.3\n");
  } catch (const InputError& error) {
    said = error.what();
  }
  EXPECT_NE(said.find("material.youngs_modulus: mu, which follows from it: at x = -"),
            std::string::npos)
      << said;
}

TEST(ElasticModuli, Messages) {
  const std::string both = "youngs_modulus = 1e6\npoissons_ratio = 0.3\n";
  EXPECT_EQ(complaint("neo_hookean", both), "");
  EXPECT_EQ(complaint("neo_hookean", both + "mu = 1"),
            "s.toml:4:6: mu: is given beside youngs_modulus and poissons_ratio; allowed are those "
            "two, or mu and lambda without them");
  EXPECT_EQ(complaint("mooney_rivlin", both + "c2 = 0\nlambda = '1 Pa'\nc1 = 3"),
            "s.toml:5:10: lambda: is given beside youngs_modulus and poissons_ratio; allowed are "
            "those two, or c1 and lambda without them\n"
            "s.toml:6:6: c1: is given beside youngs_modulus and poissons_ratio; allowed are those "
            "two, or c1 and lambda without them");
  EXPECT_EQ(
      complaint("st_venant_kirchhoff", "youngs_modulus = 1e6"),
      "s.toml:1:1: poissons_ratio: missing; allowed is a number or a formula of x, y, z, > -1 "
      "and < 0.5");
  EXPECT_EQ(
      complaint("st_venant_kirchhoff", "poissons_ratio = 0.3"),
      "s.toml:1:1: youngs_modulus: missing; allowed is a number in Pa or a text with a unit or "
      "a formula of x, y, z, > 0");
  EXPECT_EQ(complaint("neo_hookean", "youngs_modulus = 1e6\npoissons_ratio = 0.5"),
            "s.toml:3:18: poissons_ratio: 0.5 is out of range; allowed is > -1 and < 0.5");
  EXPECT_EQ(complaint("neo_hookean", "youngs_modulus = '1 N'\npoissons_ratio = 0.3").substr(0, 60),
            "s.toml:2:18: youngs_modulus: neither a quantity ('1 N' is a ");
  EXPECT_EQ(complaint("mooney_rivlin", both + "c2 = 1e6").substr(0, 72),
            "s.toml:2:18: youngs_modulus: c1, which follows from it: -807692.30769230");
  EXPECT_NE(complaint("newtonian", both).find("neo_hookean, st_venant_kirchhoff and mooney_rivlin"),
            std::string::npos);
}

}  // namespace
}  // namespace meniscus::test_elastic_moduli
