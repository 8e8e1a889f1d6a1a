// SPDX-License-Identifier: BSD-3-Clause
// Named numbers of a scene: places where they are allowed, dimensions of formulas with them,
// messages.
#include "input/input.hpp"
#include "input_scene.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <ctime>

namespace meniscus::test_constants {
namespace {

using input_test::report;

const std::string constants = R"toml(
[constants]
radius = "5 nm"
gamma = "72.8 mN/m"
laplace = "2*gamma/radius"       # of what stands further down, too
ratio = 1.5
layers = 3
small = "radius/shrink"
shrink = "2 + 2"
angle = "30 deg"
)toml";

SceneInput scene(const std::string& keys, const std::vector<std::string>& settings = {}) {
  return SceneInput::from_text(keys + constants, "s.toml", settings);
}

Real real(const std::string& value, Dimension d, const std::vector<std::string>& settings = {}) {
  const SceneInput input = scene("key = " + value, settings);
  const Real read = input.root().real("key", d, range::any, {});
  input.check();
  return read;
}

std::string complaint(const std::string& value, Dimension d, Range allowed = range::any) {
  return report("key = " + value + constants,
                [&](const Block& root) { root.real("key", d, allowed, {}); });
}

TEST(Constants, NumbersMayBeFormulasOfThem) {
  using namespace dimension;
  EXPECT_EQ(real("'radius'", length), 5e-9);
  EXPECT_EQ(real("'2*gamma/radius'", pressure), 2 * 0.0728 / 5e-9);
  EXPECT_EQ(real("'laplace'", pressure), 2 * 0.0728 / 5e-9);
  EXPECT_EQ(real("'-small^2'", area), -(5e-9 / 4) * (5e-9 / 4));
  EXPECT_EQ(real("'ratio'", none), 1.5);
  EXPECT_DOUBLE_EQ(real("'sin(angle)'", none), 0.5);
  EXPECT_EQ(real("'max(ratio, layers)'", none), 3);
  EXPECT_EQ(real("'72.8 mN/m'", tension), 0.0728);  // as without constants
  // Plain numbers have the units of the scene.
  EXPECT_EQ(real("'2*ratio'", velocity), 3);
  EXPECT_EQ(real("'radius + 1e-9'", length), 5e-9 + 1e-9);
  EXPECT_EQ(real("'gamma*radius/ratio'", viscosity), 0.0728 * 5e-9 / 1.5);
  EXPECT_EQ(real("'gamma*radius/shrink'", viscosity), 0.0728 * 5e-9 / 4);
}

TEST(Constants, AreInTheUnitsOfTheScene) {
  const SceneInput input = SceneInput::from_text(
      "units.system = 'nm-ps-ag'\nkey = 'p*r/2'\n[constants]\nr = '5 nm'\np = '1 MPa'");
  EXPECT_EQ(input.root().real("key", dimension::tension, range::any, {}), 5 * 1e-6 / 2);
  input.check();
}

TEST(Constants, ListsIntegersAndFormulasMayUseThem) {
  const SceneInput input = scene(
      "axes = ['radius', 2e-9, '3 nm']\ncells = '2*layers'\nlaw = '2e9*(1 + x/radius)'\n"
      "speed = ['ratio*t', '1 m/s']\nfixed = 'gamma*ratio'");
  const Block& root = input.root();
  EXPECT_EQ(root.reals("axes", 3, dimension::length, range::positive, {}),
            (std::vector<Real>{5e-9, 2e-9, 3e-9}));
  EXPECT_EQ(root.integer("cells", range::positive, {}), 6);
  const Expression law = root.expression("law", dimension::pressure, {}, range::positive);
  EXPECT_EQ(law.text(), "2e9*(1 + x/radius)");
  EXPECT_EQ(law({5e-9, 0, 0}), 4e9);
  EXPECT_EQ(root.expressions("speed", 2, dimension::velocity, {})[0]({0, 0, 0}, 2), 3);
  const Expression fixed = root.expression("fixed", dimension::tension, {});
  EXPECT_TRUE(fixed.constant());
  EXPECT_EQ(fixed({0, 0, 0}), 0.0728 * 1.5);
  input.check();
}

TEST(Constants, SettingsChangeThem) {
  EXPECT_EQ(real("'2*gamma/radius'", dimension::pressure, {"constants.radius=10 nm"}),
            2 * 0.0728 / 10e-9);
  EXPECT_EQ(real("'laplace'", dimension::pressure, {"constants.gamma='2*ratio'"}), 2 * 3 / 5e-9);
  EXPECT_EQ(real("'r'", dimension::none, {"constants={r = 2}"}), 2);
  EXPECT_EQ(
      report("key = 1" + constants, [](const Block&) {}, {"constants.radus=1"}),
      "--set 'constants.radus=1': constants.radus: no such constant in the scene; allowed are "
      "radius, gamma, laplace, ratio, layers, small, shrink, angle; did you mean 'radius'?");
  EXPECT_EQ(report("key = 1", [](const Block&) {}, {"constants.r=1"}),
            "--set 'constants.r=1': 'constants' is not in the scene; allowed is key");
}

TEST(Constants, CompleteInputReadsBackTheSame) {
  const auto read = [](const SceneInput& input) {
    const Real p = input.root().real("key", dimension::pressure, range::any, {});
    const Expression law = input.root().expression("law", dimension::pressure, {});
    input.root().done();
    input.check();
    return std::pair(p, law({1e-9, 0, 0}));
  };
  const SceneInput input = scene("key = 'laplace/3'\nlaw = 'laplace*x/small'");
  const auto first = read(input);
  const SceneInput again = SceneInput::from_text(input.complete());
  EXPECT_EQ(read(again), first);
  EXPECT_NE(input.complete().find("laplace = 29120000.0  # Pa\n"), std::string::npos)
      << input.complete();
}

TEST(Constants, AFormulaOfAnotherDimensionIsRefused) {
  using namespace dimension;
  EXPECT_EQ(complaint("'radius'", pressure),
            "s.toml:1:7: key: formula 'radius' is a length (m), expected a pressure (kg/(m s^2)); "
            "allowed is a number in Pa or a text with a unit or a formula of [constants]");
  EXPECT_EQ(complaint("'gamma*radius'", none),
            "s.toml:1:7: key: formula 'gamma*radius' is a force (kg m/s^2), expected a plain "
            "number; allowed is a number or a formula of [constants]");
  EXPECT_EQ(complaint("'sqrt(radius^4)'", pressure).substr(0, 60),
            "s.toml:1:7: key: formula 'sqrt(radius^4)' is an area (m^2), ");
  EXPECT_EQ(complaint("'gamma/radius^2*1e-9'", pressure).substr(0, 66),
            "s.toml:1:7: key: formula 'gamma/radius^2*1e-9' is a quantity in kg");
  EXPECT_EQ(
      report("key = 'radius'" + constants,
             [](const Block& root) { root.expression("key", tension, {}); }),
      "s.toml:1:7: key: formula 'radius' is a length (m), expected a tension (kg/s^2); allowed "
      "is a number in N/m or a text with a unit or a formula of x, y, z, t or a formula of "
      "[constants]");
  EXPECT_EQ(report("key = 'radius'" + constants,
                   [](const Block& root) { root.integer("key", range::positive, {}); }),
            "s.toml:1:7: key: formula 'radius' is a length (m), expected a plain number");
}

/// A formula reads 30 deg as 0.52 radians; a contact angle would read 0.52 as half a degree.
TEST(Constants, AnglesAreNoDegrees) {
  using namespace dimension;
  EXPECT_EQ(real("'20*ratio'", degrees), 30);
  EXPECT_EQ(complaint("'2*angle'", degrees),
            "s.toml:1:7: key: formula '2*angle' has a constant in deg or rad, whose number is that "
            "of radians, expected an angle (deg); give the constant as a number of degrees, "
            "without a unit; allowed is a number in deg or a text with a unit or a formula of "
            "[constants]");
}

TEST(Constants, MessagesAboutTheirUse) {
  using namespace dimension;
  EXPECT_EQ(complaint("'2*radus'", length).substr(0, 59),
            "s.toml:1:7: key: unknown unit 'radus'; allowed are m, s, g,");
  EXPECT_EQ(
      complaint("'ratio*radus'", length),
      "s.toml:1:7: key: formula 'ratio*radus': unknown name 'radus' at character 7; allowed "
      "are x, y, z, t, pi, e, the [constants] and functions such as sqrt; did you mean "
      "'radius'?; allowed is a number in m or a text with a unit or a formula of [constants]");
  EXPECT_EQ(
      complaint("'radius*t'", length),
      "s.toml:1:7: key: formula 'radius*t': a single number knows no x, y, z, t; allowed is a "
      "number in m or a text with a unit or a formula of [constants]");
  EXPECT_EQ(complaint("'-radius'", length, range::positive),
            "s.toml:1:7: key: -5e-09 m is out of range; allowed is > 0");
  EXPECT_EQ(complaint("'1/(ratio - ratio)'", none),
            "s.toml:1:7: key: inf is out of range; allowed is a finite number");
  EXPECT_EQ(complaint("'3 radius'", length).substr(0, 66),
            "s.toml:1:7: key: formula '3 radius': unexpected 'radius' at charac");
  EXPECT_EQ(report("key = 'ratio'" + constants,
                   [](const Block& root) { root.integer("key", range::positive, {}); }),
            "s.toml:1:7: key: formula 'ratio' is 1.5; allowed is an integer > 0");
  EXPECT_EQ(report("key = 'layers - 7'" + constants,
                   [](const Block& root) { root.integer("key", range::positive, {}); }),
            "s.toml:1:7: key: -4 is out of range; allowed is > 0");
}

/// The message about a scene with these constants, in which a key uses `a`.
std::string own_complaint(const std::string& lines) {
  return report("[constants]\n" + lines + "\n[time]\nend = 'a*b*c'", [](const Block& root) {
    root.table("time")->real("end", dimension::time, range::positive, {});
  });
}

TEST(Constants, MessagesAboutThemselvesComeOnceAndNotAtTheirUse) {
  EXPECT_EQ(
      own_complaint("a = 'b'\nb = '2*c'\nc = 'a + 1'"),
      "s.toml:4:5: constants.c: needs itself: a -> b -> c -> a; allowed are formulas of other "
      "constants");
  EXPECT_EQ(
      own_complaint("a = 'a'\nb = 1\nc = 2"),
      "s.toml:2:5: constants.a: needs itself: a -> a; allowed are formulas of other constants");
  EXPECT_EQ(own_complaint("a = '2*d'\nb = 'a'\nc = 2").substr(0, 81),
            "s.toml:2:5: constants.a: neither a quantity (unknown unit 'd'; allowed are m, s, ");
  EXPECT_EQ(
      own_complaint("a = 'b*q'\nb = 1\nc = 2"),
      "s.toml:2:5: constants.a: formula 'b*q': unknown name 'q' at character 3; allowed are x, "
      "y, z, t, pi, e, the [constants] and functions such as sqrt");
  EXPECT_EQ(own_complaint("a = '2*x'\nb = 1\nc = 2").substr(0, 49),
            "s.toml:2:5: constants.a: neither a quantity (unkn");
  EXPECT_EQ(own_complaint("a = 'b/0'\nb = 1\nc = 2"),
            "s.toml:2:5: constants.a: inf is out of range; allowed is a finite number");
  EXPECT_EQ(own_complaint("a = nan\nb = 1\nc = 2"),
            "s.toml:2:5: constants.a: nan is out of range; allowed is a finite number");
  EXPECT_EQ(own_complaint("a = [1]\nb = true\nc = 2"),
            "s.toml:2:5: constants.a: is an array; allowed is a number, a text with a unit, or a "
            "formula of [constants]\n"
            "s.toml:3:5: constants.b: is a boolean; allowed is a number, a text with a unit, or a "
            "formula of [constants]");
  EXPECT_EQ(own_complaint("a = '1e999 m'\nb = 1\nc = 1").substr(0, 34),
            "s.toml:2:5: constants.a: the numbe");
}

TEST(Constants, NamesThatMeanSomethingElseAreRefused) {
  const auto named = [](const std::string& name) {
    return report("[constants]\n" + name + " = 2\n[time]\nend = '2 h'", [](const Block&) {});
  };
  EXPECT_EQ(named("h"),
            "s.toml:2:5: constants.h: 'h' is a unit, and 2*h could be both; allowed is any other "
            "name, such as h_0");
  EXPECT_EQ(named("kT").substr(0, 39), "s.toml:2:6: constants.kT: 'kT' is a uni");
  for (const char* word : {"x", "t", "pi", "e", "sqrt", "max"})
    EXPECT_NE(named(word).find("has a meaning in formulas already"), std::string::npos) << word;
  for (const char* word : {"2a", "a-b", "'a b'", "'\u00e9'", "''"})
    EXPECT_NE(named(word).find("cannot be the name of a constant"), std::string::npos) << word;
  for (const char* word : {"h0", "h1", "m_2", "R", "gamma", "E", "_a"})
    EXPECT_EQ(named(word), "") << word;
}

TEST(Constants, TheirNamesGoBeforePowersOfUnits) {
  const SceneInput input = SceneInput::from_text("key = '2*h1'\n[constants]\nh1 = '5 s'");
  EXPECT_EQ(input.root().real("key", dimension::time, range::any, {}), 10);
  input.check();
}

TEST(Constants, AThousandThatNeedEachOtherTakeNoTime) {
  std::string chain = "key = 'c0'\n[constants]\nc998 = '2 s'\n";
  for (int i = 0; i < 998; ++i) chain += fmt::format("c{} = 'c{}/1'\n", i, i + 1);
  const auto seconds = [] { return static_cast<Real>(std::clock()) / CLOCKS_PER_SEC; };
  const Real begin = seconds();
  const SceneInput input = SceneInput::from_text(chain);
  EXPECT_EQ(input.root().real("key", dimension::time, range::any, {}), 2);
  input.check();
  EXPECT_LT(seconds() - begin, 8);  // takes 0.2; 15 if each formula contained all constants
}

TEST(Constants, ExponentsAreNoNames) {
  const auto value = [](const std::string& formula) {
    const SceneInput input =
        SceneInput::from_text("key = '" + formula + "'\n[constants]\ne9 = 2\ne3a = 3\nx_1 = 0");
    const Real read = input.root().real("key", dimension::none, range::any, {});
    input.check();
    return read;
  };
  EXPECT_EQ(value("2e9"), 2e9);
  EXPECT_EQ(value("2.e9 nm/nm"), 2e9);  // a quantity, which contains no constant
  EXPECT_EQ(value("2e9*(1 + sin(x_1)/1.5E-3)*e9 - .5e3*e3a"), 4e9 - 1500);
}

TEST(Constants, DimensionsOfFormulas) {
  const auto refused_as = [](const std::string& formula) {
    const std::string text = report(
        "key = '" + formula + "'\n[constants]\nr = '3 m'\np = '7 Pa'\none = 1\nkind = 2",
        [](const Block& root) { root.real("key", dimension::angular_momentum, range::any, {}); });
    const std::size_t begin = text.find(" is "), end = text.find(", expected");
    return begin == std::string::npos ? text : text.substr(begin + 4, end - begin - 4);
  };
  EXPECT_EQ(refused_as("p*r"), "a tension (kg/s^2)");
  EXPECT_EQ(refused_as("-p*r/2"), "a tension (kg/s^2)");
  EXPECT_EQ(refused_as("sqrt(r*r)"), "a length (m)");
  EXPECT_EQ(refused_as("r > 2 ? r : p"), "a length (m)");
  for (const char* plain : {"r/(2*r) + one", "sqrt(r)", "r + one", "r - r", "one",
                            "kind < 1.5 ? 20 : (kind < 2.5 ? 50 : 100)"})
    EXPECT_EQ(refused_as(plain), "") << plain;
}

}  // namespace
}  // namespace meniscus::test_constants
