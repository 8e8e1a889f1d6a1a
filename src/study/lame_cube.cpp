// SPDX-License-Identifier: BSD-3-Clause
// State error against time to solution: the free cube in its Lame mode, an exact solution of linear
// elastodynamics (performance note 3).
#include "study/study.hpp"
#include "study/support/lame_cube_case.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace meniscus::lame_cube_study {
namespace {

/// A method; `keys` are further keys of the body.
struct Method {
  std::string name, keys;
};

/// Results of other codes with one thread (performance note 3).
struct Peer {
  const char* code;
  const char* deck;
  int particles;
  Real state_error, seconds;
};
constexpr std::array<Peer, 8> peers{
    {{"LAMMPS 29 Sep 2021, MACHDYN smd/tlsph", "in.lame_smd", 4913, 0.165, 3.06},
     {"LAMMPS 29 Sep 2021, MACHDYN smd/tlsph", "in.lame_smd", 29791, 0.079, 35.5},
     {"Karamelo, TLMPM linear", "lame.mpm", 32768, 0.217, 8.7},
     {"OpenIFEM rkpm-rk4, linear basis", "of its own form", 4913, 0.061, 17.6},
     {"CalculiX 2.20, explicit C3D8", "gen_ccx.py", 15625, 0.0221, 7.7},
     {"CalculiX 2.20, explicit C3D8", "gen_ccx.py", 35937, 0.0122, 25.6},
     {"CalculiX 2.20, implicit C3D20", "gen_ccx.py", 425, 0.0069, 8.2},
     {"CalculiX 2.20, implicit C3D20", "gen_ccx.py", 1225, 0.0051, 38}}};

/// Notes the cost of the coarsest cube of the method with at most 1 % error.
void compare(StudyRun& study, const std::string& method) {
  for (const Measurement& m : study.measurements()) {
    if (m.method != method || m.error("state") > 0.01) continue;
    const auto processor = std::find_if(m.values.begin(), m.values.end(), [](const auto& value) {
      return value.first == "processor s";
    });
    study.note(
        fmt::format("at most 1 % by {}: {} particles, state error {:.3g}, steps {:.3g} s of "
                    "processor time, set-up {:.3g} s",
                    method, m.particles, m.error("state"), processor->second, m.set_up));
    break;
  }
}

void run(StudyRun& study) {
  study.finish_settings();
  std::vector<Method> methods{{"q_scni", ""},
                              {"gauss 2", "integration = \"gauss\"\ngauss_points = 2"}};
  if (!study.brief()) {
    methods.push_back({"gauss 3", "integration = \"gauss\"\ngauss_points = 3"});
    methods.push_back({"gauss 5", "integration = \"gauss\"\ngauss_points = 5"});
    methods.push_back({"nodal", "integration = \"nodal\""});
  }
  for (const Method& method : methods)
    for (const int cells : study.levels())
      study.record(study::measure_lame_cube(method.name, cells, method.keys));

  if (study.levels().size() > 1)
    study.require("order of the state error, q_scni", study.overall_order("q_scni", "state"),
                  {3, unbounded});
  if (const Measurement* m = study.find("q_scni", 12))
    study.require("state error of q_scni, 12 cells per edge", m->error("state"), {0, 0.01});
  for (const Method& method : methods) compare(study, method.name);
  for (const Peer& peer : peers)
    study.note(
        fmt::format("measured elsewhere, one thread: {} (deck {}), {} particles or nodes: "
                    "state error {:.3g} in {:.3g} s",
                    peer.code, peer.deck, peer.particles, peer.state_error, peer.seconds));
}

const bool registered = register_entry(
    StudyEntry{"lame_cube",
               "elastodynamics: state error of a free cube after two periods of its Lame mode",
               "cells per edge",
               {4, 6, 8, 12, 16},
               {4, 6, 8},
               run});

}  // namespace
}  // namespace meniscus::lame_cube_study
