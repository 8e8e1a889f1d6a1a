// SPDX-License-Identifier: BSD-3-Clause
// Convergence in elastostatics: a free body under the loads of a smooth displacement (RKPM
// note 5.4), lambda = mu.
#include "study/study.hpp"
#include "study/support/elastic_case.hpp"
#include "study/support/elastic_fields.hpp"

#include <fmt/core.h>

#include <cmath>

namespace meniscus::elasticity_study {
namespace {

using namespace study;

/// Random clouds of one size, each with its loads.
template <int D>
struct Clouds {
  int n;
  std::vector<ElasticCase<D>> cases;

  Clouds(int cells, Real jitter, int count) : n(cells) {
    for (int seed = 1; seed <= count; ++seed)
      cases.push_back(elastic_case<D>(unit_box<D>(n, jitter, static_cast<std::uint64_t>(seed)),
                                      smooth_field<D>(), {}));
  }
};

/// Root mean square errors over all clouds, and the time of one cloud.
template <int D>
Measurement measure(const Rule& rule, const Clouds<D>& clouds, const std::string& method) {
  Measurement m;
  m.method = method;
  m.level = clouds.n;
  m.h = 1.0 / clouds.n;
  Real L2 = 0, H1 = 0, iterations = 0;
  const Real share = 1.0 / static_cast<Real>(clouds.cases.size());
  for (const ElasticCase<D>& c : clouds.cases) {
    const Stopwatch set_up;
    LinearBody<D> linear(*c.body, rule.integration, c.moduli);
    m.set_up += share * set_up.seconds();
    const Stopwatch run;
    const Solution solution = solve(linear, c, 1e-9);
    m.time += share * run.seconds();
    m.particles = c.body->size();
    m.bytes = linear.term().bytes();
    const ElasticErrors errors = errors_of(c, solution.u);
    L2 += share * errors.L2 * errors.L2;
    H1 += share * errors.H1 * errors.H1;
    iterations += share * solution.iterations;
    if (solution.residual > 1e-7)
      m.remark = fmt::format("equations solved to {:.1g} only", solution.residual);
  }
  m.errors = {{"L2", std::sqrt(L2)}, {"H1", std::sqrt(H1)}};
  m.values = {{"iterations", iterations}};
  return m;
}

/// Smallest accepted orders of q_scni. Boundary nodes of a cube move along the boundary only, so
/// coarse clouds are more regular than fine ones. Their errors are smaller for that, which lowers
/// the observed orders. From 6 cells per edge on the effect is small.
constexpr Real least_L2_order = 2.8, least_H1_order = 1.9;

template <int D>
void measure_all(StudyRun& study, const std::vector<Rule>& rules) {
  for (const Real jitter : {0.0, 0.2, 0.4}) {
    if (study.brief() && jitter != 0.2) continue;
    std::vector<Clouds<D>> clouds;
    for (const int level : study.levels()) {
      // Coarse levels use more clouds, so that all levels average over about the same number of
      // particles.
      const Real refined = std::pow(study.levels().back() / Real(level), D);
      clouds.emplace_back(D == 2 ? 2 * level : level, jitter,
                          jitter > 0 ? 1 + static_cast<int>(refined) : 1);
    }
    const auto name = [&](const Rule& rule) {
      return fmt::format("{}D, jitter {:g} %, {}", D, 100 * jitter, rule.name);
    };
    for (const Rule& rule : rules)
      for (const Clouds<D>& c : clouds) study.record(measure(rule, c, name(rule)));
    if (clouds.size() < 2) continue;
    const std::string method = name(rules.front());
    study.require("order of L2, " + method, study.overall_order(method, "L2"),
                  {least_L2_order, unbounded});
    study.require("order of H1, " + method, study.overall_order(method, "H1"),
                  {least_H1_order, unbounded});
  }
}

void run(StudyRun& study) {
  study.finish_settings();
  const std::vector<Rule> rules = elastic_rules(study.brief());
  measure_all<2>(study, rules);
  measure_all<3>(study, rules);
}

const bool registered = register_entry(
    StudyEntry{"elasticity",
               "elastostatics: errors of a smooth displacement under its loads, mean of several "
               "irregular clouds",
               "cells per edge of a cube, half of those of a square",
               {6, 9, 12, 16},
               {4, 8},
               run});

}  // namespace
}  // namespace meniscus::elasticity_study
