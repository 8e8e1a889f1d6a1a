// SPDX-License-Identifier: BSD-3-Clause
// Width of supports: errors of solids, drops and curvature against pairs and time. Supports are f
// times the distance to the 20th neighbour, or f times the mean diagonal of the cells around a
// particle. In a lattice both are 1.73 spacings, but at the boundary the first one grows.
#include "study/study.hpp"
#include "study/support/bodies.hpp"
#include "study/support/cube_modes.hpp"
#include "study/support/cube_spectrum.hpp"
#include "study/support/curvature_list.hpp"
#include "study/support/drop_mode_case.hpp"
#include "study/support/elastic_case.hpp"
#include "study/support/elastic_fields.hpp"
#include "study/support/lame_cube_case.hpp"
#include "study/support/static_drop_case.hpp"

#include <fmt/core.h>

#include <cmath>

namespace meniscus::support_study {
namespace {

using namespace study;

struct Support {
  bool by_cells;
  Real factor;

  /// "1.5 d_20", "1.5 diagonals"
  std::string text() const {
    return by_cells ? fmt::format("{:.4g} diagonals", factor)
                    : support_text(factor, rank_of_degree<3>(2));
  }
};

constexpr Support standard{false, 1.8};

/// A field of use for which supports are compared.
struct Use {
  std::string name;
  std::string error;  ///< error by which supports are compared; may be empty
  int finest;         ///< finest level
  Measurement (*measure)(const std::string& method, Support support, int level);
};

std::string method_of(const Use& use, Support support) {
  return use.name + ", " + support.text();
}

std::unique_ptr<Body<3>> box(int n, Real jitter, Support support) {
  Geometry<3> geometry = unit_box_geometry<3>(n, jitter);
  ParticleSet<3> particles = [&]() -> ParticleSet<3> {
    constexpr KernelFunction kernel_function = KernelFunction::cubic_spline;
    if (!support.by_cells)
      return {geometry.grid.X, ParticleSet<3>::AdaptiveSupport{support.factor}, kernel_function};
    return {geometry.grid.X,
            supports_by_cells<3>(geometry.grid, Mat<3>::Identity(), support.factor),
            kernel_function};
  }();
  return box_of(std::move(geometry), std::move(particles));
}

void solve_elastic(Measurement& m, const SmoothMap<3>& field, Real jitter, Support support,
                   Real tolerance) {
  const auto c = elastic_case<3>(box(m.level, jitter, support), field, {});
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

Measurement patch(const std::string& method, Support support, int n) {
  Measurement m{.method = method, .level = n};
  solve_elastic(m, polynomial_field<3>(true), 0.4, support, 1e-15);
  return m;
}

Measurement elasticity(const std::string& method, Support support, int n) {
  Measurement m{.method = method, .level = n};
  solve_elastic(m, smooth_field<3>(), 0.2, support, 1e-9);
  return m;
}

Measurement spectrum(const std::string& method, Support support, int n) {
  static const Real lowest = cube_modes({}, 9)[6];
  const auto body = box(n, 0.2, support);
  return measure_spectrum(method, {"q_scni", 0}, *body, n, lowest);
}

std::string body_keys(Support support) {
  return fmt::format("window = \"cubic_spline\"\nsupport_factor = {}\nsupport_by = \"{}\"",
                     support.factor, support.by_cells ? "cells" : "neighbours");
}

Measurement vibration(const std::string& method, Support support, int n) {
  return measure_lame_cube(method, n, body_keys(support));
}

Measurement drop(const std::string& method, Support support, int core) {
  return measure_drop_mode(method, {.l = 2, .Oh = 0.2, .body_keys = body_keys(support)}, core);
}

Measurement rounding(const std::string& method, Support support, int core) {
  const StaticDrop drop{3, true, 0.93, "balanced", body_keys(support)};
  Measurement m = measure_static_drop(drop, core, round_time(drop));
  m.method = method;
  return m;
}

Measurement curvature(const std::string& method, Support support, int core) {
  const CurvatureProblem<3> problem(reference_body<3>("ball", core), named_maps<3>().front());
  CurvatureMethod<3> by =
      curvature_method<3>(2, support.factor, KernelFunction::cubic_spline, Places::points);
  by.by_cells = support.by_cells;
  Measurement m = problem.measure(by);
  m.method = method;
  m.level = core;
  return m;
}

/// Time to reach an error, by a straight line through the logarithms of two measurements. Empty if
/// the error hardly falls between them, e.g. where it changes sign.
std::optional<Real> time_to(Real error, const Measurement& a, const Measurement& b,
                            const std::string& name) {
  constexpr Real least_order = 1;
  const Real fall = std::log(a.error(name) / b.error(name));
  if (fall < least_order * std::log(a.h / b.h)) return std::nullopt;
  return b.time * std::pow(b.error(name) / error, std::log(b.time / a.time) / fall);
}

/// Notes the cost of each support at the error that the standard support has at the last but one
/// level.
void compare(StudyRun& study, const Use& use, const std::vector<Support>& supports,
             const std::vector<int>& levels) {
  if (use.error.empty() || levels.size() < 2) return;
  const int fine = levels.back(), coarse = levels[levels.size() - 2];
  const auto of = [&](Support s, int level) { return study.find(method_of(use, s), level); };
  const Measurement& goal = *of(standard, coarse);
  std::string text = fmt::format("{}, time to the error {:.3g} over that of {}:", use.name,
                                 goal.error(use.error), standard.text());
  for (const Support support : supports) {
    const auto time =
        time_to(goal.error(use.error), *of(support, coarse), *of(support, fine), use.error);
    text += fmt::format("  {} {}", support.text(),
                        time ? fmt::format("{:.2f}", *time / goal.time) : "-");
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
  std::vector<Support> supports{{false, 1.5}, standard,     {false, 2},  {true, 1.2}, {true, 1.4},
                                {true, 1.5},  {true, 1.65}, {true, 1.8}, {true, 2}};
  if (study.brief()) supports = {{true, 1.5}, standard};
  for (const Use& use : uses) {
    std::vector<int> levels = study.levels();
    std::erase_if(levels, [&](int level) { return level > use.finest; });
    for (const Support support : supports)
      for (const int level : levels) {
        study.record(use.measure(method_of(use, support), support, level));
        if (use.name == "patch")
          study.require(method_of(use, support) + ": error of a quadratic displacement",
                        study.measurements().back().error("H1"), {0, 1e-12});
      }
    compare(study, use, supports, levels);
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
