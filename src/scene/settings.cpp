// SPDX-License-Identifier: BSD-3-Clause
// The keys of a scene: names, units, ranges, defaults and meanings.
#include "scene/settings.hpp"

#include "input/optional_rows.hpp"
#include "kernel/kernel_function.hpp"
#include "meniscus/body/shapes.hpp"
#include "meniscus/physics/law_registry.hpp"
#include "meniscus/scene/load.hpp"
#include "meniscus/solve/stepper.hpp"
#include "scene/key_reference.hpp"

#include <cmath>
#include <iterator>

namespace meniscus {
namespace {

std::vector<std::string> kernel_functions() {
  std::vector<std::string> names{"automatic"};
  names.insert(names.end(), kernel_function_names.begin(), kernel_function_names.end());
  return names;
}

/// True if a multiple of `every` lies in (before, now].
bool due(Real before, Real now, Real every) {
  const auto count = [every](Real t) { return std::floor(t / every + 1e-9); };
  return count(now) > count(before);
}

constexpr Range support_factors{1, 10};

}  // namespace

Rows<InitialSettings> InitialSettings::rows() {
  return {text_row("from", &InitialSettings::from,
                   "directory of a run of the same bodies, or one of its checkpoints: its last "
                   "positions, velocities and directors are the first of this run, at the time 0. "
                   "An initial_velocity replaces the velocities of its body. After relax or "
                   "newton, bodies are at rest")};
}

Rows<ResolutionSettings> ResolutionSettings::rows() {
  return {
      real_row("refine", &ResolutionSettings::refine, dimension::none, refinements,
               "factor by which the cells of all bodies are finer. Numbers of cells are multiplied "
               "and rounded, even numbers to even ones; spacings are divided. Lengths that the "
               "scene gives do not change; lengths with a default that depends on the cells do",
               1.0)};
}

Rows<TimeSettings> TimeSettings::rows() {
  using S = TimeSettings;
  return {
      real_row("end", &S::end, dimension::time, range::positive, "time at which the run ends"),
      optional_row(
          "step", &S::step, dimension::time, range::positive, "automatic",
          "fixed step; refused above the stable step of the discretised system. newton: load "
          "step, of any length, with fluids the longest while loads change; "
          "automatic is a twentieth of end"),
      real_row("safety", &S::safety, dimension::none, {0, 1, true, false},
               "automatic step as a fraction of the stable step", 0.9),
      integer_row("check_every", &S::check_every, {1, 1e9},
                  "most steps between two estimates of the stable step; fewer while it changes",
                  250),
      choice_row(
          "viscosity", &S::viscosity, {"explicit", "implicit", "automatic"},
          "dynamics: how viscous forces are integrated. explicit: by the known velocity, which "
          "limits the step. implicit: by the mean of the old and the new velocity, found in a few "
          "iterations per step; faster where fine or stretched particles of a fluid make steps "
          "short. automatic: implicit if its steps are more than twice as long at the start, or if "
          "time.step is too long for explicit; the log names the choice",
          "explicit"),
      choice_row(
          "solver", &S::solver, Registry<StepperEntry>::all().names(),
          "dynamics: the real motion. relax: damped motion to the equilibrium; stops at rest, and "
          "it is an error if bodies still move at end. newton: an equilibrium at each load step, "
          "without motion; fluids flow to rest by long steps of implicit Euler",
          "dynamics"),
      real_row(
          "force_tolerance", &S::force_tolerance, dimension::none, range::positive,
          "when bodies are at rest. relax: net forces on the particles / sum of the sizes of the "
          "forces. newton with fluids: energy that is still to be released / energy released",
          1e-5),
      real_row("shape_tolerance", &S::shape_tolerance, dimension::none, range::positive,
               "when bodies are at rest, for relax: largest displacement still expected / extent "
               "of the body",
               1e-4),
  };
}

bool OutputSettings::record_due(Real before, Real now, Real end) const {
  return due(before, now, history_every > 0 ? history_every : end / 200);
}
bool OutputSettings::frame_due(Real before, Real now, Real end) const {
  return due(before, now, frames_every > 0 ? frames_every : end / 50);
}

Rows<OutputSettings> OutputSettings::rows() {
  using S = OutputSettings;
  return {
      real_row("frames_every", &S::frames_every, dimension::time, range::non_negative,
               "time between frames of run.h5; 0: 50 frames over the run", 0.0),
      real_row("history_every", &S::history_every, dimension::time, range::non_negative,
               "time between rows of history.csv; 0: 200 rows over the run", 0.0),
      texts_row("fields", &S::fields,
                "fields of a frame beside position: displacement, velocity, force, J, F, pressure, "
                "von_mises, cauchy_stress",
                std::vector<std::string>{"velocity", "J"}),
      texts_row("measures", &S::measures,
                "measures in the history beside the energies, e.g. \"drop.aspect\"; those that an "
                "expectation names are added by themselves",
                std::vector<std::string>{}),
      choice_row("precision", &S::precision, {"float64", "float32"}, "of the fields of a frame",
                 "float64"),
      integer_row("compression", &S::compression, {0, 9}, "deflate level of run.h5", 0),
      flag_row("restartable", &S::restartable,
               "whether each frame also holds the complete state, so that a run can go on from it; "
               "checkpoints hold it anyway",
               false),
      flag_row(
          "revolved", &S::revolved,
          "dimension = \"axisymmetric\": whether revolved.h5 and its views for ParaView have the "
          "surface in 3D, with the fields that are numbers or vectors",
          false),
      real_row("checkpoint_minutes", &S::checkpoint_minutes, dimension::none, range::positive,
               "wall-clock minutes between checkpoints", 10.0),
  };
}

Rows<BodySettings> BodySettings::rows() {
  using S = BodySettings;
  return {
      text_row("name", &S::name, "name of the body, by which other tables refer to it"),
      choice_row("integration", &S::integration, {"q_scni", "gauss", "nodal"},
                 "rule of the internal force: smoothed gradients with linear moments over nodal "
                 "cells, Gauss points, or particles (unstable, for comparison only)",
                 "q_scni"),
      integer_row("gauss_points", &S::gauss_points, {1, 8},
                  "Gauss points per direction and cell, for integration = \"gauss\"", 3),
      choice_row(
          "volumetric", &S::volumetric, {"automatic", "full", "cell_average"},
          "full: the law sees the volume change at every stress point; cell_average: that of "
          "nodal cells (integration = \"q_scni\"), in solids with a bulk modulus above 3 shear "
          "moduli extended from inner cells to the boundary, so that they do not lock; automatic: "
          "cell_average for solids and for fluids with balanced surface tension, else full",
          "automatic"),
      choice_row("window", &S::window, kernel_functions(),
                 "kernel function of the shape functions; automatic: triweight for liquids in 3D "
                 "and of revolution without edges and without a director, unless their tension "
                 "varies or has form = "
                 "\"curvature\", else cubic_spline",
                 "automatic"),
      optional_row("support_factor", &S::support_factor, dimension::none, support_factors,
                   "1.5 for solids in 3D and with window = \"triweight\", else 1.8",
                   "support of a particle / length of support_by; both are measured after a round "
                   "body, as an ellipsoid, is pressed back to a ball. 1.8 also for solids whose "
                   "surface tension has form = \"curvature\""),
      choice_row("support_by", &S::support_by, {"automatic", "neighbours", "cells"},
                 "which length support_factor multiplies: the distance to the neighbour of rank "
                 "support_rank, which grows at faces, or the mean diagonal of the cells around the "
                 "particle, which does not; in a lattice both are the same. automatic: cells for "
                 "solids in 3D and nematics in 2D, else neighbours",
                 "automatic"),
      integer_row("support_rank", &S::support_rank, {0, 200},
                  "rank of that neighbour; 0: 20 in 3D, 8 in 2D", 0),
      real_row("support_spacings", &S::support_spacings, dimension::none, {0, 20},
               "support of all particles / mean cell size; 0: adaptive by support_factor", 0.0),
      optional_expressions_row("initial_displacement", &S::initial_displacement, 0,
                               dimension::length, Variables::place,
                               "a formula of x, y, z for each component"),
      optional_expressions_row("initial_velocity", &S::initial_velocity, 0, dimension::velocity,
                               Variables::place, "a formula of x, y, z for each component"),
  };
}

void BodySettings::settle_support(const Block& block, const SupportDefaults& otherwise) {
  if (window == "automatic") window = otherwise.window;
  if (!support_factor)
    support_factor = block.real("support_factor", dimension::none, support_factors,
                                window == "triweight" ? 1.5 : otherwise.factor);
  if (support_rank > 0 && support_by == "cells")
    block.problem(
        "support_rank",
        "is a rank of neighbours, which support_by = \"cells\" does not ask for; leave one "
        "of them out");
  if (support_by == "automatic") support_by = support_rank > 0 ? "neighbours" : otherwise.by;
}

Rows<SolidSettings> SolidSettings::rows() {
  return {real_row("viscosity", &SolidSettings::viscosity, dimension::viscosity,
                   range::non_negative,
                   "damps it: eta of the stress 2 eta E' of Kelvin and Voigt, E' the rate of the "
                   "Green strain; [[solid_viscosity]] has a volumetric one, too",
                   0.0)};
}

namespace {

/// A number in the unit of a column of the history. A text with any unit is accepted here; its
/// dimension is compared with the column when the scene is built.
Real in_unit_of_column(const Block& block, const std::string& key, Range range,
                       std::optional<Real> fallback) {
  return block.real(key, block.own_dimension(key).value_or(dimension::none), range, fallback);
}

Row<ExpectSettings> column_row(const std::string& key, std::optional<Real> ExpectSettings::*member,
                               Range range, const std::string& meaning) {
  auto row = optional_row(key, member, dimension::none, range, "none",
                          meaning + ", in the unit of the column or a text with a unit");
  row.read = [=](ExpectSettings& e, const Block& block) {
    if (block.has(key)) e.*member = in_unit_of_column(block, key, range, std::nullopt);
  };
  return row;
}

}  // namespace

Rows<ExpectSettings> ExpectSettings::rows() {
  using S = ExpectSettings;
  return {
      text_row("of", &S::of, "column of the history; empty: the name of this table", ""),
      choice_row(
          "reduce", &S::reduce, {"at", "max", "min", "mean", "max_abs", "decay_rate", "falls"},
          "value at a time, or a number taken over from ... to; decay_rate is minus the slope "
          "of ln |column|, falls how often the column falls below level",
          "at"),
      optional_row("at", &S::at, dimension::time, range::non_negative, "time.end",
                   "time of the value, for reduce = \"at\""),
      real_row("from", &S::from, dimension::time, range::non_negative,
               "begin of the span, for the others", 0.0),
      optional_row("to", &S::to, dimension::time, range::positive, "time.end",
                   "end of the span, for the others"),
      column_row("level", &S::level, range::any, "for reduce = \"falls\""),
      column_row("value", &S::value, range::any, "expected number; 0 if there is a tolerance"),
      column_row("within", &S::within, range::non_negative,
                 "largest difference; without a tolerance the number is only reported"),
      optional_row("within_relative", &S::within_relative, dimension::none, range::positive, "none",
                   "largest difference relative to value; the larger of the two counts"),
      optional_row("order", &S::order, dimension::none, range::positive, "none",
                   "least order of convergence that `meniscus converge` has to find"),
      optional_row("error_bar_within", &S::error_bar_within, dimension::none, range::positive,
                   "none",
                   "largest error bar that `meniscus converge` may find, relative to the limit"),
  };
}

namespace {

void add_shapes(auto& tables, const auto& shapes, const std::string& dimension) {
  for (const auto& [name, shape] : shapes)
    tables.push_back(
        {"[[body]] shape = \"" + name + "\" (" + dimension + "): " + std::string(shape.meaning),
         shape.keys(), "[[body]]\nshape = \"" + name + "\"\n" + std::string(shape.example)});
}

void add(std::vector<KeyTable>& tables, std::vector<KeyTable> more) {
  std::move(more.begin(), more.end(), std::back_inserter(tables));
}

}  // namespace

std::vector<KeyTable> key_tables() {
  std::vector<KeyTable> tables{
      {"top level",
       {{"title", "text", "", "", "\"\"", "heading of reports"},
        {"dimension", "integer or text", "", "2, 3 or \"axisymmetric\"", "required",
         "dimension of space; \"axisymmetric\": bodies of revolution in the half plane, with x the "
         "distance from the axis and y along it"}}},
      {"[units]",
       {{"system", "text", "", "", "\"SI\"",
         "SI, or the units of length, time and mass such as \"nm-ps-ag\""}}},
      {"[constants]",
       {{"NAME", "number or formula", "any", "", "",
         "a number, a text with a unit, or a formula of other constants, by its name for every "
         "number and formula of the scene; `--set constants.NAME=VALUE` changes it"}},
       "[constants]\nradius = \"5 nm\"\nduration = \"2 ns\"\nspeed = \"radius/duration\"\n"
       "[[body]]\nsemi_axes = [\"radius\", \"1.5*radius\", \"radius\"]\n"
       "initial_velocity = [\"-speed\", 0, 0]\n"},
      {"[functions]",
       {{"NAME", "formula", "any", "", "",
         "a formula of x, y, z, t and constants, by its name for every formula of the scene; a key "
         "\"NAME(a, b)\" in quotes is one of arguments, called as NAME(2*x, 1)"}},
       "[functions]\nwave = \"sin(2*pi*x)\"\n\"bump(r, width)\" = \"exp(-(r/width)^2)\"\n"
       "[[body]]\ninitial_velocity = [\"0.1*wave\", \"bump(sqrt(x^2 + y^2), 0.3)\", 0]\n"},
      {"[initial]", key_texts(InitialSettings::rows()), "[initial]\nfrom = \"results/relaxed\"\n"},
      {"[[stage]]",
       {{"name", "text", "", "", "required",
         "name of the stage and of its directory of results. A stage has tables of its own, such "
         "as "
         "[stage.time] or [[stage.traction]], and all tables of the scene; where both have a key, "
         "that of the stage counts. Not in a stage: title, dimension, units, body, initial. Stages "
         "are run one after the other, each from the last state of the one before, with a time "
         "that "
         "begins at 0"}},
       "[[stage]]\nname = \"press\"\n[stage.time]\nend = 1\n[[stage.traction]]\nbody = "
       "\"drop\"\npressure = 10\n[[stage]]\nname = \"release\"\n[stage.time]\nend = 5\n"},
      {"[resolution]", key_texts(ResolutionSettings::rows()), "[resolution]\nrefine = 2\n"},
      {"[time]", key_texts(TimeSettings::rows())},
      {"[output]", key_texts(OutputSettings::rows())},
      {"[[body]]", key_texts(BodySettings::rows())},
      {"[[body]] of any shape",
       {{"shape", "text", "", "", "required", "one of the shapes below"},
        {"map", "3 numbers or formulas", "m", "any", "",
         "where the place x, y, z of the shape is in the body, e.g. [\"x\", \"y\", "
         "\"z*(1 + x^2)\"]; normals and curvature are exact"},
        {"rotate", "number", "deg", "any", "0",
         "the body is turned about its middle, after the map"},
        {"rotate_axis", "3 numbers", "", "any", "[0, 0, 1]", "the axis (3D)"},
        {"move", "3 numbers", "m", "any", "0", "the body is moved by this, at last"},
        {"imperfection", "number", "m", ">= 0", "0",
         "rms of a smooth random displacement of the reference"},
        {"imperfection_seed", "integer", "", ">= 0", "1", "seed of the displacement"},
        {"jitter", "number", "", ">= 0 and <= 0.5", "0",
         "random shift of interior particles / shortest cell edge"},
        {"jitter_seed", "integer", "", ">= 0", "1", "seed of the shifts"}}}};
  add_shapes(tables, shapes<3>(), "3D");
  add_shapes(tables, shapes<2>(), "2D");
  for (const auto& [name, law] : laws())
    tables.push_back({fmt::format("[body.material] type = \"{}\": {}", name, law.meaning),
                      law.keys(), "[body.material]\ntype = \"" + name + "\"\n" + law.example});
  tables.push_back({"[body.material] of any solid", key_texts(SolidSettings::rows())});
  tables.push_back({"[[body.material]] of a mesh with regions, one for each",
                    {{"region", "text", "", "", "required",
                      "a physical volume (2D: surface) of the .msh file; all regions have the same "
                      "law, mooney_rivlin, neo_hookean or st_venant_kirchhoff, with numbers of "
                      "their own"}}});
  for (const auto& [name, load] : loads<3>()) add(tables, load.keys());
  for (const auto& [name, load] : loads<2>())
    if (!loads<3>().find(name)) add(tables, load.keys());
  tables.push_back({"[expect.NAME]", key_texts(ExpectSettings::rows())});
  return tables;
}

}  // namespace meniscus
