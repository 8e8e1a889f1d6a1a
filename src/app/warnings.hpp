// SPDX-License-Identifier: BSD-3-Clause
// Run-time warnings, looked for whenever a row of the history is written.
#pragma once
#include "run/simulation.hpp"

#include <functional>
#include <set>
#include <string>

namespace meniscus {

/// Says each kind of warning once per run.
template <int D>
class Warnings {
 public:
  /// `say` is called with a sentence.
  Warnings(const Simulation<D>& simulation, std::function<void(const std::string&)> say);

  /// From now on looks at that simulation, of the same scene.
  void follow(const Simulation<D>& simulation);
  /// `ledger` of now.
  void look(const Ledger& ledger);

 private:
  /// States that a material law should not be trusted in.
  void doubtful_laws();
  /// Energy that appears or disappears, which no exact solution does.
  void imbalance(const Ledger& ledger);
  /// A surface smaller than that of the ball (2D: disk) of the same volume, which cannot be: its
  /// quadrature no longer resolves the folds that surface tension pulls into it.
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
