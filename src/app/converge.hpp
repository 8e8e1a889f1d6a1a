// SPDX-License-Identifier: BSD-3-Clause
// Runs a scene at several spacings, and reports the error of its results.
#pragma once
#include "numbers/types.hpp"

#include <string>
#include <vector>

namespace meniscus {

struct ConvergeRequest {
  std::string scene, output;
  std::vector<std::string> set;  ///< "key=value", for all levels
  std::vector<std::string> of;   ///< columns of the history whose last value is reported, too
  int levels = 3;
  Real factor = 0;  ///< by which the cells of a level are finer than before; 0: 2, in 3D 1.5
  int threads = 0;  ///< 0: all cores
  bool hold_lengths = false;  ///< lengths that follow the cells are those of the first level
  bool budget = false;        ///< also the errors of other approximations of the scene
  bool overwrite = false;
};

/// Runs the levels that have not been run yet. Prints a line for each expectation of the scene: its
/// values, the observed order, the limit and its error bar, and the seconds to 1 % and 0.1 % of the
/// limit. Writes the same to convergence.csv, and with `budget` the parts of the error of the scene
/// itself to budget.csv. A signal stops it; the same command then continues it. Returns the exit
/// code of a run that failed; exit_expectation if an order or error bar of [expect] is
/// missed, and otherwise 0. Throws InputError, FileError.
int converge(const ConvergeRequest& request);

}  // namespace meniscus
