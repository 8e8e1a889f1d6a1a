// SPDX-License-Identifier: BSD-3-Clause
// Profiles of drops on a plane by the equation of Young and Laplace.
#pragma once
#include "numbers/types.hpp"

namespace meniscus {

/// A drop of revolution about the normal of the plane on which it sits (2D: a symmetric section).
/// `bond` is density x acceleration towards the plane / surface tension, a number per squared
/// length; it is negative for a drop that hangs.
template <int D>
struct DropProfile {
  Real base_radius;    ///< radius of the wetted disk (2D: half the wetted length)
  Real volume;         ///< 2D: area
  Real height;         ///< of the apex above the plane
  Real contact_angle;  ///< radians
  Real free_area;      ///< of the free surface (2D: length)
  Real centroid;       ///< height of the centroid above the plane
};

/// The profile with this base radius and volume (2D: area); all entries are NaN if none is found.
template <int D>
DropProfile<D> profile_on(Real base_radius, Real volume, Real bond);

/// The profile with this contact angle and volume; all entries are NaN if none is found.
template <int D>
DropProfile<D> profile_with(Real contact_angle, Real volume, Real bond);

}  // namespace meniscus
