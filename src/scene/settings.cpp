// SPDX-License-Identifier: BSD-3-Clause
// The keys of a scene: names, units, ranges, defaults and meanings.
#include "meniscus/scene/settings.hpp"

#include "meniscus/approx/window.hpp"
#include "meniscus/body/shapes.hpp"
#include "meniscus/physics/law_registry.hpp"
#include "meniscus/scene/contact_settings.hpp"
#include "meniscus/solve/stepper.hpp"

namespace meniscus {
namespace {

/// An optional number: absent stays absent.
template <class M>
Row<M> optional_row(std::string key, std::optional<Real> M::*member, Dimension dimension,
                    Range range, std::string fallback, std::string meaning) {
  Row<M> row = real_row<M>(std::move(key), nullptr, dimension, range, std::move(meaning), 0.0);
  row.fallback = std::move(fallback);
  row.read = [key = row.key, member, dimension, range](M& m, const Block& block) {
    if (block.has(key)) m.*member = block.real(key, dimension, range, std::nullopt);
  };
  return row;
}

/// Formulas of the place that may be left out.
template <class M>
Row<M> optional_expressions_row(std::string key, std::vector<Expression> M::*member,
                                Dimension dimension, std::string meaning) {
  Row<M> row = expressions_row<M>(std::move(key), nullptr, 0, dimension, std::move(meaning),
                                  std::vector<Expression>{});
  row.fallback = "0";
  row.read = [key = row.key, member, dimension](M& m, const Block& block) {
    if (block.has(key))
      m.*member = block.expressions(key, 0, dimension, std::nullopt, Variables::place);
  };
  return row;
}

std::vector<std::string> windows() {
  return {window_names.begin(), window_names.end()};
}

}  // namespace

Rows<TimeSettings> TimeSettings::rows() {
  using S = TimeSettings;
  return {
      real_row("end", &S::end, dimension::time, range::positive, "time at which the run ends"),
      optional_row("step", &S::step, dimension::time, range::positive, "automatic",
                   "fixed step; refused above the stable step of the discretised system"),
      real_row("safety", &S::safety, dimension::none, {0, 1, true, false},
               "automatic step as a fraction of the stable step", 0.9),
      integer_row("check_every", &S::check_every, {1, 1e9},
                  "most steps between two estimates of the stable step; fewer while it changes",
                  250),
      choice_row("solver", &S::solver, Registry<StepperEntry>::all().names(),
                 "motion as it is, or damped to the equilibrium: relax stops by itself, at the "
                 "latest at end, where a body that still moves is an error",
                 "dynamics"),
      real_row("force_tolerance", &S::force_tolerance, dimension::none, range::positive,
               "relax: forces left on the particles / forces before they cancel", 1e-5),
      real_row("shape_tolerance", &S::shape_tolerance, dimension::none, range::positive,
               "relax: largest change of place that is left / extent", 1e-4),
  };
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
               "whether each frame also holds the complete state, so that a run can go on from it",
               true),
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
          "volume change at every stress point, or its mean over each nodal cell "
          "(integration = \"q_scni\"), which does not lock where solids are nearly "
          "incompressible; automatic: cell_average where bulk / shear modulus >= 1000, and in "
          "fluids with balanced surface tension",
          "automatic"),
      choice_row("window", &S::window, windows(), "window function of the kernel", "cubic_spline"),
      real_row("support_factor", &S::support_factor, dimension::none, {1, 10},
               "support of a particle / distance to its neighbour of rank support_rank", 1.8),
      integer_row("support_rank", &S::support_rank, {0, 200},
                  "rank of that neighbour; 0: 20 in 3D, 8 in 2D", 0),
      real_row("support_spacings", &S::support_spacings, dimension::none, {0, 20},
               "support of all particles / mean cell size; 0: adaptive by support_factor", 0.0),
      optional_expressions_row("initial_displacement", &S::initial_displacement, dimension::length,
                               "a formula of x, y, z for each component"),
      optional_expressions_row("initial_velocity", &S::initial_velocity, dimension::velocity,
                               "a formula of x, y, z for each component"),
  };
}

Rows<TensionSettings> TensionSettings::rows() {
  using S = TensionSettings;
  return {
      text_row("body", &S::body, "name of the body whose surface is under tension"),
      real_row("gamma", &S::gamma, dimension::tension, range::positive, "surface tension"),
      choice_row(
          "form", &S::form, {"balanced", "weak", "curvature", "triangles"},
          "gradient of the area of patches through places, with the volume that they enclose for "
          "the pressure of a fluid; gradient of the area at Gauss points; curvature from second "
          "derivatives (smooth surfaces only); flat triangles",
          "balanced"),
      integer_row("points", &S::points, {1, 8},
                  "Gauss points per direction and surface facet, for weak and curvature", 3),
      real_row("coefficient_damping", &S::coefficient_damping, dimension::none, range::non_negative,
               "damping of what of the velocity coefficients of a fluid does not move places, in "
               "kinematic viscosity / spacing^2, for balanced; 0: none",
               0.5),
  };
}

Rows<BodyForceSettings> BodyForceSettings::rows() {
  using S = BodyForceSettings;
  return {text_row("body", &S::body, "name of the body"),
          expressions_row("acceleration", &S::acceleration, 0, dimension::acceleration,
                          "force per mass, a formula of reference position x, y, z and time t for "
                          "each component")};
}

