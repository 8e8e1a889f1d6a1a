// SPDX-License-Identifier: BSD-3-Clause
// Pull-off map: a rigid ball approaches a soft half space and retracts, through equilibria, for
// several Tabor numbers, in 3D and as bodies of revolution. The pull-off force is compared with
// boundary elements with the same interaction (tests/reference/ball_on_half_space.py) and with
// Maugis & Dugdale between stiff (Bradley) and soft balls (Johnson, Kendall, Roberts). Also
// measured: the waves of the force while the edge of the contact passes over facets, and the work
// of the cycle against the energy that jumps release.
#include "run/simulation.hpp"
#include "study/study.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace meniscus::pull_off_map_study {
namespace {

constexpr Real pi = std::numbers::pi;

/// A case with R = E* = 1. The equilibrium gap is small, so that the contact is small against the
/// ball.
struct Case {
  Real tabor, gap;
  Real exact;      ///< pull-off force / 2 pi W R by boundary elements
  Real peak;       ///< distance of the ball at the pull-off force, / gap
  Real far, near;  ///< distances at the ends and in the middle of a cycle, / gap
  int points;      ///< per direction and facet, except in the short form

  Real adhesion() const { return std::pow(tabor * gap, 1.5); }
  Real sigma0() const { return gap * std::pow(15, 1.0 / 6); }
  Real epsilon() const { return adhesion() / (0.968479 * std::pow(sigma0(), 4)); }
  /// Contact radius at the pull-off of soft balls.
  Real contact_radius() const { return std::cbrt(9 * pi * adhesion() / 8); }
};

/// An octant of the half space: equal cells up to 1.6 contact radii, then growing cells up to six.
struct Octant {
  int core, layers = 0;
  Real grading, radius;

  Octant(const Case& c, int cells) : core(cells), grading(1 + 2.4 / cells) {
    const Real fine = 1.4 * std::max(c.contact_radius(), std::sqrt(c.gap)), half = 0.5 * core;
    Real shells = 0, one = 1;
    for (; half + shells < 4 * half; ++layers) shells += one *= grading;
    radius = fine * (half + shells) / half;
  }
};

/// The motion of the ball: from far to near and back (cycle), or only away past the largest pull.
struct Way {
  bool cycle;
  Real step;

  std::string displacement(const Case& c) const {
    return cycle ? fmt::format("{:.17g}*(1 - abs(t - 1))", (c.far - c.near) * c.gap)
                 : fmt::format("{:.17g}*t", -c.gap);
  }
  Real begin(const Case& c) const { return (cycle ? c.far : c.peak - 1) * c.gap; }
};

constexpr const char* mirror_planes = R"toml(
[[held]]
body = "ground"
face = "x_min"
components = ["x"]
[[held]]
body = "ground"
face = "y_min"
components = ["y"]
)toml";

/// D = 3: an octant between mirror planes; D = 2: the half plane of the half space.
template <int D>
std::string scene_text(const Case& c, int core, const Way& way) {
  const Octant part(c, core);
  const char* across = D == 3 ? "0, 0" : "0";
  return fmt::format(R"toml(
dimension = {}
[time]
solver = "newton"
end = 2
step = {:g}
[[body]]
name = "ground"
shape = "{}"
radius = {:.17g}
core = {}
{} = {}
grading = {:.17g}
material = {{ type = "neo_hookean", density = 1, mu = 0.35, lambda = 0.525 }}
[[held]]
name = "base"
body = "ground"
face = "round"
{}
[[contact]]
name = "tip"
bodies = ["ground"]
epsilon = {:.17g}
sigma0 = {:.17g}
beta = 1
points = {}
[contact.partner]
type = "ball"
radius = 1
centre = [{}, {:.17g}]
displacement = [{}, "{}"]
)toml",
                     D == 3 ? "3" : "\"axisymmetric\"", way.step, D == 3 ? "octant" : "half_disk",
                     part.radius, part.core, D == 3 ? "layers" : "rings", part.layers, part.grading,
                     D == 3 ? mirror_planes : "", c.epsilon(), c.sigma0(), core < 8 ? 4 : c.points,
                     across, -1 - way.begin(c), across, way.displacement(c));
}

