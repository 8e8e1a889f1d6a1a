// SPDX-License-Identifier: BSD-3-Clause
// Partner: the rigid walls around a rectangular room.
#include "meniscus/physics/partner_registry.hpp"

#include <fmt/core.h>

#include <limits>

namespace meniscus {
namespace {

struct Frame final : PartnerShape<2> {
  static constexpr std::string_view example = "low = [-1.3, -1.4]\nhigh = [2, 3]\n";
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
  void check(const Block& block) const {
    for (int i = 0; i < 2; ++i)
      if (!(at(high, i) > at(low, i)))
        block.problem("high", fmt::format("{}: {:.6g} is not above {:.6g} of low; allowed is more",
                                          i == 0 ? "x" : "y", at(high, i), at(low, i)));
  }
  /// Distance and normal of the nearest of the four walls, seen from inside the room.
  Foot foot(const Vec<2>& x) const override {
    Foot nearest{std::numeric_limits<Real>::infinity(), Vec<2>::Zero(), Mat<2>::Zero()};
    for (int i = 0; i < 2; ++i) {
      const Real above_low = x[i] - at(low, i), below_high = at(high, i) - x[i];
      if (above_low < nearest.distance) nearest = {above_low, Vec<2>::Unit(i), Mat<2>::Zero()};
      if (below_high < nearest.distance) nearest = {below_high, -Vec<2>::Unit(i), Mat<2>::Zero()};
    }
    return nearest;
  }
  Drawing drawing(const Box<2>&) const override {
    const Vec<2> a = Vec<2>::Map(low.data()), b = Vec<2>::Map(high.data());
    return {{a, {b.x(), a.y()}, b, {a.x(), b.y()}}, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
  }
  /// Middles of the corners of walls with finite thickness.
  std::vector<Vec<2>> places() const override {
    if (!(thickness > 0)) return {};
    const Vec<2> a = Vec<2>::Map(low.data()) - Vec<2>::Constant(thickness / 2),
                 b = Vec<2>::Map(high.data()) + Vec<2>::Constant(thickness / 2);
    return {a, {b.x(), a.y()}, b, {a.x(), b.y()}};
  }
  std::unique_ptr<RigidPartner<2>> lennard_jones(const ContactLaw& law, Real beta) const override {
    return rigid_frame(law, beta, Vec<2>::Map(low.data()), Vec<2>::Map(high.data()),
                       thickness > 0 ? thickness : std::numeric_limits<Real>::infinity());
  }
};

const bool frame_registered = register_partner<2, Frame>("frame", "the walls around a rectangle");

}  // namespace
}  // namespace meniscus
