// SPDX-License-Identifier: BSD-3-Clause
// Runs a scene from another program, as `meniscus run` does, but without its command line and its
// output. The number of dimensions is not part of any type.
//
//   meniscus::Run run = meniscus::Run::from_file("drop.toml", {"time.end=1e-9"});
//   while (!run.finished()) run.advance();
//   std::cout << run.measure("drop.aspect") << '\n';
//
// All numbers are in the units of the scene. The steps have the same bits as the steps of `meniscus
// run`.
#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace meniscus {

class Snapshot;

/// A field of one body: a number, vector or tensor per particle.
struct Field {
  int components;              ///< 1 for scalars, D for vectors, 9 for tensors (row-major)
  std::string unit;            ///< e.g. "pN/nm^2"
  std::vector<double> values;  ///< [particle][component]
};

/// Computes the force on each particle of a body at a time. `x` and `v` are the positions and
/// velocities at the particles, and `force`, which is zero before the call, is the result; all are
/// [particle][component] in the units of the scene. The function is also called for trial positions
/// that the run never takes, so it must depend on its arguments only. A SolveError that it throws
/// fails the step; the message gets the step and the time.
using ForceFunction = std::function<void(double time, std::span<const double> x,
                                         std::span<const double> v, std::span<double> force)>;

/// The whole state of a run, kept in memory.
class SavedState {
 public:
  explicit SavedState(std::shared_ptr<const Snapshot> snapshot) : snapshot_(std::move(snapshot)) {}
  /// Equal states have equal hashes.
  std::uint64_t hash() const;
  const Snapshot& snapshot() const { return *snapshot_; }

 private:
  std::shared_ptr<const Snapshot> snapshot_;
};

/// A run in progress. Its functions throw the exceptions of meniscus/error.hpp: InputError if
/// the scene is wrong, SolveError if the calculation cannot go on, FileError. An unknown name of a
/// body, measure or field is an InputError that lists the known names.
class Run {
 public:
  /// Reads the scene, builds its bodies and computes the forces of its initial state. `overrides`
  /// have the form of `meniscus run --set`: "key.path=value".
  static Run from_file(const std::string& path, const std::vector<std::string>& overrides = {});
  /// Like from_file(), for a scene given as TOML text.
  static Run from_text(const std::string& toml, const std::vector<std::string>& overrides = {});

  Run(Run&&) noexcept;
  Run& operator=(Run&&) noexcept;
  ~Run();

  /// Number of dimensions: 2 or 3.
  int dimension() const;
  double time() const;
  std::int64_t step() const;
  /// True if the end time of the scene is reached, or if a relaxation has reached its state of
  /// rest.
  bool finished() const;

  /// Makes one step. After an exception other than Interrupted, further steps throw SolveError
  /// until a state is restored.
  void advance();
  /// Makes steps until `time`, up to round-off, or the end of the scene is reached or passed.
  void advance_to(double time);
  /// From now on asked() is called before each step, and now and then within a step of `newton`. If
  /// it returns true, advance() and advance_to() throw Interrupted, and the state is the one after
  /// the last complete step.
  void stop_when(std::function<bool()> asked);

  /// Adds forces on the particles of a body from the present state on. A force acts at the position
  /// of its particle, and its work is external work. The stable step is estimated again. Throws
  /// InputError if the solver needs a potential (`newton`), and what `force` throws; the run then
  /// goes on without the force. Saved states do not contain the function.
  void add_force(const std::string& body, ForceFunction force);

  /// Names of the bodies, and names of all measures, e.g. "drop.aspect".
  std::vector<std::string> bodies() const;
  std::vector<std::string> measures() const;
  /// Names of the fields of a body: "position", "displacement", "velocity", "mass", and the fields
  /// of its force terms, e.g. "pressure".
  std::vector<std::string> fields(const std::string& body) const;

  double measure(const std::string& name) const;
  /// Unit of a measure, e.g. "nm^2".
  std::string unit(const std::string& measure) const;
  Field field(const std::string& body, const std::string& name) const;
  /// The energies by name: "kinetic", the stored ones such as "strain" and "surface", and
  /// "dissipated", "external_work" and "remapped" since the start; in 2D per depth. kinetic +
  /// stored + dissipated - external_work - remapped is constant up to errors of the time steps.
  std::map<std::string, double> energies() const;

  /// Returns the present state. A run of the same scene continues from it bit for bit.
  SavedState snapshot();
  /// Continues from a state. Throws FileError if it belongs to another scene.
  void restore(const SavedState& state);
  /// Writes a checkpoint into the directory, which is made if it does not exist. `meniscus run
  /// SCENE --restart DIRECTORY` and restore() continue from it bit for bit.
  void save(const std::string& directory);
  /// Reads the state from the newest checkpoint in the directory. A run of this scene must have
  /// written it.
  void restore(const std::string& directory);

  struct Base;  ///< base class of the run in 2D and of the run in 3D

 private:
  explicit Run(std::unique_ptr<Base> base);
  std::unique_ptr<Base> base_;
};

}  // namespace meniscus
