// SPDX-License-Identifier: BSD-3-Clause
// The mean meridian of a body whose reference is a body of revolution about its last axis (z; y in
// the half plane), in axes of the body.
#pragma once
#include "body/body.hpp"
#include "meniscus/physics/force_term.hpp"

#include <span>
#include <vector>

namespace meniscus {

/// The mean of all meridians from the upper pole over the rim to the lower pole. It is given in
/// axes that move with the body: the axes of the reference, moved by the rigid motion that fits the
/// outer surface best.
struct MeanMeridian {
  std::vector<Real> r, z;
  std::vector<Real> rim_radius;  ///< largest r of each meridian

  /// Largest r of the mean meridian.
  Real radius() const { return radius_at_rim; }
  /// z of the upper and of the lower half at r = x radius(), x in [0, 1].
  Real upper(Real x) const;
  Real lower(Real x) const;
  Real thickness(Real x) const { return upper(x) - lower(x); }
  /// Distance of the point (r, z) from the polygon of the meridian.
  Real distance(Real r, Real z) const;

  std::size_t rim = 0;  ///< number of the point with the largest r
  Real radius_at_rim = 0;
};

/// Points on the meridians of the outer surface, which must be a mapped sphere. In the half plane
/// there is one meridian, which moves along the axis.
template <int D>
class Meridians {
 public:
  explicit Meridians(const Body<D>& body);
  MeanMeridian mean(const Motion& motion) const;

 private:
  const Body<D>& body_;
  std::vector<Vec<D>> X_;  // [meridian][point]
  std::vector<Real> weight_;
  Vec<D> centre_;
  PointRows<D> rows_;
};

/// Full thickness of a red blood cell of diameter 7.82 um at r = x 3.91 um (Evans and Fung 1972),
/// in um: sqrt(1 - x^2) (0.81 + 7.83 x^2 - 4.39 x^4).
Real evans_fung_thickness(Real x);

/// Number of places x = 0, 1/400, ..., 1 at which thicknesses are compared.
inline constexpr int compared_places = 401;

}  // namespace meniscus
