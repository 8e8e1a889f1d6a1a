// SPDX-License-Identifier: BSD-3-Clause
// Convergence studies: methods and resolutions, with their errors and costs. A study has a file of
// its own in src/study, uses an anonymous namespace, and ends with
//
//   const bool registered = register_entry(StudyEntry{...});
#pragma once
#include "input/input.hpp"
#include "input/registry.hpp"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

/// One method at one resolution.
struct Measurement {
  using Numbers = std::vector<std::pair<std::string, Real>>;

  std::string method;  ///< a line of the plots, e.g. "quadratic 1.8 d_20, cubic spline"
  int level = 0;       ///< the number given to --levels
  Index particles = 0;
  Real h = 0;             ///< spacing or step, to which orders of convergence refer
  Numbers errors = {};    ///< tend to zero with h
  Numbers values = {};    ///< other results
  double set_up = 0;      ///< wall time before the first evaluation or step, s
  double time = 0;        ///< wall time of the method, s
  std::size_t bytes = 0;  ///< memory of the method

  std::string remark = {};  ///< e.g. the cause of a failure

  /// Throws std::out_of_range if no error has this name.
  Real error(std::string_view name) const;
};

/// A claim of the study: `value` has to lie in `allowed`.
struct Check {
  std::string what;
  Real value;
  Range allowed;
  bool met() const { return allowed.contains(value); }
};

/// A running study: its settings and its results.
class StudyRun {
 public:
  using Listener = std::function<void(const StudyRun&)>;

  /// `listener` is called after each new measurement.
  StudyRun(std::vector<int> levels, bool brief, SceneInput settings, Listener listener)
      : levels_(std::move(levels)),
        brief_(brief),
        settings_(std::move(settings)),
        listener_(std::move(listener)) {}

  const std::vector<int>& levels() const { return levels_; }
  /// True for the short form, which takes seconds altogether: studies skip methods, not only
  /// levels.
  bool brief() const { return brief_; }
  /// The keys given by --set. A study has to read them before it measures.
  const Block& settings() const { return settings_.root(); }
  /// Throws InputError if a setting is wrong or was not read. Call it before measuring.
  void finish_settings() const;

  void record(Measurement measurement);
  /// Records the check that `value` is `allowed`. A failed check changes the exit code.
  void require(std::string what, Real value, Range allowed);

  /// Adds a sentence about the results, printed after them.
  void note(std::string sentence) { notes_.push_back(std::move(sentence)); }

  const std::vector<std::string>& notes() const { return notes_; }
  const std::vector<Measurement>& measurements() const { return measurements_; }
  const std::vector<Check>& checks() const { return checks_; }

  /// The measurement of a method at a level; null if there is none.
  const Measurement* find(std::string_view method, int level) const;
  /// The order log(e1/e2) / log(h1/h2) between the measurement and the one before it of the same
  /// method. Empty for the first one and for errors near round-off (< 1e-13).
  std::optional<Real> order(const Measurement& measurement, std::string_view error) const;
  /// The order between the first and the last measurement of a method; NaN for fewer than two.
  Real overall_order(std::string_view method, std::string_view error) const;

 private:
  std::vector<int> levels_;
  bool brief_;
  SceneInput settings_;
  Listener listener_;
  std::vector<Measurement> measurements_;
  std::vector<Check> checks_;
  std::vector<std::string> notes_;
};

struct StudyEntry {
  static constexpr const char* kind = "study";
  std::string_view name;
  std::string_view summary;        ///< one line of `meniscus study --list`
  std::string_view level_meaning;  ///< e.g. "cells per edge of the core of the ball"
  std::vector<int> levels;         ///< of the full study
  std::vector<int> brief_levels;
  void (*run)(StudyRun&);              ///< throws InputError for settings that make no sense
  std::string_view h_meaning = "$h$";  ///< name of Measurement::h in plots
};

inline const Registry<StudyEntry>& studies() {
  return Registry<StudyEntry>::all();
}

/// The wall time since its construction, in s.
class Stopwatch {
 public:
  double seconds() const;

 private:
  static double now();
  double begin_ = now();
};

}  // namespace meniscus
