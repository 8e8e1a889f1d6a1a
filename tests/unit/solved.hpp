// SPDX-License-Identifier: BSD-3-Clause
// Scenes that have been run to their end.
#pragma once
#include "cases.hpp"
#include "run/simulation.hpp"
#include "solve/newton/quasi_statics.hpp"

namespace meniscus::test {

/// A scene that has been run to its end, with the notes on the way.
template <int D>
struct Solved {
  Scene<D> scene;
  Simulation<D> simulation;
  std::vector<std::string> notes;

  explicit Solved(const std::string& text) : scene(scene_of<D>(text)), simulation(scene) {
    simulation.begin();
    while (!simulation.finished()) {
      simulation.advance();
      simulation.audit_now();
      for (const std::string& note : simulation.take_notes()) notes.push_back(note);
    }
  }
  Ledger ledger() const { return take_ledger(scene.system, simulation.state()); }
  const QuasiStatics<D>& quasi_statics() const {
    return dynamic_cast<const QuasiStatics<D>&>(simulation.stepper());
  }
  const NewtonMethod<D>& newton() const { return quasi_statics().method(); }
  Real measure(const std::string& name) const {
    for (const MeasureSource& m : scene.measures)
      if (m.name == name) return m.compute(simulation.state().motion());
    throw std::logic_error(name);
  }
};

}  // namespace meniscus::test
