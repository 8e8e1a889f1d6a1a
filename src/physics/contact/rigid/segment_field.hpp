// SPDX-License-Identifier: BSD-3-Clause
// Field of a straight segment at a point in 2D (CGCM note 3.4).
#pragma once
#include "numbers/simd.hpp"
#include "physics/contact/contact_law.hpp"

namespace meniscus {

/// Integrals over a segment of the line y = 0 for the point (0, h).
struct SegmentField {
  Real u;        ///< INT u dl
  Vec<2> psi_r;  ///< INT psi (x - x2) dl = grad INT u dl: along the segment, along its normal
};
/// SegmentField at four points, one per lane.
struct LaneSegmentField {
  Lanes u;
  std::array<Lanes, 2> psi_r;
};

/// The integrals over the segment between the abscissae begin < end, in closed form except for one
/// factor of `planar`, a Gauss rule exact to rounding. Nothing cancels for any point outside of the
/// segment.
SegmentField segment_field(const ContactLaw& law, Real begin, Real end, Real h);
LaneSegmentField segment_field(const ContactLaw& law, Lanes begin, Lanes end, Lanes h);

}  // namespace meniscus
