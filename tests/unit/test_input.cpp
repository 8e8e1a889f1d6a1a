// SPDX-License-Identifier: BSD-3-Clause
// Keys of tables: values, ranges, and the exact words of every message.
#include "unit/input_scene.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace meniscus::test_input {
namespace {

using namespace input_test;
using dimension::density;
using dimension::none;
using dimension::pressure;

// ---- values
// --------------------------------------------------------------------------------------

TEST(Input, ReadsAValidScene) {
  const SceneInput input = SceneInput::from_text(valid_scene);
  const LiquidScene scene = read_scene(input.root());
  input.check();
  EXPECT_EQ(scene.dimension, 3);
  ASSERT_EQ(scene.liquids.size(), 2u);
  const Varying<Liquid>& drop = scene.liquids[0];
  EXPECT_FALSE(drop.uniform());
  EXPECT_EQ(drop.at({5e-9, 0, 0}).bulk_modulus, 4.4e9);
  EXPECT_EQ(drop.base.density, 1000);
  EXPECT_EQ(drop.base.viscosity, 6e-4);
  EXPECT_EQ(drop.base.points, 2);
  EXPECT_EQ(drop.base.law, "tait");
  EXPECT_EQ(drop.base.note, "caf\u00e9 \"quoted\" \\ \t");
  EXPECT_EQ(drop.base.axes, (std::vector<Real>{5e-9, 7.5e-9, 5e-9}));
  EXPECT_EQ(drop.base.velocity[1]({0, 0, 0}), 1);
  EXPECT_EQ(drop.base.velocity[2]({3, 0, 0}), 30);
  EXPECT_EQ(drop.base.fields, std::vector<std::string>{"velocity"});
  EXPECT_TRUE(scene.liquids[1].uniform());
  EXPECT_TRUE(scene.liquids[1].base.ripened);
  EXPECT_EQ(scene.liquids[1].base.viscosity, 1e-3);
  EXPECT_EQ(scene.expected, (std::vector<std::string>{"drop.aspect", "volume"}));
  EXPECT_EQ(input.text(), valid_scene);
}

TEST(Input, ValuesAndDefaultsComeInTheUnitsOfTheScene) {
  const auto input = SceneInput::from_text(R"toml(
liquid = { bulk_modulus = "2 GPa", axes = ["5 nm", 7.5, 5], velocity = ["100 m/s", 1, "x"] }
[units]
system = "nm-ps-ag"
)toml");
  const auto liquid = read<Liquid>(*input.root().table("liquid"));
  input.check();
  EXPECT_EQ(liquid.bulk_modulus, 2e-3);  // ag/(nm ps^2) = 1e12 Pa
  EXPECT_EQ(liquid.axes, (std::vector<Real>{5, 7.5, 5}));
  EXPECT_EQ(liquid.velocity[0]({0, 0, 0}), 0.1);
  EXPECT_EQ(liquid.velocity[1]({0, 0, 0}), 1);
  EXPECT_EQ(liquid.velocity[2]({7, 0, 0}), 7);
  EXPECT_DOUBLE_EQ(liquid.density, 1e-3);    // default 1000 kg/m^3; ag/nm^3 = 1e6 kg/m^3
  EXPECT_DOUBLE_EQ(liquid.viscosity, 1e-3);  // default 1e-3 Pa s; ag/(nm ps) = 1 Pa s
}

TEST(Input, Ranges) {
  EXPECT_TRUE(range::any.contains(-1e200));
  EXPECT_FALSE(range::any.contains(std::numeric_limits<Real>::infinity()));
  EXPECT_FALSE(range::any.contains(std::numeric_limits<Real>::quiet_NaN()));
  EXPECT_FALSE(range::positive.contains(0));
  EXPECT_TRUE(range::positive.contains(1e-300));
  EXPECT_TRUE(range::non_negative.contains(0));
  const Range poisson{-1, 0.5, true, true}, closed{-1, 0.5};
  EXPECT_FALSE(poisson.contains(-1));
  EXPECT_FALSE(poisson.contains(0.5));
  EXPECT_TRUE(poisson.contains(0.4999999));
  EXPECT_TRUE(closed.contains(-1));
  EXPECT_TRUE(closed.contains(0.5));
  EXPECT_EQ(range::any.text(), "any");
  EXPECT_EQ(range::positive.text(), "> 0");
  EXPECT_EQ(range::non_negative.text(), ">= 0");
  EXPECT_EQ(poisson.text(), "> -1 and < 0.5");
  EXPECT_EQ(closed.text(), ">= -1 and <= 0.5");
  EXPECT_EQ((Range{-1e300, 2, false, true}).text(), "< 2");
}

// ---- messages
// ------------------------------------------------------------------------------------

TEST(Input, MessagesAboutNumbers) {
  const auto read = [](const Block& b) { b.real("rho", density, range::positive, {}); };
  EXPECT_EQ(report("", read),
            "s.toml:1:1: rho: missing; allowed is a number in kg/m^3 or a text with a unit, > 0");
  EXPECT_EQ(report("rho = true", read),
            "s.toml:1:7: rho: is a boolean; allowed is a number in kg/m^3 or a text with a "
            "unit, > 0");
  EXPECT_EQ(report("rho = 0", read), "s.toml:1:7: rho: 0 kg/m^3 is out of range; allowed is > 0");
  EXPECT_EQ(report("rho = \"-1 g/cm^3\"", read),
            "s.toml:1:7: rho: -1000 kg/m^3 is out of range; allowed is > 0");
  EXPECT_EQ(report("rho = nan", read),
            "s.toml:1:7: rho: nan kg/m^3 is out of range; allowed is > 0");
  EXPECT_EQ(report("rho = \"2 GPa\"", read),
            "s.toml:1:7: rho: '2 GPa' is a pressure (kg/(m s^2)), expected a density (kg/m^3); "
            "allowed is a number in kg/m^3 or a text with a unit, > 0");
  const auto read_any = [](const Block& b) { b.real("nu", none, {}, 0.0); };
  EXPECT_EQ(report("nu = -inf", read_any),
            "s.toml:1:6: nu: -inf is out of range; allowed is a finite number");
  EXPECT_EQ(report("nu = [1]", read_any), "s.toml:1:6: nu: is an array; allowed is a number");
  EXPECT_EQ(report("nu = 1979-05-27", read_any),
            "s.toml:1:6: nu: is a date or time; allowed is a number");
  EXPECT_EQ(report("", read_any), "");
}

TEST(Input, MessagesAboutOtherTypes) {
  const auto integer = [](const Block& b) { b.integer("n", {1, 5}, {}); };
  EXPECT_EQ(report("", integer), "s.toml:1:1: n: missing; allowed is an integer >= 1 and <= 5");
  EXPECT_EQ(report("n = 2.0", integer),
            "s.toml:1:5: n: is a decimal number; allowed is an integer >= 1 and <= 5");
  EXPECT_EQ(report("n = 6", integer), "s.toml:1:5: n: 6 is out of range; allowed is >= 1 and <= 5");
  const auto flag = [](const Block& b) { b.flag("on", {}); };
  EXPECT_EQ(report("", flag), "s.toml:1:1: on: missing; allowed is true or false");
  EXPECT_EQ(report("on = 1", flag), "s.toml:1:6: on: is an integer; allowed is true or false");
  const auto text = [](const Block& b) { b.text("name", {}); };
  EXPECT_EQ(report("", text), "s.toml:1:1: name: missing; allowed is a text");
  EXPECT_EQ(report("name = 1.5", text), "s.toml:1:8: name: is a decimal number; allowed is a text");
  const auto choice = [](const Block& b) { b.choice("law", {"linear", "log"}, {}); };
  EXPECT_EQ(report("", choice), "s.toml:1:1: law: missing; allowed is one of linear, log");
  EXPECT_EQ(report("law = 1", choice),
            "s.toml:1:7: law: is an integer; allowed is one of linear, log");
  EXPECT_EQ(report("law = 'linaer'", choice),
            "s.toml:1:7: law: 'linaer' is unknown; allowed are linear, log; did you mean "
            "'linear'?");
  const auto texts = [](const Block& b) { b.texts("fields", {}); };
  EXPECT_EQ(report("fields = 'a'", texts),
            "s.toml:1:10: fields: is a text; allowed is an array of any number of: a text");
  EXPECT_EQ(report("fields = ['a', 2]", texts),
            "s.toml:1:16: fields[1]: is an integer; allowed is a text");
}

TEST(Input, MessagesAboutArraysOfNumbers) {
  const auto read = [](const Block& b) {
    b.reals("axes", 2, dimension::length, range::positive, {});
  };
  EXPECT_EQ(report("axes = [1]", read),
            "s.toml:1:8: axes: has 1 entry; allowed is an array of 2 of: a number in m or a text "
            "with a unit, > 0");
  EXPECT_EQ(
      report("axes = [\n-1,\n'2 s']", read),
      "s.toml:2:1: axes[0]: -1 m is out of range; allowed is > 0\n"
      "s.toml:3:1: axes[1]: '2 s' is a time (s), expected a length (m); allowed is a number in "
      "m or a text with a unit, > 0");
}

TEST(Input, MessagesAboutFormulas) {
  const auto read = [](const Block& b) { b.expression("p", pressure, {}, range::positive); };
  EXPECT_EQ(report("", read),
            "s.toml:1:1: p: missing; allowed is a number in Pa or a text with a unit or a formula "
            "of x, y, z, t, > 0");
  EXPECT_EQ(
      report("p = '2 Pa*x'", read),
      "s.toml:1:5: p: neither a quantity (unknown unit 'x'; allowed are m, s, g, N, "
      "dyn, Pa, bar, P, J, eV, W, Hz, L (prefixes z a f p n u m c k M G T), atm, psi, mmHg, "
      "erg, kT, min, h, angstrom, rad, deg) nor a "
      "formula (formula '2 Pa*x': unknown name 'Pa' at character 3; allowed are x, y, z, t, "
      "pi, e and functions such as sqrt); allowed is a number in Pa or a text with a unit or a "
      "formula of x, y, z, t, > 0");
  EXPECT_EQ(report("p = '1 - 2'", read), "s.toml:1:5: p: -1 Pa is out of range; allowed is > 0");
  EXPECT_EQ(report("p = -1", read), "s.toml:1:5: p: -1 Pa is out of range; allowed is > 0");
  EXPECT_EQ(report("p = '-2 GPa'", read),
            "s.toml:1:5: p: -2000000000 Pa is out of range; allowed is > 0");
  EXPECT_EQ(report("p = '0/0'", read), "s.toml:1:5: p: nan Pa is out of range; allowed is > 0");
  EXPECT_EQ(report("p = '2 + x'", read), "");
}

TEST(Input, MessagesAboutTables) {
  const auto table = [](const Block& b) { b.table("time", true); };
  EXPECT_EQ(report("", table), "s.toml:1:1: time: missing; allowed is a table");
  EXPECT_EQ(report("time = 3", table), "s.toml:1:8: time: is an integer; allowed is a table");
  const auto tables = [](const Block& b) { b.tables("body"); };
  EXPECT_EQ(report("[body]", tables),
            "s.toml:1:1: body: is a table; allowed is an array of tables, [[body]]");
  EXPECT_EQ(report("body = [1]", tables),
            "s.toml:1:9: body[0]: is an integer; allowed is an array of tables, [[body]]");
  const auto defaults = [](const Block& b) { b.table_or_defaults("output").text("folder", {}); };
  EXPECT_EQ(report("", defaults), "s.toml:1:1: output.folder: missing; allowed is a text");
  EXPECT_EQ(report("\n[output]", defaults),
            "s.toml:2:1: output.folder: missing; allowed is a text");
  // The value is not a table: one message, without further ones about missing keys.
  EXPECT_EQ(report("output = 1", defaults),
            "s.toml:1:10: output: is an integer; allowed is a table");
  const auto named = [](const Block& b) {
    for (const auto& [name, t] : b.table("expect")->named_tables())
      t.real("value", none, {}, {}), t.done();
  };
  EXPECT_EQ(report("[expect]\na = 1\n'b.c' = {}", named),
            "s.toml:2:5: expect.a: is an integer; allowed is a table\n"
            "s.toml:3:9: expect.\"b.c\".value: missing; allowed is a number");
  EXPECT_EQ(report("[[expect.z]]\n[expect.y]\nvalue = 1\n[[expect.x.w]]", named),
            "s.toml:1:1: expect.z: is an array; allowed is a table\n"
            "s.toml:4:1: expect.x.value: missing; allowed is a number\n"
            "s.toml:4:12: expect.x.w: unknown key; allowed is value");
}

TEST(Input, UnknownKeys) {
  const auto read = [](const Block& b) {
    b.integer("dimension", {}, 2);
    b.table("time");
    b.done();
  };
  EXPECT_EQ(report("dimenson = 3", read),
            "s.toml:1:1: dimenson: unknown key; allowed are units, constants, functions, "
            "dimension, time; did "
            "you mean "
            "'dimension'?");
  EXPECT_EQ(report("[tmie]\nx = 1", read),
            "s.toml:1:2: tmie: unknown key; allowed are units, constants, functions, dimension, "
            "time; did you mean "
            "'time'?");
  EXPECT_EQ(report("'odd key' = 1", read),
            "s.toml:1:1: \"odd key\": unknown key; allowed are units, constants, functions, "
            "dimension, time");
}

TEST(Input, AllProblemsAreReportedInOneGoAndInOrder) {
  const std::string toml = R"toml([units]
system = "cgs"
[[body]]
name = 3
[body.liquid]
densty = 3
bulk_modulus = "2 m"
points = 9
axes = [1, 2]
[[bdy]]
)toml";
  EXPECT_EQ(report(toml, [](const Block& b) { read_scene(b); }, {"body[0].liquid.law=lgo"}),
            R"toml(s.toml:1:1: dimension: missing; allowed is an integer >= 2 and <= 3
s.toml:2:10: units.system: unknown unit system 'cgs': three units joined by '-' are needed; allowed are "SI" and a length-time-mass triple such as "nm-ps-ag"
s.toml:4:8: body[0].name: is an integer; allowed is a text
s.toml:6:1: body[0].liquid.densty: unknown key; allowed are density, bulk_modulus, viscosity, points, ripened, law, note, fields, axes, velocity; did you mean 'density'?
s.toml:7:16: body[0].liquid.bulk_modulus: neither a quantity ('2 m' is a length (m), expected a pressure (kg/(m s^2))) nor a formula (formula '2 m': unknown name 'm' at character 3; allowed are x, y, z, t, pi, e and functions such as sqrt); allowed is a number in Pa or a text with a unit or a formula of x, y, z, > 0
s.toml:8:10: body[0].liquid.points: 9 is out of range; allowed is >= 1 and <= 5
s.toml:9:8: body[0].liquid.axes: has 2 entries; allowed is an array of 3 of: a number in m or a text with a unit, > 0
s.toml:10:3: bdy: unknown key; allowed are units, constants, functions, dimension, body, output, expect; did you mean 'body'?
--set 'body[0].liquid.law=lgo': body[0].liquid.law: 'lgo' is unknown; allowed are linear, log, tait; did you mean 'log'?)toml");
}