Rows<CavitySettings> CavitySettings::rows() {
  using S = CavitySettings;
  return {
      text_row("body", &S::body, "name of the body around the cavity"),
      choice_row("surface", &S::surface, {"inner", "outer"},
                 "the closed surface that is filled; a drop has an outer one only", "inner"),
      optional_row("pressure", &S::pressure, dimension::pressure, range::any, "none",
                   "pressure inside above that outside; either this or volume_target, or neither: "
                   "vented"),
      optional_row("volume_target", &S::volume_target, dimension::none, range::positive, "none",
                   "volume of the content / enclosed volume of the reference"),
      optional_row("penalty", &S::penalty, dimension::pressure, range::positive, "none",
                   "pressure per deviation from volume_target, which needs it"),
      ramp_row("ramp", &S::ramp, "pressure from 0 or volume_target from 1"),
      integer_row("points", &S::points, {1, 8}, "Gauss points per direction and surface facet", 2),
  };
}

Rows<ProfileSettings> ProfileSettings::rows() {
  using S = ProfileSettings;
  return {text_row("body", &S::body, "name of the shell whose mean meridian is compared"),
          reals_row("r", &S::r, 0, dimension::length, range::non_negative,
                    "distances from the axis of places of a known outer profile"),
          reals_row("z", &S::z, 0, dimension::length, range::any,
                    "their heights above the middle plane; the profile is symmetric"),
          text_row("label", &S::label, "what pictures call it", "given profile")};
}

Rows<ExactSettings> ExactSettings::rows() {
  using S = ExactSettings;
  return {text_row("body", &S::body, "name of the body whose exact motion is known"),
          expressions_row("displacement", &S::displacement, 0, dimension::length,
                          "a formula of x, y, z, t for each component"),
          expressions_row("velocity", &S::velocity, 0, dimension::velocity,
                          "a formula of x, y, z, t for each component"),
          real_row("rate", &S::rate, dimension::rate, range::positive,
                   "weighs displacements against velocities in the error; the frequency of an "
                   "oscillation")};
}

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
      optional_row("level", &S::level, dimension::none, range::any, "none",
                   "for reduce = \"falls\", in the unit of the column"),
      real_row("value", &S::value, dimension::none, range::any,
               "expected number, in the unit of the column", 0.0),
      optional_row("within", &S::within, dimension::none, range::non_negative, "none",
                   "largest difference, in the unit of the column"),
      optional_row("within_relative", &S::within_relative, dimension::none, range::positive, "none",
                   "largest difference relative to value; the larger of the two counts"),
  };
}

namespace {

void describe_numbers(std::ostream& out) {
  out << "A plain number is in the unit system of the scene; a text such as \"72.8 mN/m\" has its "
         "own\n"
         "unit. The units and defaults below are those of SI. A formula is a text in x, y, z, "
         "t.\n\n";
}

template <class Keys>
void describe_list(std::ostream& out, const std::string& heading, const Keys& keys) {
  std::vector<std::array<std::string, 6>> lines;
  for (const auto& k : keys)
    lines.push_back({k.key, k.type, k.unit, k.range, k.fallback, k.meaning});
  rows::print_table(out, heading, lines);
}

template <int D>
void describe_shapes(std::ostream& out) {
  for (const auto& [name, kind] : shapes<D>())
    describe_list(out,
                  "[[body]] shape = \"" + name + "\" (" + std::to_string(D) + "D): " + kind.meaning,
                  kind.keys());
}

}  // namespace

void describe_keys(std::ostream& out) {
  describe_numbers(out);
  describe_list(out, "top level",
                std::vector<ShapeKey>{
                    {"title", "text", "", "", "\"\"", "heading of reports"},
                    {"dimension", "integer", "", "2 or 3", "required", "dimension of space"}});
  describe_list(out, "[units]",
                std::vector<ShapeKey>{{"system", "text", "", "", "\"SI\"",
                                       "SI, or the units of length, time and mass such as "
                                       "\"nm-ps-ag\""}});
  describe<TimeSettings>(out, "[time]");
  describe<OutputSettings>(out, "[output]");
  describe<BodySettings>(out, "[[body]]");
  describe_list(out, "[[body]] of any shape",
                std::vector<ShapeKey>{
                    {"shape", "text", "", "", "required", "one of the shapes below"},
                    {"imperfection", "number", "m", ">= 0", "0",
                     "rms of a smooth random displacement of the reference"},
                    {"imperfection_seed", "integer", "", ">= 0", "1", "seed of the displacement"},
                    {"jitter", "number", "", ">= 0 and <= 0.5", "0",
                     "random shift of interior particles / shortest cell edge"},
                    {"jitter_seed", "integer", "", ">= 0", "1", "seed of the shifts"}});
  describe_shapes<3>(out);
  describe_shapes<2>(out);
  for (const auto& [name, law] : laws())
    describe_list(out, "[body.material] type = \"" + std::string(name) + "\"", law.keys);
  describe<TensionSettings>(out, "[[surface_tension]]");
  describe<BodyForceSettings>(out, "[[body_force]]");
  describe_contact_keys(out);
  describe<CavitySettings>(out, "[[cavity]]");
  describe<ProfileSettings>(out, "[[profile]]");
  describe<ExactSettings>(out, "[[exact]]");
  describe<ExpectSettings>(out, "[expect.NAME]");
}

}  // namespace meniscus
