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
    const std::string method = fmt::format("l = {}, Oh = {:g}", mode.l, mode.Oh);
    for (const int core : study.levels())
      study.record(study::measure_drop_mode(method, mode, core));
    const Measurement& finest = study.measurements().back();
    if (finest.level >= 6)
      study.require(finest.method + ": error of the rate, " + std::to_string(finest.level) +
                        " cells per edge of the core",
                    finest.error("rate"), {0, 0.02});
  }
}

const bool registered = register_entry(
    StudyEntry{"drop_modes",
               "viscous drop: decay rate and frequency of small oscillations, l = 2 and 3",
               "cells per edge of the core of the ball",
               {4, 6, 8, 10},
               {4, 6},
               run});

}  // namespace
}  // namespace meniscus::drop_modes_study
