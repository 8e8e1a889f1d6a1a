// SPDX-License-Identifier: BSD-3-Clause
// Frequencies of the free elastic cube of particles.
#pragma once
#include "meniscus/study/study.hpp"

#include "elastic_case.hpp"

namespace meniscus::study {

/// All of them by dense matrices: the error of the lowest with consistent masses, relative to the
/// root of `lowest`; with lumped masses the number of modes without energy, the softest and the
/// highest. `body` is a unit cube of n cells per edge.
Measurement measure_spectrum(const std::string& method, const Integration& integration,
                             Body<3>& body, int n, Real lowest);

}  // namespace meniscus::study
