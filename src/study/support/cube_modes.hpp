// SPDX-License-Identifier: BSD-3-Clause
// Vibrations of the free elastic unit cube.
#pragma once
#include "study/support/elastic_case.hpp"

#include <vector>

namespace meniscus::study {

/// Squared circular frequencies of the free unit cube of density 1, ascending, by the Rayleigh-Ritz
/// method with products of Legendre polynomials of total degree <= `degree`. The first six are
/// zero.
std::vector<Real> cube_modes(Moduli moduli, int degree);

}  // namespace meniscus::study
