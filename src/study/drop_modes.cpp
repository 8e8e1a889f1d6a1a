// SPDX-License-Identifier: BSD-3-Clause
// Decay rate and frequency of small oscillations of a viscous drop against the exact dispersion
// relation.
#include "study/study.hpp"
#include "study/support/drop_mode_case.hpp"

#include <fmt/core.h>

#include <string>
#include <vector>

namespace meniscus::drop_modes_study {
namespace {

/// Levels at which a geometry is measured, and from which the rate is asked to be `within` its
/// error.
struct Levels {
  int asked_from, finest;
  Real within;
};

void measure(StudyRun& study, const study::DropMode& mode, const Levels& levels) {
  const std::string method =
      fmt::format("{}l = {}, Oh = {:g}", mode.revolved ? "half plane, " : "", mode.l, mode.Oh);
  int level = 0;
  for (const int cells : study.levels())
    if (cells <= levels.finest) {
      study.record(study::measure_drop_mode(method, mode, cells));
      level = cells;
    }
  if (level >= levels.asked_from)
    study.require(fmt::format("{}: error of the rate, level {}", method, level),
                  study.measurements().back().error("rate"), {0, levels.within});
}

void run(StudyRun& study) {
  const Real bulk_modulus =
      study.settings().real("bulk_modulus", dimension::none, range::positive, 400);
  study.finish_settings();
  std::vector<study::DropMode> modes{{2, 0.2}, {2, 1}};
  if (!study.brief()) {
    modes.clear();
    for (const int l : {2, 3})
      for (const Real Oh : {0.05, 0.1, 0.2, 0.5, 1.0, 2.0}) modes.push_back({l, Oh});
  }
  for (study::DropMode& mode : modes) {
    mode.bulk_modulus = bulk_modulus;
    measure(study, mode, {6, 10, 0.02});
  }
  std::vector<study::DropMode> revolved{{2, 0.2}};
  if (!study.brief())
    revolved = {{2, 0.02}, {4, 0.02}, {2, 0.2},  {3, 0.2},
                {4, 0.2},  {2, 0.93}, {3, 0.93}, {4, 0.93}};
  for (study::DropMode& mode : revolved) {
    mode.bulk_modulus = 10 * bulk_modulus;
    mode.revolved = true;
    measure(study, mode, {16, 16, 0.003});
  }
}

const bool registered =
    register_entry(StudyEntry{"drop_modes",
                              "viscous drop: decay rate and frequency of small oscillations",
                              "cells across the radius, and along an edge of the core of the ball",
                              {4, 6, 8, 10, 12, 16},
                              {4, 6},
                              run});

}  // namespace
}  // namespace meniscus::drop_modes_study
