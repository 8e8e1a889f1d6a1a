// SPDX-License-Identifier: BSD-3-Clause
// Cases of bodies of revolution, which the cases in 2D contain.
#pragma once
#include "cases.hpp"

namespace meniscus::test {

std::vector<Case> revolved_cases();

}  // namespace meniscus::test
