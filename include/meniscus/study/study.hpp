// SPDX-License-Identifier: BSD-3-Clause
// Convergence studies: resolutions and methods, their errors and what they cost. A study lives in
// its own file in src/study, in an anonymous namespace, and ends with
//   const bool registered = register_entry(StudyEntry{...});
#pragma once
#include "meniscus/core/input.hpp"
#include "meniscus/core/registry.hpp"

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
  Real h = 0;             ///< what observed orders refer to: spacing, or step
  Numbers errors = {};    ///< should tend to zero with h
  Numbers values = {};    ///< other results
  double set_up = 0;      ///< wall time before the first evaluation or step, s
  double time = 0;        ///< wall time of what the method does, s
  std::size_t bytes = 0;  ///< held by the method

  std::string remark = {};  ///< e.g. the cause of a failure

  /// Throws std::out_of_range if there is none of this name.
  Real error(std::string_view name) const;
};

/// A statement of the study about its measurements.
struct Check {
  std::string what;
  Real value;
  Range allowed;
  bool met() const { return allowed.contains(value); }
};

/// A study while it runs: what was asked for, what was found.
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
  /// The short form, seconds altogether: studies drop methods, not only levels.
  bool brief() const { return brief_; }
  /// Keys given by --set; a study reads them before it measures.
  const Block& settings() const { return settings_.root(); }
  /// Throws InputError if a setting was refused, or was not asked for. Call before measuring.
  void finish_settings() const;

  void record(Measurement measurement);
  /// Notes whether `value` is `allowed`; a missed one decides the exit code.
  void require(std::string what, Real value, Range allowed);

  /// A sentence about the results, printed after them.
  void note(std::string sentence) { notes_.push_back(std::move(sentence)); }

  const std::vector<std::string>& notes() const { return notes_; }
  const std::vector<Measurement>& measurements() const { return measurements_; }
  const std::vector<Check>& checks() const { return checks_; }

  /// The measurement of a method at a level, if it was made.
  const Measurement* find(std::string_view method, int level) const;
  /// log(e1/e2) / log(h1/h2) between the measurement and the one before it of the same method;
  /// nothing for the first one and for errors at the level of round-off (< 1e-13).
  std::optional<Real> order(const Measurement& measurement, std::string_view error) const;
  /// The same between the first and the last measurement of a method; NaN if there are not two.
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
  std::vector<int> levels;         ///< in full
  std::vector<int> brief_levels;
  void (*run)(StudyRun&);              ///< throws InputError for settings that make no sense
  std::string_view h_meaning = "$h$";  ///< name of Measurement::h in plots
};

inline const Registry<StudyEntry>& studies() {
  return Registry<StudyEntry>::all();
}

/// Wall time since it was made, s.
class Stopwatch {
 public:
  double seconds() const;

 private:
  static double now();
  double begin_ = now();
};

}  // namespace meniscus
