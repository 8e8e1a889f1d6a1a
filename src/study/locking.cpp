// SPDX-License-Identifier: BSD-3-Clause
// Volumetric locking: elastostatics with a divergence-free displacement, lambda/mu from 1 to 1e4
// (RKPM note 5.4).
#include "study/study.hpp"
#include "study/support/elastic_case.hpp"
#include "study/support/elastic_fields.hpp"

#include <fmt/core.h>

namespace meniscus::locking_study {
namespace {

using namespace study;

const std::vector<Rule> rules{{"full", {"q_scni", 0, "full"}},
                              {"cell_average", {"q_scni", 0, "cell_average"}}};

std::string name_of(int D, const Rule& rule, Real ratio) {
  return fmt::format("{}D, {}, lambda/mu = {:g}", D, rule.name, ratio);
}

template <int D>
Measurement measure(const Rule& rule, const ElasticCase<D>& c, int n) {
  Measurement m;
  m.method = name_of(D, rule, c.moduli.lambda / c.moduli.mu);
  m.level = n;
  m.particles = c.body->size();
  m.h = 1.0 / n;
  const Stopwatch set_up;
  LinearBody<D> linear(*c.body, rule.integration, c.moduli);
  m.set_up = set_up.seconds();
  const Stopwatch run;
  const Solution solution = solve(linear, c, 1e-9);
  m.time = run.seconds();
  m.bytes = linear.term().bytes();
  const ElasticErrors errors = errors_of(c, solution.u);
  m.errors = {{"L2", errors.L2}, {"H1", errors.H1}};
  m.values = {{"iterations", solution.iterations}};
  if (solution.residual > 1e-7)
    m.remark = fmt::format("equations solved to {:.1g} only", solution.residual);
  return m;
}

template <int D>
void measure_all(StudyRun& study) {
  const std::vector<Real> ratios =
      study.brief() ? std::vector<Real>{1, 1e4} : std::vector<Real>{1, 1e2, 1e3, 1e4};
  std::vector<int> sizes;
  for (const int level : study.levels()) sizes.push_back(D == 2 ? 2 * level : level);
  for (const Rule& rule : rules)
    for (const Real ratio : ratios)
      for (const int n : sizes)
        study.record(measure<D>(
            rule, elastic_case<D>(unit_box<D>(n, 0.2), divergence_free_field<D>(), {1, ratio}), n));

  // Without locking the error hardly depends on lambda/mu, and has the same order of convergence.
  for (const int n : sizes) {
    const auto error = [&](const Rule& rule, Real ratio) {
      return study.find(name_of(D, rule, ratio), n)->error("L2");
    };
    study.require(fmt::format("{}D, {} cells: L2 of cell_average at lambda/mu = 1e4 over 1", D, n),
                  error(rules[1], 1e4) / error(rules[1], 1), {0, 2});
    study.require(
        fmt::format("{}D, {} cells: L2 of cell_average over full at lambda/mu = 1e4", D, n),
        error(rules[1], 1e4) / error(rules[0], 1e4), {0, 0.5});
  }
  if (sizes.size() > 1)
    study.require(fmt::format("{}D: order of L2, cell_average at lambda/mu = 1e4", D),
                  study.overall_order(name_of(D, rules[1], 1e4), "L2"), {2, unbounded});
}

void run(StudyRun& study) {
  study.finish_settings();
  measure_all<2>(study);
  measure_all<3>(study);
}

const bool registered = register_entry(
    StudyEntry{"locking",
               "nearly incompressible elastostatics: error against lambda/mu, dilatation at "
               "every stress point and averaged over cells",
               "cells per edge of a cube, half of those of a square",
               {4, 6, 9},
               {4, 6},
               run});

}  // namespace
}  // namespace meniscus::locking_study