TEST(Input, ReadersMayNoteProblemsOfTheirOwn) {
  EXPECT_EQ(report("[a]\nb = 1",
                   [](const Block& root) {
                     const Block a = *root.table("a");
                     a.problem("b", "no body is called so");
                     a.problem("", "is pointless");
                     a.problem("c", "would be better");
                     root.problem("", "is hopeless");
                     EXPECT_EQ(a.place("b"), "s.toml:2:5: a.b");
                     EXPECT_EQ(a.place(), "s.toml:1:1: a");
                     EXPECT_EQ(root.place(), "s.toml:1:1");
                   }),
            "s.toml:1:1: a: is pointless\n"
            "s.toml:1:1: a.c: would be better\n"
            "s.toml:1:1: is hopeless\n"
            "s.toml:2:5: a.b: no body is called so");
}

TEST(Input, AFormulaThatLeavesItsRange) {
  const auto input =
      SceneInput::from_text("bulk_modulus = '1 - x'\naxes = [1, 1, 1]\ndensity='1+t'", "s.toml");
  const auto liquid = read_varying<Liquid>(input.root());
  EXPECT_EQ(liquid.at({0.5, 0, 0}).bulk_modulus, 0.5);
  try {
    liquid.at({2, 0.5, 0});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(
        error.what(),
        "s.toml:1:16: bulk_modulus: at x = 2, y = 0.5, z = 0 the value -1 is out of range; "
        "allowed is > 0");
  }
  try {
    input.check();
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "s.toml:3:9: density: formula '1+t': it does not know the time t");
  }
}

