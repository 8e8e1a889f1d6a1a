// SPDX-License-Identifier: BSD-3-Clause
// Small oscillations of a viscous incompressible drop: the exact dispersion relation.
#pragma once
#include "numbers/elementary.hpp"

namespace meniscus {

/// Rate s of mode l >= 2 with amplitude ~ exp(s t), in units of the capillary time sqrt(rho
/// R^3/gamma). Oh = mu / sqrt(rho gamma R). For an oscillating mode, s is the root with Im s > 0 of
/// the pair s, conj(s). For an overdamped mode, s is the slow root, with Im s = 0 (Lamb,
/// Chandrasekhar; RKPM note 7). Throws std::domain_error if the iteration fails, which happens only
/// next to the critical Oh.
Complex drop_mode_rate(int l, Real Oh);

}  // namespace meniscus
