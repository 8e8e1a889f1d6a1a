// SPDX-License-Identifier: BSD-3-Clause
// The free cube in its Lame mode, an exact solution of linear elastodynamics (performance note 3).
#pragma once
#include "study/study.hpp"

namespace meniscus::study {

/// State error of a cube with `cells` per edge after two periods, with steps and processor time.
/// `body_keys` are keys of the body, including its support. The amplitude 1e-5 keeps the
/// neo-Hookean law linear to 1e-5.
Measurement measure_lame_cube(const std::string& method, int cells, const std::string& body_keys);

}  // namespace meniscus::study
