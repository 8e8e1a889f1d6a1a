// SPDX-License-Identifier: BSD-3-Clause
// Run-time warnings, looked for whenever a row of the history is written.
#pragma once
#include "run/simulation.hpp"

#include <functional>
#include <set>
#include <string>

namespace meniscus {

/// Prints each kind of warning at most once per run.
template <int D>
class Warnings {
 public:
  /// `say` is called with a sentence.
  Warnings(const Simulation<D>& simulation, std::function<void(const std::string&)> say);

  /// From now on checks this simulation, which must be of the same scene.
  void follow(const Simulation<D>& simulation);
  /// Checks the present state. `ledger` is the ledger of this state.
  void look(const Ledger& ledger);

 private:
  /// Warns of states in which a material law is not reliable.
  void doubtful_laws();
  /// Warns if energy appears or disappears, which no exact solution does.
  void imbalance(const Ledger& ledger);
  /// Warns if the surface area of a body is smaller than the area of a ball (2D: the perimeter of a
  /// disk) of the same volume. This is impossible, so the quadrature no longer resolves folds that
  /// surface tension makes in the surface.
  void impossible_areas();

  struct Enclosure {
    std::string body;
    const MeasureSource *area, *volume;
  };

  const Simulation<D>* simulation_;
  std::function<void(const std::string&)> say_;
  std::vector<Enclosure> enclosures_;  ///< bodies under surface tension
  std::set<std::string> said_;
};

}  // namespace meniscus
