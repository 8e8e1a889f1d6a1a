// SPDX-License-Identifier: BSD-3-Clause
// Frequencies of the free elastic cube of particles.
#include "study/support/cube_spectrum.hpp"

#include "kernel/point_rows.hpp"
#include "study/support/eigenvalues.hpp"

#include <cmath>

namespace meniscus::study {
namespace {

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

/// Eigenvalues omega^2 of K w = omega^2 M w with lumped masses M, ascending.
Eigen::VectorXd lumped_spectrum(const Eigen::MatrixXd& K, const Body<3>& body) {
  Eigen::VectorXd scale(K.rows());
  for (Index row = 0; row < K.rows(); ++row) scale[row] = 1 / std::sqrt(at(body.mass, row / 3));
  return symmetric_eigenvalues(scale.asDiagonal() * K * scale.asDiagonal());
}

}  // namespace

Measurement measure_spectrum(const std::string& method, const Integration& integration,
                             Body<3>& body, int n, Real lowest) {
  Measurement m;
  m.method = method;
  m.level = n;
  m.particles = body.size();
  m.h = 1.0 / n;
  const Stopwatch set_up;
  LinearBody<3> linear(body, integration, {});
  m.set_up = set_up.seconds();
  m.bytes = linear.term().bytes();
  const Stopwatch run;
  const Eigen::MatrixXd K = stiffness(linear);
  const Eigen::VectorXd lumped = lumped_spectrum(K, body);
  const Eigen::VectorXd consistent = symmetric_eigenvalues(K, consistent_mass(body));
  m.time = run.seconds();
  const auto zeros = (lumped.array() < 1e-9 * lowest).count();
  m.errors = {{"lowest frequency", std::abs(std::sqrt(consistent[6] / lowest) - 1)}};
  // Wide supports have modes that change coefficients but hardly move material points. With lumped
  // masses, which count coefficients, their frequencies are low.
  m.values = {{"modes without energy", static_cast<Real>(zeros)},
              {"softest with lumped masses / lowest", std::sqrt(lumped[zeros] / lowest)},
              {"highest frequency h / c", std::sqrt(lumped[lumped.size() - 1] / 3) / n}};
  return m;
}

}  // namespace meniscus::study
