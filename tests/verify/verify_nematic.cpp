// SPDX-License-Identifier: BSD-3-Clause
// Nematic drops against exact solutions, at the resolution of a scene; the short form tests some
// cases.
#include "unit/nematic_scenes.hpp"
#include "verify_form.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace meniscus::verify_nematic {
namespace {

const nlohmann::json& rows(const char* of) {
  return test::cells_reference().at("nematic").at(of).at("rows");
}

TEST(Nematic, RadialDirectors) {
  const bool full = test::full_verification();
  for (const auto& row : rows("hedgehog")) {
    const Real eps = row.at("eps");
    const bool ball = row.at("d") == 3;
    if (eps < (ball ? 0.15 : 0.07) || (!full && ball)) continue;  // the others are not resolved
    const test::Radial coarse = ball ? test::radial<3>(row, 4, 2) : test::radial<2>(row, 8, 4),
                       fine = ball ? test::radial<3>(row, 6, 3) : test::radial<2>(row, 16, 8);
    fmt::print("{}D, eps {}, W/K {}: energy {:+.2e}, {:+.2e}, profile {:.2e}, {:.2e}\n",
               row.at("d").dump(), eps, row.at("W_over_K").dump(), coarse.energy, fine.energy,
               coarse.profile, fine.profile);
    EXPECT_NEAR(fine.energy, 0, 5e-3);
    EXPECT_LT(std::abs(fine.energy), std::abs(coarse.energy));
  }
}

TEST(Nematic, RadialDirectorsInTheHalfPlane) {
  for (const auto& row : rows("hedgehog")) {
    if (row.at("d") != 3 || row.at("eps") < 0.05) continue;
    const test::Radial coarse = test::radial<2>(row, 12, 6, true),
                       fine = test::radial<2>(row, 24, 12, true);
    fmt::print("half plane, eps {}, W/K {}: energy {:+.2e}, {:+.2e}, profile {:.2e}, {:.2e}\n",
               row.at("eps").dump(), row.at("W_over_K").dump(), coarse.energy, fine.energy,
               coarse.profile, fine.profile);
    EXPECT_NEAR(fine.energy, 0, 2e-3);
    EXPECT_LT(std::abs(fine.energy), std::abs(coarse.energy));
  }
}

TEST(Nematic, TorsionOfAFreeDrop) {
  for (const auto& row : rows("torsion")) {
    const bool ball = row.at("d") == 3;
    if (ball && !test::full_verification()) continue;
    const test::Torsion coarse = ball ? test::torsion<3>(row, 4, 2) : test::torsion<2>(row, 8, 4),
                        fine = ball ? test::torsion<3>(row, 6, 3) : test::torsion<2>(row, 10, 5);
    for (const auto* run : {&coarse, &fine})
      fmt::print(
          "torsion {}D, lambda {}: velocity {:.2e}, twist {:.2e}, of its greatest {:.2e}, angular "
          "momentum {:.1e}, balance {:.1e}\n",
          row.at("d").dump(), row.at("lam").dump(), run->velocity, run->twist,
          run->twist_of_greatest, run->angular_momentum, run->balance);
    EXPECT_LT(fine.velocity, coarse.velocity);
    EXPECT_LT(fine.velocity, 0.03);
    EXPECT_LT(fine.twist_of_greatest, 0.03);
    if (!ball) {
      EXPECT_LT(fine.twist, 0.03);
    }
    EXPECT_LT(fine.angular_momentum, 1e-14);
    EXPECT_LT(std::abs(fine.balance), 1e-4);
  }
}

TEST(Nematic, DropsAroundAUniformDirectorAreWulffShapes) {
  for (const auto& row : rows("uniform")) {
    const bool ball = row.at("d") == 3;
    if (ball && !test::full_verification()) continue;
    const Real W = row.at("W"), exact = 1 / (1 + W / 2),
               found = ball ? test::aspect_of_uniform_director<3>(W, "apolar", 6, 3)
                            : test::aspect_of_uniform_director<2>(W, "apolar", 8, 4);
    fmt::print("uniform director, {}D, W {}: aspect {:.6f}, exact {:.6f}\n", row.at("d").dump(), W,
               found, exact);
    EXPECT_NEAR(found, exact, 5e-4);
  }
  const Real polar = test::aspect_of_uniform_director<2>(0.4, "polar", 8, 4);
  fmt::print("polar: aspect {:.6f}\n", polar);
  EXPECT_NEAR(polar, 1, 5e-4);
}

TEST(Nematic, TheRadialDirectorAddsAPressure) {
  const Real coarse = test::excess_pressure<2>(8, 4), fine = test::excess_pressure<2>(16, 8);
  fmt::print("pressure of the director / exact: 2D {:.4f}, {:.4f}\n", coarse, fine);
  for (const Real found : {coarse, fine}) EXPECT_NEAR(found, 1, 0.01);
  if (!test::full_verification()) return;
  const Real ball = test::excess_pressure<3>(6, 3);
  fmt::print("3D, 997 particles: {:.4f}\n", ball);
  EXPECT_NEAR(ball, 1, 0.02);
}

}  // namespace
}  // namespace meniscus::verify_nematic
