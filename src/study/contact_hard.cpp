// SPDX-License-Identifier: BSD-3-Clause
// Hard cases of contact. Each says what should happen: the run stays stable, or it stops and names
// the cause; and how strongly flat surfaces with matching points hold each other (CGCM notes 7 and
// 10).
#include "meniscus/core/error.hpp"
#include "meniscus/physics/contact_numbers.hpp"
#include "meniscus/scene/simulation.hpp"
#include "meniscus/study/study.hpp"

#include <fmt/format.h>

#include <cmath>

namespace meniscus {
namespace {

constexpr const char* solid = "neo_hookean\", density = 1, mu = 400, lambda = 300";

std::string disk(const std::string& name, Real radius, const std::string& more) {
  return fmt::format(
      "[[body]]\nname = \"{}\"\nshape = \"disk\"\nradius = {}\ncore = 6\nrings = 3\n"
      "support_spacings = 2.2\n{}\nmaterial = {{ type = \"{} }}\n",
      name, radius, more, solid);
}

std::string contact(const std::string& bodies, const std::string& more) {
  return "[[contact]]\nname = \"contact\"\nbodies = " + bodies +
         "\nepsilon = 4\nsigma0 = 0.4\nbeta = 1\npoints = 3\n" + more + "\n";
}

std::string header(Real end) {
  return fmt::format("dimension = 2\n[time]\nend = {}\n", end);
}

struct Outcome {
  Real energy_error = 0, least_gap = 1e300, least_step = 1e300, first_step = 0;
  Index particles = 0;
  std::string stopped;
};

void follow(Scene<2>& scene, Outcome& outcome) {
  const auto gap = std::find_if(scene.measures.begin(), scene.measures.end(),
                                [](const MeasureSource& m) { return m.name == "contact.gap"; });
  Simulation<2> simulation(scene);
  simulation.begin();
  while (simulation.state().time < scene.time.end) {
    simulation.advance();
    const Real step = simulation.last_step(), left = scene.time.end - simulation.state().time;
    if (outcome.first_step == 0) outcome.first_step = step;
    if (left > step) outcome.least_step = std::min(outcome.least_step, step);
    outcome.least_gap = std::min(outcome.least_gap, gap->compute(simulation.state().motion()));
    if (simulation.state().step % 20) continue;
    const Ledger ledger = simulation.audit_now();
    outcome.energy_error =
        std::max(outcome.energy_error, std::abs(simulation.audit().balance_error(ledger)));
  }
}

Outcome attempt(const std::string& text) {
  Outcome outcome;
  try {
    const SceneInput input = SceneInput::from_text(text);
    scene_dimension(input);
    Scene<2> scene = build_scene<2>(input);
    outcome.particles = scene.system.size();
    follow(scene, outcome);
  } catch (const std::exception& e) {
    outcome.stopped = e.what();
  }
  return outcome;
}

Outcome record(StudyRun& study, const std::string& name, const std::string& text) {
  const Stopwatch all;
  const Outcome outcome = attempt(text);
  Measurement m{.method = name, .particles = outcome.particles};
  m.time = all.seconds();
  if (outcome.stopped.empty()) {
    m.errors = {{"energy balance", outcome.energy_error}};
    m.values = {{"least gap / sigma0", outcome.least_gap / 0.4},
                {"first step / least step", outcome.first_step / outcome.least_step}};
  } else {
    m.remark = outcome.stopped;
  }
  study.record(std::move(m));
  return outcome;
}

Outcome stays_stable(StudyRun& study, const std::string& name, const std::string& text,
                     Real tolerance) {
  const Outcome outcome = record(study, name, text);
  study.require(name + ": energy balance",
                outcome.stopped.empty() ? outcome.energy_error : std::nan(""), {0, tolerance});
  return outcome;
}

/// Largest lateral force between two flat surfaces with the same lattice of points that are shifted
/// against each other, relative to their peak attraction: artificial friction.
Real pinning(Real spacing_per_gap) {
  ContactLaw law;
  law.cutoff = 4;
  const PairLaw<PairKernel::space> pair(law);
  const Real gap = plane_contact(law, 1).equilibrium_gap, h = spacing_per_gap * gap;
  const int reach = static_cast<int>(std::ceil(law.reach() / h)) + 1;
  Real largest = 0;
  for (int shift = 0; shift < 16; ++shift) {
    Real force = 0;  // per area: V.W = -h^4, T = psi V.W r
    for (int i = -reach; i <= reach; ++i)
      for (int j = -reach; j <= reach; ++j) {
        const Real x = (i + shift / 16.0) * h, y = j * h;
        const Real square = x * x + y * y + gap * gap;
        if (square < law.reach() * law.reach()) force += pair.surface(square).psi * x * h * h;
      }
    largest = std::max(largest, std::abs(force));
  }
  return largest / plane_contact(law, 1).peak_traction;
}

void run(StudyRun& study) {
  study.finish_settings();
  const Real c = std::sqrt(1100.0);
  stays_stable(
      study, "first contact at 0.1 c",
      header(1) +
          disk("left", 1, fmt::format("centre = [-1.5, 0]\ninitial_velocity = [{}, 0]", 0.05 * c)) +
          disk("right", 1,
               fmt::format("centre = [1.5, 0.2]\ninitial_velocity = [{}, 0]", -0.05 * c)) +
          contact("[\"left\", \"right\"]", "least_gap = 0.2"),
      5e-3);
  stays_stable(study, "asperity smaller than sigma0",
               header(1) + disk("tip", 0.25, "centre = [0, 0.9]\ninitial_velocity = [0, -1]\n") +
                   contact("[\"tip\"]",
                           "partner = { type = \"half_space\", point = [0, 0], "
                           "normal = [0, 1] }"),
               1e-3);
  const Outcome pressed = stays_stable(
      study, "compression to 0.6 of the equilibrium gap",
      header(1) + disk("disk", 1, "centre = [0, 0]\n") +
          "[[contact]]\nname = \"upper\"\nbodies = [\"disk\"]\nepsilon = 4\nsigma0 = 0.4\nbeta = "
          "1\npoints = 3\npartner = { type = \"half_space\", point = [0, 1.25], normal = [0, -1], "
          "displacement = [0, \"-0.3*(1 - cos(pi*t))\"] }\n" +
          contact("[\"disk\"]",
                  "partner = { type = \"half_space\", point = [0, -1.25], normal = [0, 1] }"),
      2e-2);
  study.require("compression: least gap / equilibrium gap",
                pressed.least_gap / (0.4 * std::pow(15, -1.0 / 6)), {0.47, 0.62});
  const Outcome overlap =
      record(study, "start in overlap",
             header(1) + disk("left", 1, "centre = [-1, 0]") +
                 disk("right", 1, "centre = [1.05, 0]") + contact("[\"left\", \"right\"]", ""));
  study.require("start in overlap is refused (1: yes)",
                overlap.stopped.find("surfaces overlap") != std::string::npos, {1, 1});
  for (const Real ratio : {0.4, 0.5, 0.75, 1.0})
    study.note(
        fmt::format("flat lattices in registry at the equilibrium gap, h/gap = {}: lateral "
                    "force up to {:.2g} of the peak traction",
                    ratio, pinning(ratio)));
  study.require("pinning at h/gap = 0.4", pinning(0.4), {0, 5e-3});
}

const bool registered = register_study({"contact_hard",
                                        "hard cases of contact: each stays stable, or stops and "
                                        "names the cause",
                                        "none: every case has its own size",
                                        {0},
                                        {0},
                                        run});

}  // namespace
}  // namespace meniscus
