// SPDX-License-Identifier: BSD-3-Clause
// Stages of a scene, and runs that start where another run has ended.
#include "input/input.hpp"
#include "meniscus/error.hpp"
#include "meniscus/run.hpp"
#include "thrown.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace meniscus::test_stages {
namespace {

constexpr const char* two_stages = R"(
dimension = 2
[constants]
speed = 3
[time]
end = 1
safety = 0.5
[output]
measures = ["a"]
[[body]]
name = "block"
initial_velocity = ["speed", 0]
[[traction]]
name = "always"
[[stage]]
name = "first"
[stage.output]
measures = ["b"]
[[stage]]
name = "second"
[stage.time]
end = 2
[stage.constants]
speed = 4
[[stage.traction]]
name = "then"
[stage.expect.x]
value = 1
)";

SceneInput stage(const StageChoice& choice, const std::vector<std::string>& settings = {}) {
  return SceneInput::from_text(two_stages, "scene", settings, choice);
}

std::vector<std::string> names_of(const SceneInput& input, std::string_view tables) {
  std::vector<std::string> names;
  for (const Block& block : input.root().tables(tables)) names.push_back(block.text("name", ""));
  return names;
}

Real number(const SceneInput& input, std::string_view table, std::string_view key) {
  return input.root().table(table)->real(key, dimension::none, range::any, std::nullopt);
}

TEST(Stages, HaveTheTablesOfTheSceneAndTheirOwn) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(SceneInput::from_text(two_stages).stages(), (Names{"first", "second"}));
  const SceneInput first = stage({"first", ""}), second = stage({"second", "results/first"});
  EXPECT_EQ(number(first, "time", "end"), 1);
  EXPECT_EQ(number(second, "time", "end"), 2);
  EXPECT_EQ(number(second, "time", "safety"), 0.5);
  EXPECT_EQ(first.root().table("output")->texts("measures", std::nullopt), Names{"b"});
  EXPECT_EQ(second.root().table("output")->texts("measures", std::nullopt), Names{"a"});
  EXPECT_EQ(names_of(first, "traction"), Names{"always"});
  EXPECT_EQ(names_of(second, "traction"), (Names{"always", "then"}));
  EXPECT_FALSE(first.root().has("expect"));
  EXPECT_TRUE(second.root().table("expect")->has("x"));
  for (const SceneInput& input : {first, second}) EXPECT_FALSE(input.root().has("stage"));
  const SceneInput shorter = stage({"second", "results/first"}, {"stage.second.time.end=0.5"});
  EXPECT_EQ(number(shorter, "time", "end"), 0.5);
}

TEST(Stages, BeginWhereTheOneBeforeEnds) {
  const SceneInput first = stage({"first", ""}), second = stage({"second", "results/first"});
  EXPECT_FALSE(first.root().has("initial"));
  EXPECT_EQ(second.root().table("initial")->text("from", ""), "results/first");
  const Block body = first.root().tables("body").front();
  ASSERT_TRUE(body.has("initial_velocity"));
  EXPECT_EQ(body.reals("initial_velocity", 2, dimension::none, range::any, std::nullopt)[0], 3);
  EXPECT_FALSE(second.root().tables("body").front().has("initial_velocity"));
}

TEST(Stages, WhatIsWrongHasItsPlaceAndItsStage) {
  const auto stages_of = [](const std::string& text) {
    SceneInput::from_text("dimension = 2\n" + text, "s").stages();
  };
  EXPECT_THROW_WITH(stages_of("[[stage]]\n"), InputError, "s:2:1: stage[0].name: missing");
  EXPECT_THROW_WITH(stages_of("[[stage]]\nname = \"a/b\"\n"), InputError,
                    "s:3:8: stage[0].name: 'a/b' cannot be a name");
  EXPECT_THROW_WITH(stages_of("[[stage]]\nname = \"a\"\n[[stage]]\nname = \"a\"\n"), InputError,
                    "s:5:8: stage[1].name: the name 'a' is used twice");
  EXPECT_THROW_WITH(stages_of("[[stage]]\nname = \"a\"\n[[stage.body]]\n"), InputError,
                    "stage[0].body: is the same in all stages");
  EXPECT_THROW_WITH(stages_of("[stage]\nname = \"a\"\n"), InputError,
                    "s:2:1: stage: is a table; allowed is an array of tables, [[stage]]");
  const SceneInput second = stage({"second", "results/first"});
  second.root().table("time")->problem("end", "is late");
  EXPECT_THROW_WITH(second.check(), InputError,
                    "scene:22:7: time.end: is late (in stage 'second')");
  EXPECT_THROW_WITH(meniscus::Run::from_text(two_stages), InputError,
                    "the scene has stages, each of which is a scene");
}

