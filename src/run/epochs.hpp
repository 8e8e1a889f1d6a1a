// SPDX-License-Identifier: BSD-3-Clause
// The epochs of a run: whenever bodies are referred anew, its scene is built again.
#pragma once
#include "remap/remap.hpp"
#include "run/simulation.hpp"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace meniscus {

/// The scene in motion, from one reference of its bodies to the next. Nothing that was built
/// changes: a new epoch is a new scene, to which the motion, the history of force terms, the books
/// and the audit are carried over.
template <int D>
class Epochs {
 public:
  /// The first epoch, or that of a state that is then restored. Throws as build(), Simulation and
  /// Simulation::restore.
  explicit Epochs(Plan<D> plan, const Snapshot* state = nullptr);

  Simulation<D>& simulation() { return *simulation_; }
  const Simulation<D>& simulation() const { return *simulation_; }
  const Scene<D>& scene() const { return *scene_; }

  /// What became of the remaps that were due after a step.
  struct Remapped {
    bool new_epoch = false;
    std::vector<std::string> notes, warnings;  ///< what was done, and what had to be refused
  };
  /// A step as Simulation::advance(), then the remaps of the scene that are due. One that is
  /// impossible is left out.
  Remapped advance();

  /// Where the nodes of bodies are to be, by the names of the bodies.
  using Nodes = std::map<std::string, Seeds<D>>;
  /// Begins a new epoch with the nodes of some bodies at these places of now. What refers to the
  /// scene or the simulation ends. Throws InputError or SolveError if that cannot be (a cell folds,
  /// no material is there, shape functions or forces cannot be computed): then the old epoch goes
  /// on.
  void new_epoch(const Nodes& nodes);

  /// Goes on from a state of any epoch of this scene.
  void restore(const Snapshot& state);

 private:
  void build_again(const References<D>& references);
  bool due(const PlannedRemap& planned, Real time_before) const;
  /// Of body number b.
  Seeds<D> seeds(const PlannedRemap& planned, std::size_t b) const;

  Plan<D> plan_;
  std::unique_ptr<Scene<D>> scene_;
  std::unique_ptr<Simulation<D>> simulation_;
};

}  // namespace meniscus
