// SPDX-License-Identifier: BSD-3-Clause
// The parameters of a scene that are as large or small as computing time asks for, and whose limit
// is meant: what they contribute to the error.
#pragma once
#include "input/input.hpp"
#include "numbers/types.hpp"

#include <string>
#include <vector>

namespace meniscus {

/// One such parameter: keys of the scene that change together, and their values in three runs. The
/// scene itself is the first or the last of them.
struct ModelError {
  std::string name;                              ///< such as "range"
  std::vector<std::string> keys;                 ///< such as "contact[0].range"
  std::vector<std::vector<std::string>> values;  ///< [run][key]; empty: the scene itself
  std::vector<Real> h;                           ///< of each run, relative to the scene's; falls
  bool scene_is_first = false;
};

/// The parameters of a scene: ranges of contacts of fluids (the scene's, 1.5 and 1.5^2 times as
/// long), bulk moduli of fluids (the scene's, 1/1.5 and 1/1.5^2 of them), the step of dynamics (the
/// scene's and shorter ones), and the tolerances of relax (the scene's, 1/4 and 1/16 of them).
std::vector<ModelError> model_errors(const SceneInput& input);

}  // namespace meniscus