/// Pull-off force over pi W R of Maugis (1992) with lambda = 1.157 times the Tabor number. It is
/// the largest pull over the ratio m of the radii of the adhesive zone and of the contact.
Real maugis(Real tabor) {
  const Real lambda = 1.157 * tabor;
  Real most = 0;
  for (Real e = -6; e < 4; e += 1e-3) {
    const Real m = 1 + std::pow(10, e), s = std::sqrt(m * m - 1), angle = std::acos(1 / m);
    const Real A = lambda / 2 * ((m * m - 2) * angle + s),
               B = 4 * lambda * lambda / 3 * (s * angle - m + 1);
    const Real a = (-B + std::sqrt(B * B + 4 * A)) / (2 * A);
    most = std::max(most, lambda * a * a * (s + m * m * angle) - a * a * a);
  }
  return most;
}

/// The vertex of the parabola through the largest value and its neighbours.
Real top(const std::vector<Real>& p) {
  const auto k = std::max_element(p.begin(), p.end());
  if (k == p.begin() || k + 1 == p.end()) return *k;
  const Real before = *k - *(k - 1), after = *k - *(k + 1);
  return before + after > 0 ? *k + (before - after) * (before - after) / (8 * (before + after))
                            : *k;
}

/// Removes all values after the jump that follows the largest pull.
void cut_where_it_is_off(std::vector<Real>& p) {
  const auto off = std::adjacent_find(std::max_element(p.begin(), p.end()), p.end(),
                                      [](Real now, Real next) { return next < 0.8 * now; });
  if (off != p.end()) p.erase(off + 1, p.end());
}

/// The largest deviation from the cubic polynomial through two neighbours on either side. Only
/// large pulls count: the repulsion of a stiff contact grows too fast for a polynomial.
Real wave(const std::vector<Real>& p) {
  const Real large = 0.5 * *std::max_element(p.begin(), p.end());
  Real most = 0;
  for (std::size_t k = 2; k + 2 < p.size(); ++k)
    if (std::min(p[k - 2], p[k + 2]) > large)
      most = std::max(most, std::abs(p[k] - (4 * (p[k - 1] + p[k + 1]) - p[k - 2] - p[k + 2]) / 6));
  return most;
}

template <int D>
Measurement pulled_off(const Case& c, int core, const Way& way) {
  const Stopwatch set_up;
  const SceneInput input = SceneInput::from_text(scene_text<D>(c, core, way));
  scene_dimension(input);
  Scene<D> scene = build_scene<D>(input);
  Simulation<D> simulation(scene);
  simulation.begin();
  Measurement m{.method = fmt::format("{}Tabor number {:g}", D == 3 ? "" : "half plane, ", c.tabor),
                .level = core};
  m.particles = scene.system.size();
  m.h = 1.0 / core;
  m.bytes = scene.system.bytes();
  m.set_up = set_up.seconds();
  const Stopwatch run;
  const auto pull = [&] {  // of the whole half space / pull-off of a stiff ball
    const char* along = D == 3 ? "tip.force_z" : "tip.force_y";
    constexpr int parts = D == 3 ? 4 : 1;
    const auto force = std::find_if(scene.measures.begin(), scene.measures.end(),
                                    [&](const auto& s) { return s.name == along; });
    return -parts * force->compute(simulation.state().motion()) / (2 * pi * c.adhesion());
  };
  Real exchanged = 0;
  std::vector<Real> out;  // pulls during retraction
  try {
    simulation.settle();
    const Ledger first = simulation.audit_now();
    while (!simulation.finished()) {
      simulation.advance();
      exchanged = std::max(exchanged, std::abs(simulation.audit_now().external_work));
      if (!way.cycle || simulation.state().time > 1 - 1e-9) out.push_back(pull());
    }
    cut_where_it_is_off(out);
    const Ledger last = simulation.audit_now();
    const Real released = last.dissipated - first.dissipated, most = top(out);
    m.errors = {{"pull-off force", most / c.exact - 1}, {"wave", wave(out) / most}};
    m.values = {{"pull-off / stiff", most},
                {"boundary elements", c.exact},
                {"Maugis-Dugdale", maugis(c.tabor) / 2}};
    if (way.cycle) {
      m.values.emplace_back("work of the cycle / largest", last.external_work / exchanged);
      m.values.emplace_back("released / largest", released / exchanged);
    }
    for (const Residual& r : simulation.stepper().residuals(simulation.state()))
      if (r.meaning == "jumps") m.values.emplace_back("jumps", r.value);
  } catch (const SolveError& e) {
    m.remark = e.what();
  }
  m.time = run.seconds();
  return m;
}

