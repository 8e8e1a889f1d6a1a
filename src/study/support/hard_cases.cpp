// SPDX-License-Identifier: BSD-3-Clause
// Runs of hard cases.
#include "study/support/hard_cases.hpp"

#include "meniscus/error.hpp"
#include "run/simulation.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace meniscus::study {
namespace {

constexpr Range yes{1, 1};

template <int D>
void note_watched(const Simulation<D>& simulation, const HardRun& how, HardOutcome& outcome) {
  for (const MeasureSource& m : simulation.scene().measures) {
    if (std::find(how.watched.begin(), how.watched.end(), m.name) == how.watched.end()) continue;
    const Real value = m.compute(simulation.state().motion());
    const auto [entry, is_first] = outcome.least.emplace(m.name, value);
    if (!is_first) entry->second = std::min(entry->second, value);
  }
}

template <int D>
void audit(Simulation<D>& simulation, HardOutcome& outcome) {
  const Ledger ledger = simulation.audit_now();
  const Audit& audit = simulation.audit();
  outcome.final_energy_error = std::abs(audit.balance_error(ledger));
  outcome.energy_error = std::max(outcome.energy_error, outcome.final_energy_error);
  outcome.momentum_error = std::max(outcome.momentum_error, audit.momentum_error(ledger));
  outcome.angular_momentum_error =
      std::max(outcome.angular_momentum_error, audit.angular_momentum_error(ledger));
}

template <int D>
void follow(Simulation<D>& simulation, const HardRun& how, HardOutcome& outcome) {
  const Real end = simulation.scene().time.end;
  simulation.begin();
  while (simulation.state().time < end && outcome.steps < how.largest_step_number) {
    simulation.advance();
    ++outcome.steps;
    const Real allowed = simulation.controller().allowed();
    if (outcome.steps == 1) outcome.first_allowed_step = allowed;
    outcome.least_allowed_step = std::min(outcome.least_allowed_step, allowed);
    if (!how.watched.empty()) note_watched(simulation, how, outcome);
    if (static_cast<std::int64_t>(outcome.steps) % 50 == 0) audit(simulation, outcome);
  }
  audit(simulation, outcome);
}

template <int D>
void attempt(const SceneInput& input, const HardRun& how, HardOutcome& outcome) {
  Scene<D> scene = build_scene<D>(input);
  outcome.particles = scene.system.size();
  for (const auto& text : scene.notes) outcome.remarks += text + "\n";
  for (const auto& text : scene.warnings) outcome.remarks += text + "\n";
  Simulation<D> simulation(scene);
  follow(simulation, how, outcome);
  for (const MeasureSource& m : scene.measures)
    outcome.measures[m.name] = m.compute(simulation.state().motion());
  for (const Residual& r : simulation.stepper().residuals(simulation.state()))
    outcome.measures[r.meaning] = r.value;
}

HardOutcome attempt(const std::string& scene_text, const HardRun& how) {
  HardOutcome outcome;
  try {
    const SceneInput input = SceneInput::from_text(scene_text);
    scene_dimension(input) == 2 ? attempt<2>(input, how, outcome) : attempt<3>(input, how, outcome);
  } catch (const SolveError& e) {
    outcome.stopped = e.what();
  } catch (const InputError& e) {
    outcome.stopped = e.what();
  }
  return outcome;
}

}  // namespace

Real HardOutcome::measure(const std::string& name) const {
  const auto found = measures.find(name);
  return found == measures.end() ? std::numeric_limits<Real>::quiet_NaN() : found->second;
}

HardOutcome HardCases::stays_stable(const std::string& name, const std::string& scene, Real bound,
                                    const HardRun& how) {
  if (!wants(name)) return {};
  const Stopwatch clock;
  const HardOutcome outcome = attempt(scene, how);
  record(name, outcome, clock.seconds());
  require(name, "runs to its end", outcome.stopped.empty(), yes);
  require(name, "largest error of the energy balance", outcome.energy_error, {0, bound});
  return outcome;
}

void HardCases::stops(const std::string& name, const std::string& scene, const std::string& cause) {
  if (!wants(name)) return;
  const Stopwatch clock;
  const HardOutcome outcome = attempt(scene, {});
  record(name, outcome, clock.seconds());
  require(name, "stops and names '" + cause + "'", outcome.stopped.find(cause) != std::string::npos,
          yes);
}

void HardCases::require(const std::string& name, const std::string& what, Real value,
                        Range allowed) {
  if (wants(name)) study_.require(name + ": " + what, value, allowed);
}

void HardCases::says(const std::string& name, const HardOutcome& outcome, const std::string& text) {
  require(name, "the log says '" + text + "'", outcome.remarks.find(text) != std::string::npos,
          yes);
}

void HardCases::record(const std::string& name, const HardOutcome& outcome, Real seconds) {
  Measurement m;
  m.method = name;
  m.particles = outcome.particles;
  m.values = {{"steps", outcome.steps},
              {"energy error", outcome.energy_error},
              {"at the end", outcome.final_energy_error}};
  for (const auto& [measure, least] : outcome.least)
    m.values.emplace_back("least " + measure, least);
  m.time = seconds;
  m.remark = outcome.stopped;
  study_.record(m);
}

}  // namespace meniscus::study
