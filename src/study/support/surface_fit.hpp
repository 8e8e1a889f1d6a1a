// SPDX-License-Identifier: BSD-3-Clause
// Smoothing along a surface by moving least squares. Errors that change sign from point to point
// cancel, and smooth fields keep their order.
#pragma once
#include "kernel/neighbor_search.hpp"

#include <span>
#include <vector>

namespace meniscus::study {

/// Replaces values at surface points by local fits: a quadratic polynomial of the tangent
/// coordinates, fitted to the points within 1.2 d_24 (2D: 1.2 d_12) with cubic-spline weights.
template <int D>
class SurfaceFit {
 public:
  explicit SurfaceFit(std::span<const Vec<D>> points);
  void apply(std::vector<Real>& values) const;
  std::size_t bytes() const;

 private:
  std::vector<Offset> start_{0};
  std::vector<Index> point_;
  std::vector<Real> weight_;
};

}  // namespace meniscus::study