bool in_half_plane(const Measurement& m) {
  return m.method.starts_with("half plane");
}

void check(StudyRun& study, const Case& c, const Way& way) {
  const Measurement& m = study.measurements().back();
  const std::string where = fmt::format("{}, core {}: ", m.method, m.level);
  study.require(where + "went on to its end", m.remark.empty() ? 1 : 0, {1, 1});
  if (!m.remark.empty()) return;
  const auto value = [&](std::string_view name) {
    return std::find_if(m.values.begin(), m.values.end(),
                        [&](const auto& v) { return v.first == name; })
        ->second;
  };
  // At Tabor number 5 the adhesive zone is as wide as a fiftieth of the contact radius.
  if (m.level >= (in_half_plane(m) ? 16 : c.tabor < 0.5 ? 4 : c.tabor < 3 ? 8 : 14)) {
    study.require(where + "pull-off force / boundary elements - 1", m.error("pull-off force"),
                  {-0.03, 0.03});
    if (in_half_plane(m) && c.tabor > 0.5 && c.tabor < 3)
      study.require(where + "pull-off force / boundary elements - 1, the same closer",
                    m.error("pull-off force"), {-0.005, 0.005});
    // Expected between the values of soft and of stiff balls.
    study.require(where + "pull-off / stiff", value("pull-off / stiff"), {0.75, 1});
  }
  if (c.tabor < 3 && m.level >= 8)
    study.require(where + "wave / pull-off force", m.error("wave"), {0, 0.01});
  if (!way.cycle) return;
  const Real work = value("work of the cycle / largest"), released = value("released / largest");
  if (c.tabor < 0.5) {
    study.require(where + "jumps", value("jumps"), {0, 0});
    study.require(where + "work of the cycle / largest", work, {-1e-5, 1e-5});
  }
  if (c.tabor < 3) return;
  study.require(where + "jumps", value("jumps"), {2, unbounded});
  study.require(where + "work of the cycle / largest", work, {0.01, 1});
  study.require(where + "work of the cycle / released - 1", work / released - 1, {-0.03, 0.03});
}

constexpr std::array<Case, 3> all_cases{{{0.1, 0.004, 0.98796, 1.11, 3, 0.6, 4},
                                         {1, 0.004, 0.82999, 1.93, 3.4, 0.6, 4},
                                         {5, 0.0008, 0.77084, 4.99, 10.5, 3, 8}}};

/// Measures whole cycles of all cases in the half plane, with cells of half the size.
void run_in_half_plane(StudyRun& study) {
  for (const int level : study.levels())
    for (const Case& c : all_cases) {
      const Way way{true, study.brief() ? 0.1 : 0.025};
      study.record(pulled_off<2>(c, 2 * level, way));
      check(study, c, way);
    }
}

void run(StudyRun& study) {
  study.finish_settings();
  run_in_half_plane(study);
  for (const int level : study.levels())
    for (const Case& c : all_cases) {
      if (study.brief() && c.tabor > 0.5 && c.tabor < 3) continue;
      // Fine bodies only measure the pull-off; the finest are used only for the cases that need
      // them.
      const bool fine = level > 8;
      if (fine && c.tabor < (level > 10 ? 3 : 0.5)) continue;
      const Way way{!fine, fine ? 0.2 : study.brief() ? 0.1 : 0.05};
      study.record(pulled_off<3>(c, level, way));
      check(study, c, way);
    }
}

const bool registered = register_entry(
    StudyEntry{"pull_off_map",
               "pull-off force and hysteresis of a ball on a soft half space by Tabor number, in "
               "space and in the half plane",
               "cells along an edge of the core of the octant, even",
               {8, 10, 14},
               {4},
               run});

}  // namespace
}  // namespace meniscus::pull_off_map_study
