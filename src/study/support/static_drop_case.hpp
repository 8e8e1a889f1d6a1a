// SPDX-License-Identifier: BSD-3-Clause
// A drop at rest. It starts as a ball (2D: disk) in its Laplace pressure, or as an ellipsoid
// (ellipse) 1.5 : 1 that relaxes first and whose particles keep that deformation (static-drop note
// 3).
#pragma once
#include "study/study.hpp"

namespace meniscus::study {

/// R = rho = gamma = 1.
struct StaticDrop {
  int D;
  bool stretched;  ///< starts 1.5 : 1
  Real Oh;
  const char* form;
  std::string body_keys = {};  ///< further keys of the drop

  /// "3D ball, Oh = 0.93, balanced"
  std::string name() const;
};

/// The time after which a stretched drop is round: its second mode has fallen by e^-5.5. The rate
/// of the mode is 5 nu/R^2 (2D: 4, Lamb) at small viscosity, and 20/19 (2D: 1) gamma/(mu R) at
/// large viscosity.
Real round_time(const StaticDrop& c);

/// Measures motion and shape of the drop at the time `end`. `level`: cells along an edge of the
/// core of the ball; for a disk, half of the cells along an edge.
Measurement measure_static_drop(const StaticDrop& c, int level, Real end);

}  // namespace meniscus::study
