// SPDX-License-Identifier: BSD-3-Clause
// Rigid ball, and the rigid solid around a spherical cavity.
#include "meniscus/physics/partner_registry.hpp"

#include <numbers>

namespace meniscus {
namespace {

template <int D, bool hollow>
struct Round final : PartnerShape<D> {
  static constexpr std::string_view example =
      hollow
          ? (D == 3 ? "centre = [0, 0.1, 0]\nradius = 1.4\n" : "centre = [0.1, 0]\nradius = 1.4\n")
          : (D == 3 ? "centre = [0, 0.2, -2]\nradius = 0.7\n"
                    : "centre = [0.2, -2]\nradius = 0.7\n");
  std::vector<Real> centre;
  Real radius = 0;

  static Rows<Round> rows() {
    return {reals_row("centre", &Round::centre, D, dimension::length, range::any, "centre"),
            real_row("radius", &Round::radius, dimension::length, range::positive, "radius")};
  }
  typename PartnerShape<D>::Foot foot(const Vec<D>& x) const override {
    const Vec<D> arm = x - Vec<D>::Map(centre.data());
    const Real r = arm.norm(), sign = hollow ? -1 : 1;
    const Vec<D> k = r > 0 ? Vec<D>(arm / r) : Vec<D>::Unit(0);
    const Mat<D> across = Mat<D>::Identity() - k * k.transpose();
    return {sign * (r - radius), sign * k, r > 0 ? Mat<D>(sign / r * across) : Mat<D>::Zero()};
  }
  bool round() const override { return true; }
  /// Draws the surface by meridians from pole to pole (2D: a polygon).
  typename PartnerShape<D>::Drawing drawing(const Box<D>&) const override {
    constexpr Index around = 64, along = D == 3 ? 32 : 1;
    constexpr Real pi = std::numbers::pi;
    typename PartnerShape<D>::Drawing drawing;
    for (Index j = 0; j < (D == 3 ? along + 1 : 1); ++j)
      for (Index i = 0; i < around; ++i) {
        const Real phi = 2 * pi * i / around, theta = D == 3 ? pi * j / along : pi / 2;
        const Vec<3> n(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                       std::cos(theta));
        drawing.X.push_back(Vec<D>::Map(centre.data()) + radius * n.template head<D>());
      }
    for (Index j = 0; j < along; ++j)
      for (Index i = 0; i < around; ++i) {
        const Index a = j * around + i, b = j * around + (i + 1) % around;
        if constexpr (D == 3)
          drawing.facets.push_back({a, a + around, b + around, b});
        else
          drawing.facets.push_back({a, b});
      }
    return drawing;
  }
  std::vector<Vec<D>> places() const override {
    if (hollow) return {};
    return {Vec<D>::Map(centre.data())};
  }
  std::unique_ptr<RigidPartner<D>> lennard_jones(const ContactLaw& law, Real beta) const override {
    const Vec<D> place = Vec<D>::Map(centre.data());
    return hollow ? rigid_cavity<D>(law, beta, place, radius)
                  : rigid_ball<D>(law, beta, place, radius);
  }
};

constexpr const char *ball_meaning = "ball; in 2D a cylinder across the plane",
                     *cavity_meaning = "all that is around a ball; in 2D around a cylinder";
const bool round_registered = register_partner<2, Round<2, false>>("ball", ball_meaning) &&
                              register_partner<3, Round<3, false>>("ball", ball_meaning) &&
                              register_partner<2, Round<2, true>>("cavity", cavity_meaning) &&
                              register_partner<3, Round<3, true>>("cavity", cavity_meaning);

}  // namespace
}  // namespace meniscus
