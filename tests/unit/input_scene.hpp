// SPDX-License-Identifier: BSD-3-Clause
// A struct with a row of every kind, a scene that uses it, and its reader, for tests of the input.
#pragma once
#include "input/input.hpp"
#include "meniscus/error.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace meniscus::input_test {

/// The messages about all problems that `read` finds; empty if there are none.
template <class Read>
std::string report(std::string_view toml, Read read,
                   const std::vector<std::string>& overrides = {}) {
  try {
    const SceneInput input = SceneInput::from_text(toml, "s.toml", overrides);
    read(input.root());
    input.check();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

struct Liquid {
  Real density = 0, bulk_modulus = 0, viscosity = 0;
  int points = 0;
  bool ripened = false;
  std::string law, note;
  std::vector<std::string> fields;
  std::vector<Real> axes;
  std::vector<Expression> velocity;

  static Rows<Liquid> rows() {
    return {
        parameter_row("density", &Liquid::density, dimension::density, range::positive,
                      "mass per reference volume", 1000, {1000}),
        parameter_row("bulk_modulus", &Liquid::bulk_modulus, dimension::pressure, range::positive,
                      "stiffness against compression", 2.2e9),
        real_row("viscosity", &Liquid::viscosity, dimension::viscosity, range::non_negative,
                 "shear viscosity", {1e-3}),
        integer_row("points", &Liquid::points, {1, 5}, "Gauss points per direction", {3}),
        flag_row("ripened", &Liquid::ripened, "whether it has rested", {false}),
        choice_row("law", &Liquid::law, {"linear", "log", "tait"}, "equation of state", {"linear"}),
        text_row("note", &Liquid::note, "free text", {""}),
        texts_row("fields", &Liquid::fields, "what is written", {{"velocity"}}),
        reals_row("axes", &Liquid::axes, 3, dimension::length, range::positive, "semi-axes"),
        expressions_row("velocity", &Liquid::velocity, 3, dimension::velocity, "initial velocity",
                        {{0.0, 0.0, 0.0}}),
    };
  }
};

inline const std::string valid_scene = R"toml(# A drop.
dimension = 3

[units]
system = "SI"

[[body]]
name = "drop"
[body.liquid]
density = "1 g/cm^3"
bulk_modulus = "2.2e9*(1 + x/5e-9)"
viscosity = "0.6 mPa s"
points = 2
law = "tait"
axes = ["5 nm", 7.5e-9, "5 nm"]
velocity = [0, "1 m/s", "10*x"]
note = "caf\u00e9 \"quoted\" \\ \t"

[[body]]
name = 'plate'
liquid = { bulk_modulus = 1e9, axes = [1, 1, 1], ripened = true }

[expect]
"drop.aspect" = { value = 1.0, within = 0.005 }
volume = { value = 1, within = 0.1 }
)toml";

struct LiquidScene {
  std::int64_t dimension = 0;
  std::vector<Varying<Liquid>> liquids;
  std::vector<std::string> expected;
};

inline LiquidScene read_scene(const Block& root) {
  LiquidScene scene;
  scene.dimension = root.integer("dimension", {2, 3}, {});
  for (const Block& body : root.tables("body")) {
    body.text("name", {});
    if (const auto liquid = body.table("liquid", true)) {
      scene.liquids.push_back(read_varying<Liquid>(*liquid));
      liquid->done();
    }
    body.done();
  }
  const Block output = root.table_or_defaults("output");
  output.real("interval", dimension::time, range::positive, 1e-12);
  output.done();
  if (const auto expect = root.table("expect")) {
    for (const auto& [name, table] : expect->named_tables()) {
      scene.expected.push_back(name);
      table.real("value", dimension::none, {}, {});
      table.real("within", dimension::none, range::non_negative, {});
      table.done();
    }
    expect->done();
  }
  root.done();
  return scene;
}

}  // namespace meniscus::input_test
