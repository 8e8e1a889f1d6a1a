// SPDX-License-Identifier: BSD-3-Clause
// Settings of a scene: structs whose rows are the reference of the input keys.
#pragma once
#include "input/input.hpp"

#include <optional>

namespace meniscus {

/// [initial]
struct InitialSettings {
  std::string from;        ///< a run of the same bodies, whose last state is the first; empty: none
  std::string from_place;  ///< place of `from` in the scene, for messages
  static Rows<InitialSettings> rows();
};

/// [resolution]
struct ResolutionSettings {
  Real refine = 1;
  static Rows<ResolutionSettings> rows();
};

/// [time]
struct TimeSettings {
  Real end = 0;
  std::optional<Real>
      step;                ///< given: checked against the stable step; empty: chosen automatically
  std::string step_place;  ///< place of `step` in the scene, for messages
  std::string solver_place;     ///< place of `solver`
  std::string viscosity_place;  ///< place of `viscosity`
  Real safety = 0.9;
  int check_every = 0;    ///< largest number of steps between estimates of the stable step
  std::string solver;     ///< "dynamics" or "relax"
  std::string viscosity;  ///< "explicit", "implicit" or "automatic"
  Real force_tolerance = 0, shape_tolerance = 0;  ///< of "relax" (solve/step/relaxation.hpp)
  static Rows<TimeSettings> rows();
};

/// [output]
struct OutputSettings {
  Real frames_every = 0, history_every = 0;  ///< time; 0: 50 frames and 200 records per run
  std::vector<std::string> fields, measures;
  std::string precision;
  int compression = 0;
  bool restartable = false, revolved = false;
  Real checkpoint_minutes = 0;
  static Rows<OutputSettings> rows();

  /// True if a record or a frame is due after a step from `before` to `now`, in a run until `end`.
  bool record_due(Real before, Real now, Real end) const;
  bool frame_due(Real before, Real now, Real end) const;
};

/// Kernel function and supports of a body, where the scene leaves them out.
struct SupportDefaults {
  std::string window;
  Real factor;  ///< with another kernel function than "triweight", whose factor is 1.5
  std::string by;
};

/// The keys and inner tables of [[body]], except the keys of its shape.
struct BodySettings {
  std::string name, integration, volumetric, window, support_by;
  std::string integration_place;  ///< place of `integration` in the scene, for messages
  int gauss_points = 3;
  std::optional<Real> support_factor;  ///< x length of support_by; a plan has one
  int support_rank = 0;                ///< 0: 20 in 3D, 8 in 2D
  Real support_spacings = 0;           ///< > 0: the same support everywhere, x mean cell size
  std::vector<Expression> initial_displacement, initial_velocity;  ///< empty: zero
  static Rows<BodySettings> rows();
  /// Sets window, support_factor and support_by if the scene leaves them out. The defaults depend
  /// on other keys of the scene.
  void settle_support(const Block& block, const SupportDefaults& otherwise);
};

/// The keys that [body.material] of any solid may have in addition to the keys of its law.
struct SolidSettings {
  Real viscosity = 0;  ///< eta of physics/internal/solid_viscosity.hpp
  static Rows<SolidSettings> rows();
};

/// [expect.NAME]
struct ExpectSettings {
  std::string of;              ///< column of the history; the name of the table if empty
  std::string reduce;          ///< how the record becomes one number
  std::optional<Real> at, to;  ///< times; absent: the end of the scene
  Real from = 0;
  std::optional<Real> level;                    ///< for the reduction "falls"
  std::optional<Real> value;                    ///< absent: the number is reported
  std::optional<Real> within, within_relative;  ///< tolerances; without one it is reported, too
  std::optional<Real> order, error_bar_within;  ///< asked of a convergence series
  bool judged() const { return within || within_relative; }
  static Rows<ExpectSettings> rows();
};

}  // namespace meniscus