/// A plane body that moves, with lines of its own in the table of the body and behind it.
std::string moving_body(const std::string& of_body = "", const std::string& material = "",
                        const std::string& rest = "") {
  return R"(dimension = 2
[time]
end = 0.2
[[body]]
name = "disk"
shape = "disk"
radius = 1
core = 3
rings = 2
)" + of_body +
         (material.empty() ? "[body.material]\ntype = \"neo_hookean\"\ndensity = 1\nmu = 1\nlambda "
                             "= 1\n"
                           : material) +
         rest;
}
const std::string spins = "initial_velocity = [\"-y\", \"x\"]\n";

/// A saved run, in a directory that is removed at the end.
class InitialFrom : public testing::Test {
 protected:
  InitialFrom()
      : folder_(std::filesystem::temp_directory_path() /
                (std::string("meniscus_test_") +
                 testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::remove_all(folder_);
  }
  ~InitialFrom() override { std::filesystem::remove_all(folder_); }

  meniscus::Run saved(const std::string& text) const {
    meniscus::Run run = meniscus::Run::from_text(text);
    run.advance_to(1);
    run.save(folder_.string());
    return run;
  }
  std::string from() const { return "[initial]\nfrom = \"" + folder_.string() + "\"\n"; }

  std::filesystem::path folder_;
};

TEST_F(InitialFrom, TheFirstStateIsTheLastOfTheOtherRun) {
  const meniscus::Run run = saved(moving_body(spins));
  const meniscus::Run next = meniscus::Run::from_text(moving_body("", "", from()));
  EXPECT_EQ(next.time(), 0);
  EXPECT_EQ(next.step(), 0);
  for (const char* field : {"position", "velocity", "J"})
    EXPECT_EQ(next.field("disk", field).values, run.field("disk", field).values) << field;
}

TEST_F(InitialFrom, LoadsMaterialAndVelocityMayBeOthers) {
  const meniscus::Run run = saved(moving_body(spins));
  const std::string softer =
      "[body.material]\ntype = \"neo_hookean\"\ndensity = 2\nmu = 0.1\nlambda = 1\n";
  const meniscus::Run next = meniscus::Run::from_text(
      moving_body("initial_velocity = [3, 0]\n", softer,
                  from() + "[[traction]]\nbody = \"disk\"\nwhere = 1\npressure = 0.1\n"));
  EXPECT_EQ(next.field("disk", "position").values, run.field("disk", "position").values);
  const std::vector<double> v = next.field("disk", "velocity").values;
  for (std::size_t A = 0; A < v.size(); A += 2) {
    EXPECT_NEAR(v[A], 3, 1e-12);
    EXPECT_NEAR(v[A + 1], 0, 1e-12);
  }
}

TEST_F(InitialFrom, WhatCameToRestIsAtRest) {
  const std::string relax = moving_body("initial_displacement = [\"0.01*x\", 0]\n");
  std::string text = relax;
  text.replace(text.find("end = 0.2"), 9, "end = 90\nsolver = \"relax\"");
  const meniscus::Run run = saved(text);
  const std::vector<double> last = run.field("disk", "velocity").values;
  EXPECT_GT(*std::max_element(last.begin(), last.end()), 0);  // artificial motion of relax
  const meniscus::Run next = meniscus::Run::from_text(moving_body("", "", from()));
  for (const double v : next.field("disk", "velocity").values) EXPECT_EQ(v, 0);
}

TEST_F(InitialFrom, DirectorsAreTaken) {
  const std::string nematic = R"([body.material]
type = "nematic"
density = 1
bulk_modulus = 20
viscosity = 0.5
frank_constant = 0.2
rotational_viscosity = 0.5
)";
  const meniscus::Run run = saved(moving_body(spins, nematic));
  const meniscus::Run next = meniscus::Run::from_text(moving_body("", nematic, from()));
  const std::vector<double> directors = run.field("disk", "director").values;
  EXPECT_EQ(next.field("disk", "director").values, directors);
  EXPECT_GT(std::abs(directors.front()), 0.1);  // turned from the y-axis
}

