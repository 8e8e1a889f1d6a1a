// SPDX-License-Identifier: BSD-3-Clause
// The selective form of q_scni: its energy, states in which it changes nothing, and its default.
// Tests for all rules are in test_internal_force.
#include "meniscus/error.hpp"
#include "physics/internal/cell_average.hpp"
#include "scene/scene.hpp"
#include "support.hpp"

#include <gtest/gtest.h>

namespace meniscus::test_cell_average {
namespace {

const Integration full{"q_scni", 0, "full"}, selective{"q_scni", 0, "cell_average"};

template <int D>
Geometry<D> jittered() {
  if constexpr (D == 3)
    return test::brick<3>({4, 3, 4}, 0.3);
  else
    return test::brick<2>({6, 5}, 0.3);
}

/// Both forms of a law on one body.
template <int D>
struct Pair {
  std::unique_ptr<Body<D>> body = test::body_of<D>(jittered<D>());
  std::unique_ptr<ForceTerm> one, other;

  explicit Pair(const std::string& law)
      : one(test::internal_force<D>(*body, law, full)),
        other(test::internal_force<D>(*body, law, selective)) {}

  void expect_equal_energy(const NodalVectors& u) {
    const Real energy = test::energy_of(*one, u);
    EXPECT_GT(energy, 0);
    EXPECT_NEAR(test::energy_of(*other, u), energy, 1e-12 * energy);
  }
  void expect_equal_force(const NodalVectors& u) {
    const NodalVectors force = test::force_of(*one, u);
    EXPECT_LT(test::norm(test::sum_of(test::force_of(*other, u), -1, force)),
              1e-12 * test::norm(force));
  }
};

template <int D>
void expect_equal() {
  for (const auto& entry : test::law_texts()) {
    SCOPED_TRACE(entry.first);
    Pair<D> pair(entry.first);
    // Both forms give the same energy in the linear patch test.
    const NodalVectors homogeneous = test::field_on<D>(
        *pair.body, [](const Vec<D>& X) { return Vec<D>(0.1 * X + 0.2 * X[1] * Vec<D>::Unit(0)); });
    pair.expect_equal_energy(homogeneous);
    pair.expect_equal_force(homogeneous);
    // F varies in each cell, but J = 1 does not (fluids are excluded, since their energy is zero
    // here).
    if (!laws().at(entry.first).viscous)
      pair.expect_equal_energy(test::field_on<D>(*pair.body, [](const Vec<D>& X) {
        return Vec<D>(0.15 * X[1] * X[1] * Vec<D>::Unit(0));
      }));
  }
}

TEST(CellAverage, ChangesNothingWhereJIsConstant) {
  expect_equal<2>();
  expect_equal<3>();
}

/// For small displacements, the energy is the sum of w [mu dev e : dev e + kappa/2 mean(tr e)^2],
/// with the 3D deviator also in plane strain.
template <int D>
void expect_linear_energy() {
  const auto body = test::body_of<D>(jittered<D>());
  const auto term = test::internal_force<D>(*body, "neo_hookean", selective);
  constexpr Real mu = 0.75, kappa = 1.5 + 2 * mu / 3, size = 1e-40;
  const NodalVectors u = test::random_field<D>(body->size(), size, 5);
  const CellRule<D> rule = build_cell_rule(*body).rule;
  Real energy = 0;
  for (Index L = 0; L < rule.groups(); ++L) {
    Tensor<Lanes> H;
    rule.gather(L, u.data(), H);
    const Tensor<Lanes> e = Lanes(0.5 / size) * (H + transpose(H));
    const Lanes w = rule.weight(L), dilatation = trace(e);
    const Real mean = sum(w * dilatation) / at(rule.volume, L);
    energy += sum(mu * w * (contract(e, e) - (1.0 / 3.0) * dilatation * dilatation)) +
              0.5 * kappa * at(rule.volume, L) * mean * mean;
  }
  EXPECT_NEAR(test::energy_of(*term, u) / (size * size), energy, 1e-12 * energy);
  const auto point_by_point = test::internal_force<D>(*body, "neo_hookean", full);
  EXPECT_GT(test::energy_of(*point_by_point, u) / (size * size), 1.05 * energy);
}

TEST(CellAverage, AveragesTheDilatationOfSmallStrains) {
  expect_linear_energy<2>();
  expect_linear_energy<3>();
}

/// The pressure belongs to the mean of J over the cell.
TEST(CellAverage, PressureIsConstantInEachCell) {
  const auto body = test::body_of<2>(jittered<2>());
  const auto term = test::internal_force<2>(*body, "newtonian", selective);
  const NodalVectors u = test::random_field<2>(body->size(), 0.06, 9), v = test::zeros(u);
  std::vector<Real> J(static_cast<std::size_t>(body->size())), pressure = J;
  for (const FieldSource& field : term->fields()) {
    if (field.name == "J") field.compute({0, u, v}, J);
    if (field.name == "pressure") field.compute({0, u, v}, pressure);
  }
  for (std::size_t A = 0; A < J.size(); ++A)
    EXPECT_NEAR(pressure[A], -2.5 * std::log(J[A]), 1e-12) << A;
}

std::string scene(const std::string& keys, const std::string& lambda) {
  return "dimension = 2\ntime = { end = 1 }\n[[body]]\nname = \"b\"\nshape = \"rectangle\"\ncells "
         "= "
         "[4, 4]\nsize = [1, 1]\n" +
         keys + "material = { type = \"neo_hookean\", density = 1, mu = 1, lambda = " + lambda +
         " }\n";
}

/// True if the notes of the scene mention the cell average.
bool averages(const std::string& text) {
  const SceneInput input = SceneInput::from_text(text);
  EXPECT_EQ(scene_dimension(input), 2);
  const Scene<2> built = build_scene<2>(input);
  for (const std::string& note : built.notes)
    if (note.find("volumetric = \"cell_average\"") != std::string::npos) return true;
  return false;
}

TEST(CellAverage, IsTheDefaultForNearlyIncompressibleSolids) {
  EXPECT_TRUE(averages(scene("", "1000")));
  EXPECT_FALSE(averages(scene("", "999")));
  EXPECT_TRUE(averages(scene("", "\"10 + 1e3*exp(x)\"")));
  EXPECT_FALSE(averages(scene("volumetric = \"full\"\n", "1e4")));
  EXPECT_TRUE(averages(scene("volumetric = \"cell_average\"\n", "1")));
  EXPECT_FALSE(averages(scene("integration = \"gauss\"\n", "1e4")));
}

TEST(CellAverage, NeedsCells) {
  try {
    build_scene<2>(SceneInput::from_text(
        scene("integration = \"gauss\"\nvolumetric = \"cell_average\"\n", "1")));
    FAIL() << "not refused";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("volumetric"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("nodal cells"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace meniscus::test_cell_average
