// SPDX-License-Identifier: BSD-3-Clause
// Straight segment and point in the plane (CGCM note 3.4).
#pragma once
#include "meniscus/core/simd.hpp"
#include "meniscus/physics/contact_law.hpp"

namespace meniscus {

/// Integrals over a segment of the line y = 0, seen from the point (0, h).
struct SegmentField {
  Real u;        ///< INT u dl
  Vec<2> psi_r;  ///< INT psi (x - x2) dl = grad INT u dl: along the segment, along its normal
};
/// The same from four points, a lane each.
struct LaneSegmentField {
  Lanes u;
  std::array<Lanes, 2> psi_r;
};

/// The segment between the abscissae begin < end. Both kernels in closed form but for one factor
/// of `planar`, which is a Gauss rule exact to rounding. Nothing cancels for any position of the
/// point outside of the segment.
SegmentField segment_field(const ContactLaw& law, Real begin, Real end, Real h);
LaneSegmentField segment_field(const ContactLaw& law, Lanes begin, Lanes end, Lanes h);

}  // namespace meniscus
