// SPDX-License-Identifier: BSD-3-Clause
// Rigid walls around a rectangle.
#include "meniscus/physics/partner_registry.hpp"

namespace meniscus {
namespace {

struct Frame {
  std::vector<Real> low, high;
  Real thickness = 0;

  static Rows<Frame> rows() {
    return {reals_row("low", &Frame::low, 2, dimension::length, range::any,
                      "lower left corner of the room inside"),
            reals_row("high", &Frame::high, 2, dimension::length, range::any,
                      "upper right corner of the room inside"),
            real_row("thickness", &Frame::thickness, dimension::length, range::non_negative,
                     "of the walls; 0: infinite", 0.0)};
  }
  std::unique_ptr<RigidPartner<2>> make(const ContactLaw& law, Real beta) const {
    return rigid_frame(law, beta, Vec<2>::Map(low.data()), Vec<2>::Map(high.data()),
                       thickness > 0 ? thickness : std::numeric_limits<Real>::infinity());
  }
};

const bool registered = register_partner<2, Frame>("frame", "the walls around a rectangle");

}  // namespace
}  // namespace meniscus