TEST(Input, FormulasKnowTheirVariablesOnly) {
  const auto of = [](Variables variables) {
    return [variables](const Block& b) {
      b.expression("p", none, 0.0, {}, variables);
      b.expressions("q", 1, none, {{0.0}}, variables);
    };
  };
  EXPECT_EQ(report("p = 'x + y*z'\nq = ['2*t']", of(Variables::place)),
            "s.toml:2:6: q[0]: formula '2*t': it does not know the time t");
  EXPECT_EQ(report("p = 'z*t'\nq = ['2*t']", of(Variables::time)),
            "s.toml:1:5: p: formula 'z*t': it knows no place x, y, z");
  EXPECT_EQ(report("p = 'z*t'", of(Variables::place_and_time)), "");
  EXPECT_EQ(report("p = true", of(Variables::time)),
            "s.toml:1:5: p: is a boolean; allowed is a number or a formula of t");
}

TEST(Input, FormulasInThePlaneKnowNoZ) {
  const auto of = [](Variables variables) {
    return [variables](const Block& b) { b.expression("p", none, 0.0, {}, variables); };
  };
  const std::string plane = "dimension = 2\n", no_z = "a 2D scene (dimension = 2) has no z",
                    allowed =
                        "; allowed is a number or a formula of x, y or a formula of [constants]";
  EXPECT_EQ(report(plane + "p = 'x + 2*z'", of(Variables::place_and_time)),
            "s.toml:2:5: p: formula 'x + 2*z': " + no_z);
  EXPECT_EQ(report(plane + "p = 'k*z'\n[constants]\nk = 3", of(Variables::place)),
            "s.toml:2:5: p: formula 'k*z': " + no_z + allowed);
  EXPECT_EQ(report(plane + "p = 'f'\n[functions]\nf = '2*z'", of(Variables::place)),
            "s.toml:2:5: p: 'f' by [functions]: formula '(2*z)': " + no_z + allowed);
  EXPECT_EQ(report(plane + "p = true", of(Variables::place)),
            "s.toml:2:5: p: is a boolean; allowed is a number or a formula of x, y");
  EXPECT_EQ(report(plane + "p = 'x + y'", of(Variables::place)), "");
  EXPECT_EQ(report("dimension = 3\np = 'x + 2*z'", of(Variables::place)), "");
}

