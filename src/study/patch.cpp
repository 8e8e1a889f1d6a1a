// SPDX-License-Identifier: BSD-3-Clause
// Patch tests of elasticity: a free body under the loads of a linear and of a quadratic
// displacement must find that displacement (RKPM note 5.4).
#include "study/study.hpp"
#include "study/support/elastic_case.hpp"
#include "study/support/elastic_fields.hpp"

#include <fmt/core.h>

namespace meniscus::patch_study {
namespace {

using namespace study;

/// Cells share volume changes in stiff solids only.
Moduli moduli_of(const Rule& rule) {
  return {1, rule.integration.volumetric == "cell_average" ? 100.0 : 1.0};
}

template <int D>
Measurement measure(const Rule& rule, int n, Real jitter) {
  Measurement m;
  m.method = fmt::format("{}D, jitter {:g} %, {}", D, 100 * jitter, rule.name);
  m.level = n;
  m.h = 1.0 / n;
  Real iterations = 0;
  for (const bool quadratic : {false, true}) {
    const auto c =
        elastic_case<D>(unit_box<D>(n, jitter), polynomial_field<D>(quadratic), moduli_of(rule));
    const Stopwatch set_up;
    LinearBody<D> linear(*c.body, rule.integration, c.moduli);
    m.set_up += set_up.seconds();
    const Stopwatch run;
    const Solution solution = solve(linear, c, 1e-15);
    m.time += run.seconds();
    m.particles = c.body->size();
    m.bytes = linear.term().bytes();
    iterations += solution.iterations;
    const ElasticErrors errors = errors_of(c, solution.u);
    const std::string field = quadratic ? "quadratic " : "linear ";
    m.errors.emplace_back(field + "H1", errors.H1);
    m.errors.emplace_back(field + "L2", errors.L2);
  }
  m.values = {{"iterations", iterations}};
  return m;
}

/// Required accuracy: q_scni passes both tests; where cells share volume changes, the linear one.
void require(StudyRun& study, const Measurement& m, const Rule& rule) {
  if (rule.integration.rule != "q_scni") return;
  const auto passes = [&](const std::string& field) {
    study.require(fmt::format("{} patch, {}, {} particles", field, m.method, m.particles),
                  m.error(field + " H1"), {0, 1e-12});
  };
  passes("linear");
  if (rule.integration.volumetric == "full") passes("quadratic");
}

template <int D>
void measure_all(StudyRun& study, const std::vector<Rule>& rules) {
  for (const Real jitter : {0.0, 0.2, 0.4})
    for (const Rule& rule : rules) {
      if (study.brief() && jitter != 0.4) continue;
      for (const int level : study.levels()) {
        const Measurement m = measure<D>(rule, D == 2 ? 2 * level : level, jitter);
        study.record(m);
        require(study, m, rule);
      }
    }
}

void run(StudyRun& study) {
  study.finish_settings();
  std::vector<Rule> rules = elastic_rules(study.brief());
  rules.push_back({"q_scni, cell_average", {"q_scni", 0, "cell_average"}});
  measure_all<2>(study, rules);
  measure_all<3>(study, rules);
}

const bool registered = register_entry(
    StudyEntry{"patch",
               "elastic patch tests: a linear and a quadratic displacement under their loads",
               "cells per edge of a cube, half of those of a square",
               {4, 8},
               {4},
               run});

}  // namespace
}  // namespace meniscus::patch_study
