// SPDX-License-Identifier: BSD-3-Clause
// Pinned contact lines: forces and losses of lines that stick and slip.
#include "cases.hpp"
#include "physics/surface/line_pinning.hpp"
#include "support.hpp"
#include "thrown.hpp"

#include <gtest/gtest.h>

namespace meniscus::test_line_pinning {
namespace {

/// A drop on a plane, with a line that is held by these forces.
template <int D>
struct Pinned {
  Scene<D> scene = test::scene_of<D>(
      "dimension = " + std::to_string(D) +
      "\n[time]\nend = 1\n[[body]]\nname = \"drop\"\nshape = \"cap\"\nradius = 1\n" +
      "contact_angle = 70\ncore = 4\n" + (D == 3 ? "layers = 2\n" : "rings = 2\n") +
      example_liquid() +
      "[[surface_tension]]\nbody = \"drop\"\ngamma = 1\n[[wetted]]\nbody = "
      "\"drop\"\nface = \"flat\"\n"
      "contact_angle = 70\nadvancing_angle = 90\nreceding_angle = 60\n");
  ForceTerm& term = *scene.system.terms.back();
  NodalVectors rest = test::zeros(scene.initial.u);

  /// The whole drop moved along x.
  NodalVectors moved(Real way) const {
    NodalVectors u = rest;
    for (Lanes& x : u) x.set(0, way);
    return u;
  }
  Real force_x(const NodalVectors& u) {
    NodalVectors force = rest;
    report = term.add_force({0, u, rest}, force);
    Real sum = 0;
    for (const Lanes& f : force) sum += f[0];
    return sum;
  }
  Report report;
};

constexpr Real advancing = 0.34202014332566882,
               receding = 0.15797985667433128;  // cos 70, cos 60 - cos 70

/// A line that slips to the right pulls back with both forces times its width across the way, and
/// loses their work.
template <int D>
void expect_slip(Real width) {
  Pinned<D> drop;
  ASSERT_TRUE(drop.term.name().starts_with("line pinning"));
  EXPECT_EQ(drop.force_x(drop.rest), 0);
  const Real within = D == 3 ? 2e-3 : 1e-12;
  const Real force = drop.force_x(drop.moved(0.1));
  EXPECT_NEAR(-force / (width * (advancing + receding)), 1, within);
  EXPECT_NEAR(drop.report.lost / (-force * 0.1), 1, 0.02);
  EXPECT_EQ(drop.report.heat, 0);
  // The bonds follow a slip. Back by the elastic ways of both sides the line sticks in between,
  // then it slips with the forces exchanged.
  const NodalVectors there = drop.moved(0.1), back = drop.moved(0);
  drop.term.commit({0, there, drop.rest});
  EXPECT_NEAR(drop.force_x(there), force, 1e-10 * std::abs(force));
  EXPECT_NEAR(drop.report.lost, 0, 1e-12);
  EXPECT_NEAR(drop.force_x(back) / -force, 1, within);
}
TEST(LinePinning, ALineThatSlipsPullsWithBothForces) {
  const Real theta = 70 * std::numbers::pi / 180;
  expect_slip<2>(1);
  // The radius of the base of a cap of the volume of the unit ball.
  const Real c = std::cos(theta), R = std::cbrt(4 / ((2 + c) * (1 - c) * (1 - c)));
  expect_slip<3>(2 * R * std::sin(theta));
}

TEST(LinePinning, ProblemsOfScenesAreNamed) {
  const auto expect = [](const std::string& angles, const std::string& words) {
    EXPECT_THROW_WITH(
        test::scene_of<2>(
            "dimension = 2\n[time]\nend = 1\n[[body]]\nname = \"drop\"\nshape = \"cap\"\nradius = "
            "1\n"
            "contact_angle = 70\ncore = 4\nrings = 2\n" +
            example_liquid() +
            "[[surface_tension]]\nbody = \"drop\"\ngamma = 1\n[[wetted]]\nbody = \"drop\"\n"
            "face = \"flat\"\n" +
            angles),
        InputError, words);
  };
  expect("advancing_angle = 90\n", "receding_angle: is missing");
  expect("advancing_angle = 60\nreceding_angle = 90\n", "0 < receding_angle <= advancing_angle");
  expect("advancing_angle = 90\nreceding_angle = 60\ncontact_angle = 100\n",
         "allowed are angles from");
  expect("advancing_angle = 90\nreceding_angle = 60\ntension = 0.2\n",
         "not between receding_angle and");
}

}  // namespace
}  // namespace meniscus::test_line_pinning