TEST(Input, AMisspeltKeyThatIsMissingIsOneProblem) {
  const auto read = [](const Block& b) {
    b.real("density", none, {}, {});
    b.real("gamma", none, {}, {});
    b.done();
  };
  const std::string unknown =
      ": unknown key; allowed are units, constants, functions, density, gamma; did you mean "
      "'density'?";
  EXPECT_EQ(report("densty = 1\ngamma = 1", read), "s.toml:1:1: densty" + unknown);
  EXPECT_EQ(report("denstiy = 1", read),
            "s.toml:1:1: gamma: missing; allowed is a number\ns.toml:1:1: denstiy" + unknown);
}

TEST(Input, AFormulaThatIsNotFiniteNamesItsPlace) {
  const auto input = SceneInput::from_text("[a]\nv = [1, '1/(0.5 - t)']", "s.toml");
  const auto v = input.root().table("a")->expressions("v", 2, none, {});
  EXPECT_EQ(v[1]({0, 0, 0}, 1.5), -1);
  try {
    v[1]({1, 2, 3}, 0.5);
    FAIL();
  } catch (const SolveError& error) {
    EXPECT_STREQ(error.what(),
                 "s.toml:2:5: a.v[1]: formula '1/(0.5 - t)' is infinite at x = 1, y = 2, z = 3, t "
                 "= 0.5; allowed are finite numbers");
  }
}

