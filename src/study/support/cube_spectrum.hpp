// SPDX-License-Identifier: BSD-3-Clause
// Frequencies of the free elastic cube of particles.
#pragma once
#include "study/study.hpp"
#include "study/support/elastic_case.hpp"

namespace meniscus::study {

/// Frequencies from dense matrices. With consistent masses: the error of the lowest, relative to
/// the root of `lowest`. With lumped masses: the number of zero-energy modes, the softest and the
/// highest frequency. `body` is a unit cube of n cells per edge.
Measurement measure_spectrum(const std::string& method, const Integration& integration,
                             Body<3>& body, int n, Real lowest);

}  // namespace meniscus::study
