// SPDX-License-Identifier: BSD-3-Clause
// The program as a library: names, units, errors, and the same numbers as a Simulation.
#include "meniscus/error.hpp"
#include "meniscus/run.hpp"
#include "run/simulation.hpp"
#include "thrown.hpp"

#include <gtest/gtest.h>

#include <filesystem>

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

}  // namespace
}  // namespace meniscus::test_run
