// SPDX-License-Identifier: BSD-3-Clause
// A scene run from another program: what `meniscus run` does, without its command line and its
// output, and without the number of dimensions in a type.
//
//   meniscus::Run run = meniscus::Run::from_file("drop.toml", {"time.end=1e-9"});
//   while (!run.finished()) run.advance();
//   std::cout << run.measure("drop.aspect") << '\n';
//
// All numbers are in the units of the scene. Steps are those of the program, bit for bit.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace meniscus {

/// Numbers of the particles of a body.
struct Field {
  int components;              ///< dimension of space for vectors, 9 for tensors (row-major), 1
  std::string unit;            ///< e.g. "pN/nm^2"
  std::vector<double> values;  ///< [particle][component]
};

/// Errors are the exceptions of meniscus/error.hpp: InputError (the scene), SolveError (the
/// calculation cannot go on), FileError. Names that do not exist are InputErrors that list those
/// that do.
class Run {
 public:
  /// Reads the scene, builds its bodies and computes the forces of its initial state. `overrides`
  /// are as those of `meniscus run --set`: "key.path=value".
  static Run from_file(const std::string& path, const std::vector<std::string>& overrides = {});
  /// The same for the text of a scene.
  static Run from_text(const std::string& toml, const std::vector<std::string>& overrides = {});

  Run(Run&&) noexcept;
  Run& operator=(Run&&) noexcept;
  ~Run();

  /// 2 or 3.
  int dimension() const;
  double time() const;
  std::int64_t step() const;
  /// Whether the end of the scene, or the rest that it asks for, is reached.
  bool finished() const;

  /// One step. Throws SolveError; the run cannot go on after that.
  void advance();
  /// Steps until the first one that reaches `time`, or the end of the scene.
  void advance_to(double time);

  /// Names of the bodies, and of all measures, e.g. "drop.aspect".
  std::vector<std::string> bodies() const;
  std::vector<std::string> measures() const;
  /// Names of the fields of a body: "position", "displacement", "velocity", "mass", and those of
  /// its force terms, e.g. "pressure".
  std::vector<std::string> fields(const std::string& body) const;

  double measure(const std::string& name) const;
  Field field(const std::string& body, const std::string& name) const;

  /// Writes a checkpoint into the directory (made if it is not there), from which
  /// `meniscus run SCENE --restart DIRECTORY` and restore() continue bit for bit.
  void save(const std::string& directory);
  /// Takes the state of the newest checkpoint in the directory, written by a run of this scene.
  void restore(const std::string& directory);

  struct Base;  ///< the run in its number of dimensions

 private:
  explicit Run(std::unique_ptr<Base> base);
  std::unique_ptr<Base> base_;
};

}  // namespace meniscus
