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
#include <memory>
#include <string>
#include <vector>

namespace meniscus {

/// A field of one body: a number, vector or tensor per particle.
struct Field {
  int components;              ///< 1 for scalars, D for vectors, 9 for tensors (row-major)
  std::string unit;            ///< e.g. "pN/nm^2"
  std::vector<double> values;  ///< [particle][component]
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

  /// Makes one step. Throws SolveError; no further step can be made after that.
  void advance();
  /// Makes steps until `time` or the end of the scene is reached or passed.
  void advance_to(double time);

  /// Names of the bodies, and names of all measures, e.g. "drop.aspect".
  std::vector<std::string> bodies() const;
  std::vector<std::string> measures() const;
  /// Names of the fields of a body: "position", "displacement", "velocity", "mass", and the fields
  /// of its force terms, e.g. "pressure".
  std::vector<std::string> fields(const std::string& body) const;

  double measure(const std::string& name) const;
  Field field(const std::string& body, const std::string& name) const;

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
