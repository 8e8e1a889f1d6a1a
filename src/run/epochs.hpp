// SPDX-License-Identifier: BSD-3-Clause
// The epochs of a run. After each remap of bodies, the scene is built again and a new epoch begins.
#pragma once
#include "remap/remap.hpp"
#include "run/simulation.hpp"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace meniscus {

/// The running simulation across remaps. A new epoch makes a new scene; objects of the old one do
/// not change. The motion, the history of force terms, the books and the audit are transferred to
/// the new scene.
template <int D>
class Epochs {
 public:
  /// Begins the first epoch, in the initial state of the scene, or continues from `state`. Throws
  /// like read_initial_state(), build(), Simulation and Simulation::restore.
  explicit Epochs(Plan<D> plan, const Snapshot* state = nullptr);

  Simulation<D>& simulation() { return *simulation_; }
  const Simulation<D>& simulation() const { return *simulation_; }
  const Scene<D>& scene() const { return *scene_; }

  /// Result of the remaps that were due after a step.
  struct Remapped {
    bool new_epoch = false;
    std::vector<std::string> notes,
        warnings;  ///< remaps that were made, and remaps that were impossible
  };
  /// Makes a step by Simulation::advance(), then the remaps that are due. Impossible remaps are
  /// skipped.
  Remapped advance();

  /// New node positions of bodies, by the name of the body.
  using Nodes = std::map<std::string, Seeds<D>>;
  /// Begins a new epoch in which the bodies in `nodes` have their nodes at the given current
  /// positions. References to the scene and the simulation become invalid. Throws InputError or
  /// SolveError if this is impossible: a cell folds, a position has no material, shape functions or
  /// forces cannot be computed. The old epoch then continues.
  void new_epoch(const Nodes& nodes);

  /// Adds a load from the present state on, in this epoch and in later ones. Its force terms come
  /// after all others. References to the simulation become invalid. Throws what building the load,
  /// Simulation and Simulation::begin_with_new_terms() throw; the epoch then continues without the
  /// load.
  void add(std::unique_ptr<const Load<D>> load);

  /// Continues from a state of any epoch of this scene.
  void restore(const Snapshot& state);

 private:
  void begin(Scene<D> built);
  bool due(const PlannedRemap& planned, Real time_before, Remapped& result);
  /// The new node positions of body number b.
  Seeds<D> seeds(const PlannedRemap& planned, std::size_t b) const;

  Plan<D> plan_;
  bool said_rest_ = false;  // that bodies at rest keep their references, since the last remap
  std::unique_ptr<Scene<D>> scene_;
  std::unique_ptr<Simulation<D>> simulation_;
};

}  // namespace meniscus