TEST(Input, AnUnknownKindIsOneProblem) {
  const auto read = [](const Block& b) {
    const auto kind = b.kind("shape", {"ball", "box"});
    if (kind == "ball") b.real("radius", dimension::length, range::positive, {});
    b.done();
    EXPECT_EQ(b.in_order(), kind.has_value());
  };
  EXPECT_EQ(report("shape = 'bal'\nradius = 3\nsize = 1", read),
            "s.toml:1:9: shape: 'bal' is unknown; allowed are ball, box; did you mean 'ball'?");
  EXPECT_EQ(report("size = 1", read), "s.toml:1:1: shape: missing; allowed is one of ball, box");
  EXPECT_EQ(report("shape = 'ball'\nradius = 3", read), "");
}

TEST(Input, AKeyThatIsOnlyLookedAtIsUnknown) {
  const auto read = [](const Block& b) {
    EXPECT_TRUE(b.has("size"));
    b.done();
  };
  EXPECT_EQ(report("size = 1", read).find("s.toml:1:1: size: unknown key"), 0u);
}

TEST(Input, WordsOfOtherProgramsLeadHome) {
  const auto read = [](const Block& b) {
    b.real("density", none, {}, 1);
    b.done();
  };
  for (const auto& [word, home] :
       {std::pair("gravity", "[[body_force]]"), std::pair("dt", "[time] step"),
        std::pair("sphere", "'ball'"), std::pair("youngs_modulus", "neo_hookean"),
        std::pair("poisson_ratio", "youngs_modulus and poissons_ratio")})
    EXPECT_NE(report(std::string(word) + " = 1", read).find(home), std::string::npos) << word;
}

}  // namespace
}  // namespace meniscus::test_input
