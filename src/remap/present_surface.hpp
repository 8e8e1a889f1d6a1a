// SPDX-License-Identifier: BSD-3-Clause
// The current surface of a body, as the patches on which its surface tension acts.
#pragma once
#include "body/surface/surface_patches.hpp"
#include "numbers/dense.hpp"

#include <vector>

namespace meniscus {

/// Patches through the current positions of material points, with a search for the nearest point.
template <int D>
class PresentSurface {
 public:
  /// `u` has the displacement coefficients of the body. Throws SolveError if shape functions cannot
  /// be built.
  PresentSurface(const Body<D>& body, const NodalVector* u);

  struct Foot {
    Index patch = 0;
    Vec<D - 1> xi = Vec<D - 1>::Zero();  ///< in [-1, 1]^(D-1)
    Vec<D> x = Vec<D>::Zero();
    Real distance = 0;  ///< from the given point to x
  };
  /// The point of the surface that is nearest to p, by a local search. The search begins in `patch`
  /// and continues with patches that share a point, as long as the distance decreases. Throws
  /// SolveError if p is not finite.
  Foot nearest(const Vec<D>& p, Index patch) const;

  /// Positions of the points of the patches, numbered as in PatchNodes.
  const std::vector<Vec<D>>& points() const { return x_; }
  const std::vector<std::array<Index, PatchFunctions<D>::nodes>>& patches() const { return patch_; }
  /// Fraction of the surface area at which inside(x) is true, by 3 Gauss points per direction.
  template <class Inside>
  Real fraction(Inside&& inside) const {
    Real part = 0, whole = 0;
    for (const auto& patch : patch_)
      for (const PatchFunctions<D>& f : gauss_) {
        const CellPoint<D, D - 1> place = patch_place<D>(f, patch, x_);
        const Real area = f.weight * area_of(place.J);
        whole += area;
        if (inside(place.X)) part += area;
      }
    return part / whole;
  }

 private:
  static Real area_of(const Eigen::Matrix<Real, D, D - 1>& J) {
    if constexpr (D == 3)
      return cross(J.col(0), J.col(1)).norm();
    else
      return J.norm();
  }
  Foot nearest_in(const Vec<D>& p, Index patch) const;

  std::vector<PatchFunctions<D>> gauss_;
  std::vector<std::array<Index, PatchFunctions<D>::nodes>> patch_;
  std::vector<Vec<D>> x_;
  std::vector<std::vector<Index>> beside_;  // [patch] patches that share a point, ascending
};

/// Volume (2D: area) that the patches through `points` enclose, as a surface of the body of a grid.
template <int D>
Real enclosed_volume(const Grid<D>& grid,
                     const std::vector<std::array<Index, PatchFunctions<D>::nodes>>& patches,
                     const std::vector<Vec<D>>& points);

}  // namespace meniscus
