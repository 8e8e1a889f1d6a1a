// SPDX-License-Identifier: BSD-3-Clause
// A drop left alone, started as a ball (2D: disk) in its Laplace pressure, or as an ellipsoid
// (ellipse) 1.5 : 1 that relaxes first, whose particles keep that deformation (static-drop note 3).
#pragma once
#include "meniscus/study/study.hpp"

namespace meniscus::study {

/// R = rho = gamma = 1.
struct StaticDrop {
  int D;
  bool stretched;  ///< begins 1.5 : 1
  Real Oh;
  const char* form;
  std::string body_keys = {};  ///< further keys of the drop

  /// "3D ball, Oh = 0.93, balanced"
  std::string name() const;
};

/// When a stretched drop has become round: its second mode has fallen by e^-5.5. The rate of the
/// mode is 5 nu/R^2 (2D: 4, Lamb) where viscosity is small, and 20/19 (2D: 1) gamma/(mu R) where it
/// is large.
Real round_time(const StaticDrop& c);

/// What moves it, and its shape, at the time `end`. `level`: cells along an edge of the core of the
/// ball, half of those of the disk.
Measurement measure_static_drop(const StaticDrop& c, int level, Real end);

}  // namespace meniscus::study
