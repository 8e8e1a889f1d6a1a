// SPDX-License-Identifier: BSD-3-Clause
// Modes of the free elastic cube: number of zero-energy modes, lowest frequency, stiffness against
// saw-tooth modes, and highest frequency (RKPM note 5.4).
#include "study/study.hpp"
#include "study/support/cube_modes.hpp"
#include "study/support/cube_spectrum.hpp"
#include "study/support/elastic_case.hpp"

#include <fmt/core.h>

#include <cmath>

namespace meniscus::spectrum_study {
namespace {

using namespace study;

/// Energy of the saw-tooth (-1)^(i + j + k) along x at the node in the middle of a lattice, far
/// from the boundary.
Real saw_tooth_energy(const Integration& integration, Body<3>& body, int n) {
  NodalVectors u(static_cast<std::size_t>(body.size()), Lanes::zero());
  Index middle = 0;
  for (Index A = 0; A < body.size(); ++A) {
    const Vec<3> place = n * at(body.particles.X(), A);
    at(u, A).set(0, std::lround(place.sum()) % 2 ? -1 : 1);
    if ((place - Vec<3>::Constant(n / 2)).norm() < 0.5) middle = A;
  }
  const NodalVectors Ku = LinearBody<3>(body, integration, {}).stiffness_times(u);
  return 0.5 * sum(at(u, middle) * at(Ku, middle));
}

void compare_saw_teeth(StudyRun& study, const std::vector<Rule>& rules) {
  constexpr int n = 12;  // the middle is more than two supports from the boundary
  const auto body = unit_box<3>(n, 0);
  const int fine = study.brief() ? 3 : 5;
  const Real exact = saw_tooth_energy({"gauss", fine}, *body, n);
  for (const Rule& rule : rules) {
    const Real ratio = saw_tooth_energy(rule.integration, *body, n) / exact;
    study.note(
        fmt::format("energy of saw-teeth inside a lattice over that by {}^3 Gauss points, "
                    "{}: {:.3g}",
                    fine, rule.name, ratio));
    if (rule.integration.rule == "q_scni")
      study.require("energy of saw-teeth / exact, " + rule.name, ratio, {0.2, 5});
    if (rule.integration.rule == "nodal")
      study.require("energy of saw-teeth / exact, " + rule.name, ratio, {-1e-9, 1e-9});
  }
}

void run(StudyRun& study) {
  study.finish_settings();
  const std::vector<Rule> rules = elastic_rules(study.brief());
  const Real lowest = cube_modes({}, study.brief() ? 7 : 9)[6];
  for (const Real jitter : {0.0, 0.2, 0.4}) {
    if (study.brief() && jitter != 0.2) continue;
    for (const Rule& rule : rules)
      for (const int n : study.levels()) {
        const auto body = unit_box<3>(n, jitter);
        const Measurement m =
            measure_spectrum(fmt::format("jitter {:g} %, {}", 100 * jitter, rule.name),
                             rule.integration, *body, n, lowest);
        study.record(m);
        if (rule.integration.rule == "nodal") continue;
        const std::string where = fmt::format(", {}, {} particles", m.method, m.particles);
        study.require("modes without energy" + where, m.values.front().second, {6, 6});
        if (rule.integration.rule == "q_scni")
          study.require("error of the lowest frequency" + where, m.error("lowest frequency"),
                        {0, 0.02});
      }
  }
  compare_saw_teeth(study, rules);
}

const bool registered =
    register_entry(StudyEntry{"spectrum",
                              "free elastic cube: modes without energy, lowest and "
                              "highest frequency, energy of saw-teeth",
                              "cells per edge",
                              {4, 6},
                              {4},
                              run});

}  // namespace
}  // namespace meniscus::spectrum_study
