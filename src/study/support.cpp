// SPDX-License-Identifier: BSD-3-Clause
// How wide supports should be: errors of solids, drops and curvature against pairs and time, for
// supports of f times the distance to the 20th neighbour (1.73 spacings of a lattice).
#include "meniscus/study/study.hpp"

#include <fmt/core.h>

#include <cmath>

#include "support/bodies.hpp"
#include "support/cube_modes.hpp"
#include "support/cube_spectrum.hpp"
#include "support/curvature_list.hpp"
#include "support/drop_mode_case.hpp"
#include "support/elastic_case.hpp"
#include "support/elastic_fields.hpp"
#include "support/lame_cube_case.hpp"
#include "support/static_drop_case.hpp"

namespace meniscus::support_study {
namespace {

using namespace study;

constexpr Real by_default = 1.8;

/// What supports are needed for.
struct Use {
  std::string name;
  std::string error;  ///< by which supports are compared; empty: by none
  int finest;         ///< level
  Measurement (*measure)(const std::string& method, Real factor, int level);
};

std::string method_of(const Use& use, Real factor) {
  return use.name + ", " + support_text(factor, rank_of_degree<3>(2));
}

std::unique_ptr<Body<3>> box(int n, Real jitter, Real factor) {
  return unit_box<3>(n, jitter, 1, factor * std::sqrt(3.0));
}

void solve_elastic(Measurement& m, const SmoothMap<3>& field, Real jitter, Real factor,
                   Real tolerance) {
  const auto c = elastic_case<3>(box(m.level, jitter, factor), field, {});
  const Stopwatch set_up;
  LinearBody<3> linear(*c.body, {"q_scni", 0}, c.moduli);
  m.set_up = set_up.seconds();
  const Stopwatch run;
  const Solution solution = solve(linear, c, tolerance);
  m.time = run.seconds();
  m.particles = c.body->size();
  m.h = 1.0 / m.level;
  m.bytes = linear.term().bytes();
  const ElasticErrors errors = errors_of(c, solution.u);
  m.errors = {{"L2", errors.L2}, {"H1", errors.H1}};
  m.values = {{"pairs per particle", Real(linear.term().pairs()) / m.particles},
              {"iterations", Real(solution.iterations)}};
}

Measurement patch(const std::string& method, Real factor, int n) {
  Measurement m{.method = method, .level = n};
  solve_elastic(m, polynomial_field<3>(true), 0.4, factor, 1e-15);
  return m;
}

Measurement elasticity(const std::string& method, Real factor, int n) {
  Measurement m{.method = method, .level = n};
  solve_elastic(m, smooth_field<3>(), 0.2, factor, 1e-9);
  return m;
}

Measurement spectrum(const std::string& method, Real factor, int n) {
  static const Real lowest = cube_modes({}, 9)[6];
  const auto body = box(n, 0.2, factor);
  return measure_spectrum(method, {"q_scni", 0}, *body, n, lowest);
}

std::string body_keys(Real factor) {
  return fmt::format("support_factor = {}", factor);
}

Measurement vibration(const std::string& method, Real factor, int n) {
  return measure_lame_cube(method, n, body_keys(factor));
}

Measurement drop(const std::string& method, Real factor, int core) {
  return measure_drop_mode(method, {.l = 2, .Oh = 0.2, .body_keys = body_keys(factor)}, core);
}

Measurement rounding(const std::string& method, Real factor, int core) {
  const StaticDrop drop{3, true, 0.93, "balanced", body_keys(factor)};
  Measurement m = measure_static_drop(drop, core, round_time(drop));
  m.method = method;
  return m;
}

Measurement curvature(const std::string& method, Real factor, int core) {
  const CurvatureProblem<3> problem(reference_body<3>("ball", core), named_maps<3>().front());
  Measurement m =
      problem.measure(curvature_method<3>(2, factor, Window::cubic_spline, Places::points));
  m.method = method;
  m.level = core;
  return m;
}

/// Time to an error by a straight line through the logarithms of two measurements; nothing where
/// the error hardly falls between them, as where it changes sign.
std::optional<Real> time_to(Real error, const Measurement& a, const Measurement& b,
                            const std::string& name) {
  constexpr Real least_order = 1;
  const Real fall = std::log(a.error(name) / b.error(name));
  if (fall < least_order * std::log(a.h / b.h)) return std::nullopt;
  return b.time * std::pow(b.error(name) / error, std::log(b.time / a.time) / fall);
}

/// Says what each support takes to the error that the default has at the last level but one.
void compare(StudyRun& study, const Use& use, const std::vector<Real>& factors,
             const std::vector<int>& levels) {
  if (use.error.empty() || levels.size() < 2) return;
  const int fine = levels.back(), coarse = levels[levels.size() - 2];
  const auto of = [&](Real factor, int level) { return study.find(method_of(use, factor), level); };
  const Measurement* standard = of(by_default, coarse);
  std::string text = fmt::format("{}, time to the error {:.3g} over that of {}:", use.name,
                                 standard->error(use.error), support_text(by_default, 20));
  for (const Real factor : factors) {
    const auto time =
        time_to(standard->error(use.error), *of(factor, coarse), *of(factor, fine), use.error);
    text += fmt::format("  {} {}", support_text(factor, 20),
                        time ? fmt::format("{:.2f}", *time / standard->time) : "-");
  }
  study.note(text);
}

void run(StudyRun& study) {
  study.finish_settings();
  const std::vector<Use> uses{{"patch", "", 6, patch},
                              {"elasticity", "H1", 16, elasticity},
                              {"spectrum", "", 6, spectrum},
                              {"vibration", "state", 16, vibration},
                              {"drop", "rate", 8, drop},
                              {"rounding of an ellipsoid", "isoperimetric - 1", 8, rounding},
                              {"curvature", "L2", 20, curvature}};
  std::vector<Real> factors{1.3, 1.4, 1.5, 1.65, by_default, 2};
  if (study.brief()) factors = {1.5, by_default};
  for (const Use& use : uses) {
    std::vector<int> levels = study.levels();
    std::erase_if(levels, [&](int level) { return level > use.finest; });
    for (const Real factor : factors)
      for (const int level : levels) {
        study.record(use.measure(method_of(use, factor), factor, level));
        if (use.name == "patch")
          study.require(method_of(use, factor) + ": error of a quadratic displacement",
                        study.measurements().back().error("H1"), {0, 1e-12});
      }
    compare(study, use, factors, levels);
  }
}

const bool registered = register_entry(
    StudyEntry{"support",
               "width of supports: errors of solids, drops and curvature against pairs and time",
               "cells per edge of a cube, or of the core of a ball",
               {6, 8, 12},
               {4},
               run});

}  // namespace
}  // namespace meniscus::support_study
