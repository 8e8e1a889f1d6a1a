// SPDX-License-Identifier: BSD-3-Clause
// Modes of the free elastic cube: motions without energy, the lowest frequency, the stiffness
// against saw-teeth, and the highest frequency (RKPM note 5.4).
#include "meniscus/approx/point_rows.hpp"
#include "meniscus/study/study.hpp"

#include <fmt/core.h>

#include <cmath>

#include "support/cube_modes.hpp"
#include "support/eigenvalues.hpp"
#include "support/elastic_case.hpp"

namespace meniscus::spectrum_study {
namespace {

using namespace study;

/// The stiffness matrix, column by column.
Eigen::MatrixXd stiffness(LinearBody<3>& linear) {
  const Index n = linear.size();
  Eigen::MatrixXd K(3 * n, 3 * n);
  NodalVectors unit(static_cast<std::size_t>(n), Lanes::zero());
  for (Index column = 0; column < 3 * n; ++column) {
    at(unit, column / 3).set(column % 3, 1);
    const NodalVectors Ku = linear.stiffness_times(unit);
    at(unit, column / 3) = Lanes::zero();
    for (Index row = 0; row < 3 * n; ++row) K(row, column) = at(Ku, row / 3)[row % 3];
  }
  return 0.5 * (K + K.transpose());
}

/// Integrals of N_A N_B for each component.
Eigen::MatrixXd consistent_mass(const Body<3>& body) {
  const auto points = cell_gauss_points(body.geometry.grid, 4);
  const auto rows = build_point_rows<3>(body.particles, points.X, {.value = true}, body.name);
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(3 * body.size(), 3 * body.size());
  for (Index q = 0; q < rows.size(); ++q)
    for (Offset a = at(rows.start, q); a < at(rows.start, q + 1); ++a)
      for (Offset b = at(rows.start, q); b < at(rows.start, q + 1); ++b) {
        const Real m = at(points.weight, q) * at(rows.value, a) * at(rows.value, b);
        for (int i = 0; i < 3; ++i)
          M(3 * at(rows.particle, a) + i, 3 * at(rows.particle, b) + i) += m;
      }
  return M;
}

/// omega^2 of K w = omega^2 M w with the lumped masses, ascending.
Eigen::VectorXd lumped_spectrum(const Eigen::MatrixXd& K, const Body<3>& body) {
  Eigen::VectorXd scale(K.rows());
  for (Index row = 0; row < K.rows(); ++row) scale[row] = 1 / std::sqrt(at(body.mass, row / 3));
  return symmetric_eigenvalues(scale.asDiagonal() * K * scale.asDiagonal());
}

Measurement measure(const Rule& rule, Body<3>& body, int n, Real jitter, Real lowest) {
  Measurement m;
  m.method = fmt::format("jitter {:g} %, {}", 100 * jitter, rule.name);
  m.level = n;
  m.particles = body.size();
  m.h = 1.0 / n;
  const Stopwatch set_up;
  LinearBody<3> linear(body, rule.integration, {});
  m.set_up = set_up.seconds();
  m.bytes = linear.term().bytes();
  const Stopwatch run;
  const Eigen::MatrixXd K = stiffness(linear);
  const Eigen::VectorXd lumped = lumped_spectrum(K, body);
  const Eigen::VectorXd consistent = symmetric_eigenvalues(K, consistent_mass(body));
  m.time = run.seconds();
  const auto zeros = (lumped.array() < 1e-9 * lowest).count();
  m.errors = {{"lowest frequency", std::abs(std::sqrt(consistent[6] / lowest) - 1)}};
  // Wide supports have modes in which coefficients move and places hardly do. Lumped masses, which
  // count coefficients, see them as soft.
  m.values = {{"modes without energy", static_cast<Real>(zeros)},
              {"softest with lumped masses / lowest", std::sqrt(lumped[zeros] / lowest)},
              {"highest frequency h / c", std::sqrt(lumped[lumped.size() - 1] / 3) / n}};
  return m;
}

/// Energy of the saw-tooth (-1)^(i + j + k) along x at the node in the middle of a lattice, where
/// the boundary does not matter.
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
  std::vector<Rule> rules = elastic_rules(study.brief());
  rules.push_back({"q_scni, cell_average", {"q_scni", 0, "cell_average"}});
  const Real lowest = cube_modes({}, study.brief() ? 7 : 9)[6];
  for (const Real jitter : {0.0, 0.2, 0.4}) {
    if (study.brief() && jitter != 0.2) continue;
    for (const Rule& rule : rules)
      for (const int n : study.levels()) {
        const auto body = unit_box<3>(n, jitter);
        const Measurement m = measure(rule, *body, n, jitter, lowest);
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
