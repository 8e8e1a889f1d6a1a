// SPDX-License-Identifier: BSD-3-Clause
// Whole scenes: files, syntax errors, overrides, the complete input, the reference of keys.
#include "input/key_table.hpp"
#include "unit/input_scene.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace meniscus::test_scene_input {
namespace {

using namespace input_test;
using dimension::none;
using dimension::pressure;

// ---- files and syntax
// ----------------------------------------------------------------------------

std::string syntax_report(std::string_view toml) {
  return report(toml, [](const Block&) {});
}

TEST(Input, SyntaxErrorsCarryTheirPlace) {
  EXPECT_EQ(syntax_report("a = 1\na = 2"),
            "s.toml:2:5: Error while parsing key-value pair: cannot redefine existing integer 'a'");
  EXPECT_EQ(syntax_report("[a]\n[a]"),
            "s.toml:2:1: Error while parsing table header: cannot redefine existing table 'a'");
  EXPECT_EQ(syntax_report("a = [1,\nb = 2"),
            "s.toml:2:1: Error while parsing value: could not determine value type");
  EXPECT_EQ(syntax_report("a = "),
            "s.toml:1:5: Error while parsing key-value pair: encountered end-of-file");
  EXPECT_EQ(syntax_report("a = \"\xff\""), "s.toml:1:5: Encountered invalid utf-8 sequence");
  std::string deep = "\n[a";
  for (int i = 0; i < 100000; ++i) deep += ".a";
  EXPECT_EQ(syntax_report(deep + "]"), "s.toml:2:1: a key has more than 10 dots");
  EXPECT_EQ(syntax_report("a = " + std::string(300, '[')),
            "s.toml:1:261: Error while parsing value: exceeded maximum nested value depth of 256 "
            "(TOML_MAX_NESTED_VALUES)");
  EXPECT_EQ(syntax_report(std::string_view("a = \0 1", 7)).find("s.toml:1:"), 0u);
}

TEST(Input, DotsCountInKeysOnly) {
  const std::string dots(300, '.'), report = "s.toml:3:1: a key has more than 10 dots";
  for (const std::string& text :
       {"# " + dots, "a = '" + dots + "'", "a = \"" + dots + "\"", "a = '''\n" + dots + "'''''",
        "a = \"\"\"\n\\\"" + dots + "\"\"\"\"",
        "a = ['''it's # " + dots + "''', \"\\\"" + dots + "\"]", "'" + dots + "' = 1"})
    EXPECT_EQ(syntax_report(text), "") << text;
  // Quotes, brackets and equal signs within parts of a key.
  for (const char* part : {".'='", ".\"=\"", ".'#'", ".\"\\\"=\"", ".''", ". '\"'"}) {
    std::string key = "a";
    for (int i = 0; i < 20000; ++i) key += part;
    for (const std::string& text :
         {"\n\n" + key + " = 1", "\n\n[" + key + "]", "\n\nb = {" + key + " = 1}"})
      EXPECT_EQ(syntax_report(text), report) << part;
  }
}

TEST(Input, MissingQuotesAreNamed) {
  for (const char* quantity : {"10 ms", "72.8 mN/m", "1e3 kg/(m s^2)"})
    EXPECT_NE(syntax_report(fmt::format("# a\n[time]\nend = {}  # long", quantity))
                  .find(fmt::format("; a number with a unit is a text: write \"{}\"", quantity)),
              std::string::npos)
        << quantity;
  EXPECT_EQ(syntax_report("a = 10 apples").find("write"), std::string::npos);
}

TEST(Input, ControlCharactersAreRefusedWhereTheyStand) {
  EXPECT_EQ(syntax_report("b = 1\na = [\"x\\u0000y\"]"),
            "s.toml:2:6: \"x\\u0000y\" has the control character \\u0000; allowed are line break "
            "and tabulator");
  EXPECT_EQ(syntax_report("\"x\\u001B\" = 1"),
            "s.toml:1:1: \"x\\u001B\" has the control character \\u001B; allowed are line break "
            "and tabulator");
  EXPECT_EQ(syntax_report("a = \"x\\ty\\nz\""), "");
}

TEST(Input, MoreThanASceneCanHaveIsRefusedAtOnce) {
  std::string keys, bodies;
  for (int i = 0; i < 50000; ++i) {
    keys += fmt::format("k{} = 1\n", i);
    bodies += "[[body]]\n";
  }
  EXPECT_EQ(syntax_report(keys), "s.toml:1:1: has 50000 keys; allowed are at most 1000");
  EXPECT_EQ(syntax_report(bodies), "s.toml:1:1: has 50000 entries; allowed are at most 10000");
  const std::string some = report(bodies.substr(0, 9 * 300), [](const Block& b) { read_scene(b); });
  EXPECT_EQ(std::count(some.begin(), some.end(), '\n'), 100);
  EXPECT_NE(some.find("\ns.toml: and "), std::string::npos) << some;
}

TEST(Input, LineEndsByteOrderMarkAndUnicode) {
  const auto read = [](const Block& b) {
    EXPECT_EQ(b.text("name", {}), "Tr\u00f6pfchen");
    b.done();
  };
  EXPECT_EQ(report("name = 'Tr\u00f6pfchen'\r\nx = 1\r\n", read),
            "s.toml:2:1: x: unknown key; allowed are units, constants, functions, name");
  EXPECT_EQ(report("\xef\xbb\xbfname = 'Tr\u00f6pfchen'\n", read), "");
}

TEST(Input, FilesThatCannotBeRead) {
  const auto folder = std::filesystem::temp_directory_path() / "meniscus_test_input";
  std::filesystem::create_directories(folder);
  const auto file = (folder / "scene.toml").string();
  const auto message = [](const std::string& path) -> std::string {
    try {
      SceneInput::from_file(path);
    } catch (const FileError& error) {
      return error.what();
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(message(folder.string()), "cannot read the scene '" + folder.string() +
                                          "': it is a directory; name a .toml file");
  EXPECT_EQ(message(file + "x"),
            "cannot read the scene '" + file + "x': No such file or directory");
  std::ofstream(file) << " \r\n\n";
  EXPECT_EQ(message(file), file + ":1:1: the scene is empty");
  std::ofstream(file) << "a = 1\nb =\n";
  EXPECT_EQ(message(file).find(file + ":2:"), 0u);
  std::ofstream(file) << std::string(20'000'000, ' ');
  EXPECT_EQ(message(file), file + ":1:1: the file is larger than a scene can be, 10 MB");
  std::ofstream(file) << valid_scene;
  EXPECT_EQ(message(file), "no error");
  std::filesystem::remove_all(folder);
}

// ---- overrides
// -----------------------------------------------------------------------------------

LiquidScene scene_with(const std::vector<std::string>& overrides) {
  const auto input = SceneInput::from_text(valid_scene, "s.toml", overrides);
  LiquidScene scene = read_scene(input.root());
  input.check();
  return scene;
}

TEST(Overrides, ReachEveryKindOfPlace) {
  EXPECT_EQ(scene_with({"dimension=2"}).dimension, 2);
  EXPECT_EQ(scene_with({" dimension = 2 "}).dimension, 2);
  EXPECT_EQ(scene_with({"body[0].liquid.viscosity=2e-3"}).liquids[0].base.viscosity, 2e-3);
  EXPECT_EQ(scene_with({"body.plate.liquid.viscosity='2 mPa s'"}).liquids[1].base.viscosity, 2e-3);
  EXPECT_EQ(scene_with({"body.drop.liquid.viscosity=2 mPa s"}).liquids[0].base.viscosity, 2e-3);
  EXPECT_EQ(scene_with({"body.drop.liquid.law=log"}).liquids[0].base.law, "log");
  EXPECT_EQ(scene_with({"body[0].liquid.axes[1]='9 nm'"}).liquids[0].base.axes[1], 9e-9);
  EXPECT_EQ(
      scene_with({"body[1].liquid={bulk_modulus=7, axes=[1,1,1]}"}).liquids[1].base.bulk_modulus,
      7);
  EXPECT_EQ(scene_with({"dimension=2", "dimension=3"}).dimension, 3);
  EXPECT_EQ(scene_with({"expect.\"drop.aspect\".value=2"}).expected.size(), 2u);
  EXPECT_EQ(scene_with({"body.drop.liquid.note=a = b"}).liquids[0].base.note, "a = b");
}

TEST(Overrides, ThatCannotBeApplied) {
  const auto message = [](const std::vector<std::string>& overrides) {
    return report(
        valid_scene, [](const Block& b) { read_scene(b); }, overrides);
  };
  EXPECT_EQ(message({"bdy[0].name='a'"}),
            "--set 'bdy[0].name='a'': 'bdy' is not in the scene; allowed are dimension, units, "
            "body, expect; did you mean 'body'?");
  EXPECT_EQ(message({"body.drip.name=a", "body[2].name=a"}),
            "--set 'body.drip.name=a': in body: 'drip' is not in the scene; allowed are drop, "
            "plate, [0], [1]; did you mean 'drop'?\n"
            "--set 'body[2].name=a': body[2] does not exist; it has 2 entries, counted from 0");
  EXPECT_EQ(message({"dimension.x=1"}),
            "--set 'dimension.x=1': dimension is an integer; 'x' cannot be set in it");
  EXPECT_EQ(message({"units[0]=1"}),
            "--set 'units[0]=1': units is a table; [0] cannot be set in it");
  for (const char* malformed : {"dimension", "=3", "a..b=1", "body[x].name=1", "body[0=1", "'a=1"})
    EXPECT_EQ(message({malformed}),
              std::string("--set '") + malformed +
                  "': not of the form key.path=value, e.g. body[0].material.viscosity=1e-3");
  EXPECT_EQ(message({"dimension="}), "--set 'dimension=': a value is missing behind '='");
  EXPECT_EQ(message({"dimension=[1"}), "--set 'dimension=[1': the value [1 is not valid TOML");
  EXPECT_EQ(message({"dimension=\xff"}), "--set 'dimension=\xff': the value is not valid UTF-8");
  EXPECT_EQ(message({"body.drop.liquid.new=1"}),
            "--set 'body.drop.liquid.new=1': body[0].liquid.new: unknown key; allowed are density, "
            "bulk_modulus, viscosity, points, ripened, law, note, fields, axes, velocity");
  EXPECT_EQ(message({"body[1].liquid={}"}),
            "--set 'body[1].liquid={}': body[1].liquid.bulk_modulus: missing; allowed is a number "
            "in Pa or a text with a unit or a formula of x, y, z, > 0\n"
            "--set 'body[1].liquid={}': body[1].liquid.axes: missing; allowed is an array of 3 of: "
            "a number in m or a text with a unit, > 0");
}

// ---- the complete input
// --------------------------------------------------------------------------

TEST(Complete, IsWrittenWithDefaultsAndUnits) {
  const auto input = SceneInput::from_text(valid_scene, "s.toml", {"body.drop.liquid.points=4"});
  read_scene(input.root());
  EXPECT_EQ(input.complete(), R"toml(dimension = 3

[units]
system = "SI"

[[body]]
name = "drop"

[body.liquid]
density = 1000.0  # kg/m^3
bulk_modulus = "2.2e9*(1 + x/5e-9)"  # Pa
viscosity = 0.0006  # Pa s
points = 4
ripened = false  # default
law = "tait"
note = "café \"quoted\" \\ \u0009"
fields = ["velocity"]  # default
axes = [5e-09, 7.5e-09, 5e-09]  # m
velocity = [0.0, 1.0, "10*x"]  # m/s

[[body]]
name = "plate"

[body.liquid]
density = 1000.0  # kg/m^3, default
bulk_modulus = 1000000000.0  # Pa
viscosity = 0.001  # Pa s, default
points = 3  # default
ripened = true
law = "linear"  # default
note = ""  # default
fields = ["velocity"]  # default
axes = [1.0, 1.0, 1.0]  # m
velocity = [0.0, 0.0, 0.0]  # m/s, default

[output]
interval = 1e-12  # s, default

[expect]

[expect."drop.aspect"]
value = 1.0
within = 0.005

[expect.volume]
value = 1.0
within = 0.1
)toml");
}

/// The complete input without its comments, which mark defaults.
std::string without_comments(const std::string& toml) {
  std::istringstream lines(toml);
  std::string result;
  for (std::string line; std::getline(lines, line);)
    result += line.substr(0, line.find("  #")) + "\n";
  return result;
}

TEST(Complete, ReadsBackAsTheSameInput) {
  for (const char* system : {"SI", "nm-ps-ag", "um-min-ng"}) {
    const auto once = SceneInput::from_text(
        valid_scene, "s.toml",
        {std::string("units.system=") + system, "body[1].liquid.axes=['1 um', 0.1, 3e-300]"});
    const LiquidScene first = read_scene(once.root());
    once.check();
    const auto again = SceneInput::from_text(once.complete());
    const LiquidScene second = read_scene(again.root());
    again.check();
    EXPECT_EQ(without_comments(again.complete()), without_comments(once.complete()));
    ASSERT_EQ(second.liquids.size(), first.liquids.size());
    for (std::size_t i = 0; i < first.liquids.size(); ++i) {
      const Liquid a = first.liquids[i].at({1e-9, 0, 0}), b = second.liquids[i].at({1e-9, 0, 0});
      EXPECT_EQ(a.density, b.density);
      EXPECT_EQ(a.bulk_modulus, b.bulk_modulus);
      EXPECT_EQ(a.viscosity, b.viscosity);
      EXPECT_EQ(a.note, b.note);
      EXPECT_EQ(a.axes, b.axes);
    }
  }
}

TEST(Complete, AConstantFormulaBecomesItsNumber) {
  const auto input = SceneInput::from_text("a = '2*3'\nb = '1 MPa'\nc = 'x'\nd = -0.0");
  input.root().expression("a", pressure, {});
  input.root().expression("b", pressure, {});
  input.root().expression("c", pressure, {});
  input.root().real("d", none, {}, {});
  EXPECT_EQ(input.complete(),
            "a = 6.0  # Pa\nb = 1000000.0  # Pa\nc = \"x\"  # Pa\nd = -0.0\n\n[units]\nsystem = "
            "\"SI\"  # default\n");
}

TEST(Describe, PrintsAnAlignedTable) {
  std::ostringstream out;
  print(out, {"[body.liquid]", key_texts(Liquid::rows())});
  EXPECT_EQ(out.str(),
            R"toml([body.liquid]
  key           type                   unit    range                default       meaning
  density       number or formula      kg/m^3  > 0                  1000          mass per reference volume
  bulk_modulus  number or formula      Pa      > 0                  required      stiffness against compression
  viscosity     number                 Pa s    >= 0                 0.001         shear viscosity
  points        integer                        >= 1 and <= 5        3             Gauss points per direction
  ripened       true or false                                       false         whether it has rested
  law           text                           linear | log | tait  "linear"      equation of state
  note          text                                                ""            free text
  fields        texts                                               ["velocity"]  what is written
  axes          3 numbers              m       > 0                  required      semi-axes
  velocity      3 numbers or formulas  m/s                          [0, 0, 0]     initial velocity
)toml");
}

TEST(Scenes, AreComparedKeyByKey) {
  const std::string scene =
      "title = \"a\"\n[units]\nsystem = \"SI\"\n[[body]]\nname = \"one\"\nsize = [1, 2]\n"
      "[body.material]\nmu = 1\n[[body]]\nname = \"two\"\n";
  EXPECT_TRUE(differing_keys(scene, scene).empty());
  // The order of keys, the notation of numbers, comments and white space do not matter.
  EXPECT_TRUE(differing_keys(scene,
                             "# a copy\nbody = [{ material = { mu = 1.0 }, size = [1.0, 2e0], "
                             "name = 'one' }, { name = \"two\" }]\nunits.system = \"SI\"\n"
                             "title = \"a\"\n")
                  .empty());
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string other = scene;
    other.replace(other.find(from), from.size(), to);
    return differing_keys(scene, other);
  };
  using Keys = std::vector<std::string>;
  EXPECT_EQ(changed("mu = 1", "mu = 2"), Keys{"body[0].material.mu"});
  EXPECT_EQ(changed("mu = 1", "mu = \"1\""), Keys{"body[0].material.mu"});
  EXPECT_EQ(changed("[1, 2]", "[1, 3]"), Keys{"body[0].size[1]"});
  EXPECT_EQ(changed("[1, 2]", "[1]"), Keys{"body[0].size[1]"});
  EXPECT_EQ(changed("[[body]]\nname = \"two\"\n", ""), Keys{"body[1]"});
  EXPECT_EQ(changed("title = \"a\"", "title = \"b\"\ndimension = 2"), (Keys{"dimension", "title"}));
}

}  // namespace
}  // namespace meniscus::test_scene_input
