// SPDX-License-Identifier: BSD-3-Clause
// Curvature of a surface under an exact map, computed from the particles alone, and its errors.
#pragma once
#include "body/surface/surface_points.hpp"
#include "kernel/particle_set.hpp"
#include "study/study.hpp"
#include "study/support/maps.hpp"

namespace meniscus::study {

/// Where the curvature is evaluated.
enum class Places { points, nodes };

/// How second derivatives of the motion are computed.
enum class SecondDerivatives {
  direct,     ///< x_i,KL = sum_A d_A,i N_A,KL
  recovered,  ///< from F at the particles: x_i,KL = sum_A F_iK(X_A) N_A,L, symmetric part
};

template <int D>
struct CurvatureMethod {
  std::string panel, line;  ///< of the plots
  int degree = 2;
  typename ParticleSet<D>::AdaptiveSupport support;
  bool by_cells = false;  ///< supports are support.factor diagonals of cells instead
  Window window = Window::cubic_spline;
  Places places = Places::points;
  SecondDerivatives second = SecondDerivatives::direct;
  int stages = 1;         ///< updates of the reference (RKPM note 6)
  bool smoothed = false;  ///< 2 kappa replaced by its local quadratic fit along the surface
};

/// Points on the reference surface and exact results there, for one map and one resolution.
/// Particle coefficients are d_A = x(X_A).
template <int D>
class CurvatureProblem {
 public:
  /// `unit`: the reference body with a smooth surface. 2 Gauss points per facet direction.
  CurvatureProblem(const Geometry<D>& unit, NamedMap<D> map);

  /// Errors relative to exact results. For 2 kappa: L2 over the current surface ("L2"); the largest
  /// error over the L2 mean of 2 kappa ("max"); mean and root mean square over the places without
  /// weights, relative to those of 2 kappa ("mean", "rms"). For normal, F and G: L2 (G for one
  /// stage and the direct method only). set_up is the time for supports and shape functions. `time`
  /// is one evaluation of 2 kappa at all places, all stages together.
  Measurement measure(const CurvatureMethod<D>& method) const;

 private:
  NamedMap<D> map_;
  Grid<D> grid_;
  SurfacePoints<D> points_, nodes_;
  Real h_;
};

}  // namespace meniscus::study