TEST_F(InitialFrom, ReferencesOfRemapsAreTaken) {
  const std::string drop = R"([body.material]
type = "newtonian"
density = 1
bulk_modulus = 20
viscosity = 0.1
[[surface_tension]]
body = "disk"
gamma = 0.1
)";
  const meniscus::Run run = saved(moving_body("initial_velocity = [\"x\", \"-y\"]\n", drop,
                                              "[[remap]]\nbody = \"disk\"\nat = [0.1]\n"));
  const meniscus::Run next = meniscus::Run::from_text(moving_body("", drop, from()));
  EXPECT_EQ(next.field("disk", "position").values, run.field("disk", "position").values);
  // The displacement is counted from the reference of the remap, half the way before.
  const std::vector<double> u = next.field("disk", "displacement").values;
  EXPECT_EQ(u, run.field("disk", "displacement").values);
  const auto [least, most] = std::minmax_element(u.begin(), u.end());
  EXPECT_GT(*most, 0.05);
  EXPECT_LT(std::max(*most, -*least), 0.15);
}

/// A plane on a spring has two places: in contact with the disk and before it.
TEST_F(InitialFrom, APressedPartnerStaysInContact) {
  const auto wall = [](const std::string& base) {
    return "[[contact]]\nname = \"wall\"\nbodies = [\"disk\"]\nepsilon = 20\nsigma0 = "
           "0.1\nbeta = 1\npartner = { type = \"half_space\", point = [0, 1.7], normal = [0, -1], "
           "direction = [0, -1], stiffness = 0.02, base = \"" +
           base + "\" }\n";
  };
  const auto way = [](const meniscus::Run& run) { return run.measure("wall.way"); };
  const meniscus::Run fresh = meniscus::Run::from_text(moving_body("", "", wall("0")));
  EXPECT_LT(way(fresh), 0.1);
  const meniscus::Run run = saved(moving_body("", "", wall("10*t")));
  EXPECT_GT(way(run), 0.5);
  const meniscus::Run next = meniscus::Run::from_text(moving_body("", "", from() + wall("2")));
  EXPECT_NEAR(way(next), way(run), 1e-12);
  const meniscus::Run back = meniscus::Run::from_text(moving_body("", "", from() + wall("0")));
  EXPECT_GT(way(back), 0.5);
}

TEST_F(InitialFrom, OtherBodiesAreRefusedByName) {
  saved(moving_body());
  std::string finer = moving_body("", "", from());
  finer.replace(finer.find("core = 3"), 8, "core = 4");
  EXPECT_THROW_WITH(meniscus::Run::from_text(finer), InputError,
                    "has the state of other bodies: body[0].core differs");
  EXPECT_THROW_WITH(
      meniscus::Run::from_text(moving_body("window = \"quintic_spline\"\n", "", from())),
      InputError, "has the state of other bodies: body[0].window differs");
  EXPECT_THROW_WITH(
      meniscus::Run::from_text(moving_body("initial_displacement = [\"x\", 0]\n", "", from())),
      InputError, "initial_displacement: has no meaning beside [initial]");
  EXPECT_THROW(
      meniscus::Run::from_text(moving_body("", "", "[initial]\nfrom = \"/no/such/run\"\n")),
      FileError);
  EXPECT_THROW_WITH(meniscus::Run::from_text(moving_body("", "", "[initial]\nfrom = \"\"\n")),
                    InputError, "initial.from: is empty");
}

}  // namespace
}  // namespace meniscus::test_stages
