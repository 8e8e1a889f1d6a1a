// SPDX-License-Identifier: BSD-3-Clause
// The program as a library: names, units, errors, and the same numbers as a Simulation.
#include "meniscus/error.hpp"
#include "meniscus/run.hpp"
#include "run/simulation.hpp"
#include "thrown.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <limits>

namespace meniscus::test_run {
namespace {

constexpr const char* drop = MENISCUS_TEST_DATA "/drop.toml";

TEST(Run, HasTheNumbersOfASimulation) {
  meniscus::Run run = meniscus::Run::from_file(drop);
  const SceneInput input = SceneInput::from_file(drop);
  ASSERT_EQ(scene_dimension(input), 2);
  Scene<2> scene = build_scene<2>(input);
  Simulation<2> simulation(scene);
  simulation.begin();
  while (!simulation.finished()) simulation.advance();
  run.advance_to(1);
  EXPECT_TRUE(run.finished());
  EXPECT_EQ(run.dimension(), 2);
  EXPECT_EQ(run.time(), simulation.state().time);
  EXPECT_EQ(run.step(), simulation.state().step);
  ASSERT_EQ(run.measures().size(), scene.measures.size());
  for (const MeasureSource& measure : scene.measures)
    EXPECT_EQ(run.measure(measure.name), measure.compute(simulation.state().motion()));
}

TEST(Run, FieldsHaveANumberForEveryParticleAndComponent) {
  const meniscus::Run run = meniscus::Run::from_file(drop);
  ASSERT_EQ(run.bodies(), std::vector<std::string>{"drop"});
  const std::size_t particles = run.field("drop", "mass").values.size();
  EXPECT_GT(particles, 20u);
  for (const std::string& name : run.fields("drop")) {
    const Field field = run.field("drop", name);
    EXPECT_EQ(field.values.size(), particles * static_cast<std::size_t>(field.components)) << name;
  }
  // The body is at rest in its reference: no displacement, F = I, positions within the ellipse.
  for (const double u : run.field("drop", "displacement").values) EXPECT_EQ(u, 0);
  for (const double J : run.field("drop", "J").values) EXPECT_NEAR(J, 1, 1e-14);
  const auto x = run.field("drop", "position").values;
  double longest = 0;
  for (std::size_t A = 0; A < particles; ++A) longest = std::max(longest, x[2 * A]);
  EXPECT_NEAR(longest, 1.1, 1e-12);
}

TEST(Run, SavedStatesContinueBitForBit) {
  const auto folder = std::filesystem::temp_directory_path() / "meniscus_test_run";
  std::filesystem::remove_all(folder);
  meniscus::Run run = meniscus::Run::from_file(drop);
  run.advance_to(0.02);
  run.save(folder.string());
  meniscus::Run other = meniscus::Run::from_file(drop);
  other.restore(folder.string());
  EXPECT_EQ(other.step(), run.step());
  run.advance_to(0.04);
  other.advance_to(0.04);
  EXPECT_EQ(other.time(), run.time());
  EXPECT_EQ(other.field("drop", "position").values, run.field("drop", "position").values);
  EXPECT_EQ(other.measure("drop.area"), run.measure("drop.area"));
  std::filesystem::remove_all(folder);
}

TEST(Run, NamesWhatIsWrong) {
  EXPECT_THROW_WITH(meniscus::Run::from_text("dimension = 4"), InputError, ": dimension: ");
  EXPECT_THROW(meniscus::Run::from_file("/no/such/scene.toml"), FileError);
  const meniscus::Run run = meniscus::Run::from_file(drop);
  const auto message = [](const auto& call) -> std::string {
    try {
      call();
    } catch (const InputError& e) {
      return e.what();
    }
    return "nothing thrown";
  };
  EXPECT_NE(message([&] { run.measure("drop.aera"); }).find("did you mean 'drop.area'"),
            std::string::npos);
  EXPECT_NE(message([&] { run.field("dorp", "J"); }).find("allowed is drop"), std::string::npos);
  EXPECT_NE(message([&] { run.field("drop", "K"); }).find("position"), std::string::npos);
}

TEST(Run, SnapshotsContinueBitForBit) {
  meniscus::Run run = meniscus::Run::from_file(drop), other = meniscus::Run::from_file(drop);
  run.advance_to(0.02);
  const SavedState middle = run.snapshot();
  run.advance_to(0.03);
  other.restore(middle);
  EXPECT_EQ(other.snapshot().hash(), middle.hash());
  other.advance_to(0.03);
  EXPECT_EQ(other.snapshot().hash(), run.snapshot().hash());
  EXPECT_NE(run.snapshot().hash(), middle.hash());
}

TEST(Run, StopsBetweenSteps) {
  meniscus::Run run = meniscus::Run::from_file(drop), same = meniscus::Run::from_file(drop);
  int asked = 0;
  run.stop_when([&] { return ++asked == 4; });
  EXPECT_THROW(run.advance_to(1), Interrupted);
  EXPECT_EQ(run.step(), 3);
  while (same.step() < 5) same.advance();
  while (run.step() < 5) run.advance();
  EXPECT_EQ(run.snapshot().hash(), same.snapshot().hash());
}

/// The force m_A g at each particle A.
ForceFunction weight_of(const meniscus::Run& run, double g) {
  return
      [mass = run.field("drop", "mass").values, g](
          double, std::span<const double> x, std::span<const double> v, std::span<double> force) {
        EXPECT_EQ(x.size(), 2 * mass.size());
        EXPECT_EQ(v.size(), 2 * mass.size());
        for (std::size_t A = 0; A < mass.size(); ++A) force[2 * A] = mass[A] * g;
      };
}

TEST(Run, ForcesMoveTheCentreAndDoWork) {
  meniscus::Run run = meniscus::Run::from_file(drop);
  const double begin = run.measure("drop.centre_x");
  run.add_force("drop", weight_of(run, 3));
  run.advance_to(0.04);
  const double t = run.time(), moved = run.measure("drop.centre_x") - begin;
  EXPECT_NEAR(moved / (3 * t * t / 2), 1, 1e-10);
  double mass = 0;
  for (const double m : run.field("drop", "mass").values) mass += m;
  EXPECT_NEAR(run.energies().at("external_work") / (mass * 3 * moved), 1, 0.02);
  EXPECT_EQ(run.unit("drop.centre_x"), "m");
  EXPECT_THROW_WITH(run.add_force("dorp", weight_of(run, 1)), InputError, "allowed is drop");
}

TEST(Run, AFailedForceEndsTheStep) {
  meniscus::Run run = meniscus::Run::from_file(drop);
  std::string wrong;
  run.add_force("drop", [&](double, std::span<const double>, std::span<const double>,
                            std::span<double> force) {
    if (wrong == "error") throw SolveError("the field is not known here");
    if (wrong == "nan") force[7] = std::numeric_limits<double>::quiet_NaN();
  });
  const SavedState begin = run.snapshot();
  run.advance();
  wrong = "error";
  EXPECT_THROW_WITH(run.advance(), SolveError,
                    "the field is not known here (force function on 'drop')");
  EXPECT_THROW_WITH(run.advance(), SolveError, "cannot go on after its failure at step 2");
  run.restore(begin);
  wrong = "nan";
  EXPECT_THROW_WITH(run.advance(), SolveError, "body 'drop', particle 3 at");
}

}  // namespace
}  // namespace meniscus::test_run
