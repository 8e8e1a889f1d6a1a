// SPDX-License-Identifier: BSD-3-Clause
// Curvature of a surface under an exact map, computed from the particles only, and its errors.
#pragma once
#include "body/surface/surface_points.hpp"
#include "kernel/particle_set.hpp"
#include "study/study.hpp"
#include "study/support/maps.hpp"

namespace meniscus::study {

/// Positions at which the curvature is evaluated: surface points or boundary nodes.
enum class Places { points, nodes };

/// Computation of the second derivatives of the motion.
enum class SecondDerivatives {
  direct,     ///< x_i,KL = sum_A d_A,i N_A,KL
  recovered,  ///< from F at the particles: x_i,KL = sum_A F_iK(X_A) N_A,L, symmetric part
};

template <int D>
struct CurvatureMethod {
  std::string panel, line;  ///< panel and line in the plots
  int degree = 2;
  typename ParticleSet<D>::AdaptiveSupport support;
  bool by_cells = false;  ///< supports are support.factor diagonals of cells instead
  KernelFunction kernel_function = KernelFunction::cubic_spline;
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

  /// Errors relative to exact results. For 2 kappa: L2 over the present surface ("L2"); the largest
  /// error over the L2 mean of 2 kappa ("max"); mean and root mean square of the error over the
  /// positions without weights, relative to the mean and root mean square of 2 kappa ("mean",
  /// "rms"). For normal, F and G: L2 (G for one stage and the direct method only). `set_up` is the
  /// time for supports and shape functions, `time` the time of one evaluation of 2 kappa at all
  /// positions and stages.
  Measurement measure(const CurvatureMethod<D>& method) const;

 private:
  NamedMap<D> map_;
  Grid<D> grid_;
  SurfacePoints<D> points_, nodes_;
  Real h_;
};

}  // namespace meniscus::study
