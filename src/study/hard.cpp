// SPDX-License-Identifier: BSD-3-Clause
// Hard cases: each must stay stable, or stop with a message that names the cause.
#include "meniscus/error.hpp"
#include "scene/scene.hpp"
#include "solve/audit.hpp"
#include "solve/step/central_difference.hpp"
#include "solve/step/time_step.hpp"
#include "study/support/hard_cases.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace meniscus::hard_study {
namespace {

using study::HardCases, study::HardOutcome;

// rho = E = 1, nu = 0.3: speed of compression waves 1.16.
const std::string solid =
    "material = { type = \"neo_hookean\", density = 1, mu = 0.384615384615, lambda = "
    "0.576923076923 "
    "}\n";
/// A swirling initial velocity; the edges of a cube at the origin do not hinder it.
const std::string swirl =
    "initial_velocity = [\"0.02*sin(pi*x)*cos(pi*y)\", \"-0.02*cos(pi*x)*sin(pi*y)\", \"0\"]\n";

std::string box(const std::string& cells, const std::string& keys, Real end,
                const std::string& size = "[1, 1, 1]") {
  return fmt::format(
      "dimension = 3\ntime = {{ end = {:.17g} }}\n[[body]]\nname = \"body\"\nshape "
      "= "
      "\"box\"\nsize = {}\ncells = {}\n{}",
      end, size, cells, keys);
}

/// A stretched bar that is released suddenly, corners included, with the default step. From a
/// stretch of 1.2 on it folds for all supports and spacings: first at a corner, or later, when the
/// bar contracts, where the law loses ellipticity.
std::string bar(Real stretch, Real end) {
  return fmt::format(
      "dimension = 3\ntime = {{ end = {:.17g} }}\n[[body]]\nname = \"body\"\nshape = \"box\"\n"
      "size = [4, 1, 1]\ncells = [16, 4, 4]\ninitial_displacement = [\"{:.17g}*x\", \"0\", \"0\"]\n"
      "material = {{ type = \"st_venant_kirchhoff\", density = 1, mu = 0.384615384615, lambda = "
      "0.576923076923 }}\n",
      end, stretch - 1);
}

/// Runs central differences with the fraction `part` of the estimated stable step. Scenes cannot do
/// this, because they refuse steps above the limit.
HardOutcome run_at(Real part, int steps) {
  HardOutcome outcome;
  const SceneInput input =
      SceneInput::from_text(box("[5, 5, 5]", "jitter = 0.2\n" + solid + swirl, 1));
  scene_dimension(input);
  Scene<3> scene = build_scene<3>(input);
  outcome.particles = scene.system.size();
  State state = scene.initial;
  StableStepEstimator<3> estimator(scene.system);
  try {
    start(scene.system, state);
    const Real dt = part * estimator.estimate(state).dt;
    Audit audit;
    audit.begin(take_ledger(scene.system, state));
    for (int k = 0; k < steps; ++k, ++outcome.steps) {
      advance(scene.system, state, dt);
      const Ledger ledger = take_ledger(scene.system, state);
      audit.follow(scene.system, state, ledger);
      outcome.energy_error = std::max(outcome.energy_error, std::abs(audit.balance_error(ledger)));
    }
  } catch (const SolveError& e) {
    outcome.stopped = e.what();
  }
  return outcome;
}

void step_limit(HardCases& cases) {
  for (const Real part : {0.9, 1.0, 1.1}) {
    const std::string name = fmt::format("step at {} of the estimated limit", part);
    if (!cases.wants(name)) continue;
    const Stopwatch clock;
    const HardOutcome outcome = run_at(part, 3000);
    cases.record(name, outcome, clock.seconds());
    if (part < 1)
      cases.require(name, "runs 3000 steps", outcome.stopped.empty(), {1, 1});
    else if (part > 1)
      cases.require(name, "blows up and says where",
                    outcome.stopped.find("particle") != std::string::npos, {1, 1});
  }
}

/// Bodies whose particles or supports are uneven.
void clouds(HardCases& cases) {
  cases.stays_stable("jitter 40 %", box("[6, 6, 6]", "jitter = 0.4\n" + solid + swirl, 4), 1e-2);
  cases.stays_stable("layers 10 : 1",
                     box("[5, 5, 5]", "jitter = 0.2\n" + solid + swirl, 1, "[1, 1, 0.1]"), 1e-2);
  cases.stays_stable("support at its limit, 2.2 spacings",
                     box("[6, 6, 6]", "support_spacings = 2.2\n" + solid + swirl, 4), 1e-2);
  const std::string small = "support 1.6 spacings, enlarged";
  cases.says(small,
             cases.stays_stable(
                 small, box("[6, 6, 6]", "support_spacings = 1.6\n" + solid + swirl, 4), 1e-2),
             "were enlarged");
  const std::string masses = "tiny and negative row-sum masses";
  cases.says(
      masses,
      cases.stays_stable(
          masses,
          box("[6, 6, 6]",
              "jitter = 0.4\nintegration = \"gauss\"\ngauss_points = 2\n" + solid + swirl, 4),
          1e-2),
      "were raised");
  for (const std::string volumetric : {"full", "cell_average"})
    cases.stays_stable(
        "lambda/mu = 1e4, " + volumetric,
        box("[5, 5, 5]",
            "jitter = 0.2\nvolumetric = \"" + volumetric +
                "\"\nmaterial = { type = \"neo_hookean\", density = 1, mu = 1, lambda = 1e4 }\n" +
                swirl,
            0.5),
        1e-2);
}

void run(StudyRun& study) {
  HardCases cases(study, study.settings().text("cases", ""));
  study.finish_settings();
  const bool full = !study.brief();

  clouds(cases);
  for (const auto& [stretch, end] : {std::pair{1.05, full ? 20.0 : 8.0}, {1.1, full ? 12.0 : 3.0}})
    cases.stays_stable(fmt::format("bar let go at a stretch of {}", stretch), bar(stretch, end),
                       1e-2);
  step_limit(cases);
  const auto spinning = cases.stays_stable(
      "spinning ball",
      "dimension = 3\ntime = { end = 1e9 }\n[[body]]\nname = \"body\"\nshape = \"ball\"\nradius = "
      "1\ncore = 2\nlayers = 1\nsupport_spacings = 2.2\ninitial_velocity = [\"-0.2*y\", \"0.2*x\", "
      "\"0\"]\n" +
          solid,
      1e-2, {full ? 1e6 : 1e4});
  cases.require("spinning ball", "largest error of the angular momentum",
                spinning.angular_momentum_error, {0, 1e-10});
  cases.stays_stable(
      "impact at 0.3 c",
      box("[6, 6, 6]", "initial_velocity = [\"-0.348*tanh(20*x)\", \"0\", \"0\"]\n" + solid, 3),
      1e-2);
  cases.stops("inverted from the start",
              box("[4, 4, 4]", "initial_displacement = [\"-1.5*x\", \"0\", \"0\"]\n" + solid, 1),
              "particle");
  study::hard_solids(cases);
  study::hard_equilibria(cases);
  study::hard_drops(cases);
  study::hard_surfaces(cases);
  study::hard_nematics(cases);
  study::hard_wetting(cases);
  study::hard_contact(cases);
  study::hard_revolved(cases);
  if (study.checks().empty()) throw InputError("cases: no case has this in its name");
}

const bool registered = register_entry(
    StudyEntry{"hard",
               "hard cases: each stays stable, or stops and names the cause; --set cases=TEXT: "
               "those with TEXT in their name",
               "none: every case has its own size",
               {0},
               {0},
               run});

}  // namespace
}  // namespace meniscus::hard_study
