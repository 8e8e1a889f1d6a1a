// SPDX-License-Identifier: BSD-3-Clause
// Small oscillations of a viscous drop against the exact dispersion relation.
#pragma once
#include "meniscus/study/study.hpp"

namespace meniscus::study {

/// R = rho = gamma = 1: time in units of sqrt(rho R^3 / gamma).
struct DropMode {
  int l;    ///< 2 or 3
  Real Oh;  ///< viscosity
  Real bulk_modulus = 400;
  std::string body_keys = {};  ///< further keys of the drop
};

/// A sphere in its Laplace pressure is thrown into the potential flow grad(r^l P_l); once the
/// vortical modes of that start have died out, the amplitude of P_l is one damped mode, whose decay
/// rate and frequency are fitted. `core`: cells along an edge of the core of the ball.
Measurement measure_drop_mode(const std::string& method, const DropMode& mode, int core);

}  // namespace meniscus::study
