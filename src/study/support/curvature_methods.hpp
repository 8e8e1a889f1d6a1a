// SPDX-License-Identifier: BSD-3-Clause
// Curvature of a surface under an exact map, found from the particles alone, and its errors.
#pragma once
#include "meniscus/approx/particle_set.hpp"
#include "meniscus/body/surface_points.hpp"
#include "meniscus/study/study.hpp"

#include "maps.hpp"

namespace meniscus::study {

/// Where the curvature is evaluated.
enum class Places { points, nodes };

/// How second derivatives of the motion are found.
enum class SecondDerivatives {
  direct,     ///< x_i,KL = sum_A d_A,i N_A,KL
  recovered,  ///< of F at the particles: x_i,KL = sum_A F_iK(X_A) N_A,L, symmetric part
};

template <int D>
struct CurvatureMethod {
  std::string panel, line;  ///< of the plots
  int degree = 2;
  typename ParticleSet<D>::AdaptiveSupport support;
  bool by_cells = false;  ///< supports of support.factor diagonals of cells in their place
  Window window = Window::cubic_spline;
  Places places = Places::points;
  SecondDerivatives second = SecondDerivatives::direct;
  int stages = 1;         ///< times that the current state becomes the reference (RKPM note 6)
  bool smoothed = false;  ///< 2 kappa replaced by its local quadratic fit along the surface
};

/// Places on the reference surface with exact results there, for one map and one resolution.
/// Particle coefficients are d_A = x(X_A).
template <int D>
class CurvatureProblem {
 public:
  /// `unit`: the reference body with a smooth surface. 2 Gauss points per facet direction.
  CurvatureProblem(const Geometry<D>& unit, NamedMap<D> map);

  /// Errors relative to the exact results: 2 kappa in L2 over the current surface ("L2"),
  /// largest error over the L2 mean of 2 kappa ("max"), and mean and root mean square over the
  /// places without weights, over those of 2 kappa ("mean", "rms"); normal, F and G in L2 (G for
  /// one stage and the direct method only). set_up: supports and shape functions; time: one
  /// evaluation of 2 kappa at all places (all stages together).
  Measurement measure(const CurvatureMethod<D>& method) const;

 private:
  NamedMap<D> map_;
  Grid<D> grid_;
  SurfacePoints<D> points_, nodes_;
  Real h_;
};

}  // namespace meniscus::study
