// SPDX-License-Identifier: BSD-3-Clause
// Small oscillations of a viscous drop against the exact dispersion relation.
#pragma once
#include "study/study.hpp"

namespace meniscus::study {

/// A mode of a drop with R = rho = gamma = 1: time is in units of sqrt(rho R^3 / gamma).
struct DropMode {
  int l;    ///< number of the mode, 2 to 4
  Real Oh;  ///< viscosity in these units
  Real bulk_modulus = 400;
  std::string body_keys = {};  ///< further keys of the drop
  bool revolved = false;       ///< the drop is a body of revolution in the half plane
};

/// Starts a sphere in its Laplace pressure with the potential flow grad(r^l P_l). After the
/// vortical modes of this start have decayed, the amplitude of P_l is one damped mode, whose decay
/// rate and frequency are fitted. `core`: cells along an edge of the core of the ball, and
/// across its radius.
Measurement measure_drop_mode(const std::string& method, const DropMode& mode, int core);

}  // namespace meniscus::study
