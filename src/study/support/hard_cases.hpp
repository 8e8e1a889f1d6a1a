// SPDX-License-Identifier: BSD-3-Clause
// Hard cases: runs scenes and checks their outcome.
#pragma once
#include "study/study.hpp"

#include <limits>
#include <map>
#include <string>

namespace meniscus::study {

/// The outcome of a run.
struct HardOutcome {
  Index particles = 0;
  Real steps = 0;
  Real energy_error = 0;  ///< largest error of the energy balance
  Real final_energy_error = 0;
  Real momentum_error = 0, angular_momentum_error = 0;  ///< largest errors
  Real first_allowed_step = 0, least_allowed_step = unbounded;
  std::map<std::string, Real> least;     ///< smallest values of the watched measures
  std::string stopped;                   ///< error message; empty if the run reached its end
  std::string remarks;                   ///< notes and warnings of the set-up
  std::map<std::string, Real> measures;  ///< including residuals of the stepper

  /// The value of a measure at the end; NaN if the run did not get there.
  Real measure(const std::string& name) const;
};

/// Options of a run.
struct HardRun {
  Real largest_step_number = unbounded;
  std::vector<std::string> watched = {};  ///< measures evaluated after every step
};

/// Runs cases and checks their outcomes. Cases whose name does not contain `chosen` are skipped,
/// with all their checks.
class HardCases {
 public:
  HardCases(StudyRun& study, std::string chosen) : study_(study), chosen_(std::move(chosen)) {}

  bool wants(const std::string& name) const { return name.find(chosen_) != std::string::npos; }

  /// Runs `scene` and requires that it reaches its end, with an energy balance within `bound`.
  HardOutcome stays_stable(const std::string& name, const std::string& scene, Real bound,
                           const HardRun& how = {});
  /// Requires that `scene` stops, or is refused, with a message that contains `cause`.
  void stops(const std::string& name, const std::string& scene, const std::string& cause);
  /// Requires that a value of the case `name` is `allowed`.
  void require(const std::string& name, const std::string& what, Real value, Range allowed);
  void says(const std::string& name, const HardOutcome& outcome, const std::string& text);
  void record(const std::string& name, const HardOutcome& outcome, Real seconds);

  StudyRun& study() { return study_; }

 private:
  StudyRun& study_;
  std::string chosen_;
};

/// Cases of solids of every law.
void hard_solids(HardCases& cases);

/// Cases of equilibria by Newton's method (quasi-statics note).
void hard_equilibria(HardCases& cases);

/// Cases of drops.
void hard_drops(HardCases& cases);

/// Cases of surface laws (cells note).
void hard_surfaces(HardCases& cases);

/// Cases of nematic drops (cells note 5).
void hard_nematics(HardCases& cases);

/// Cases of drops on walls (wetting note).
void hard_wetting(HardCases& cases);

/// Cases of contact (CGCM notes 7 and 10).
void hard_contact(HardCases& cases);

/// Cases of bodies of revolution (axisymmetry note).
void hard_revolved(HardCases& cases);

}  // namespace meniscus::study
