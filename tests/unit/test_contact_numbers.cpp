// SPDX-License-Identifier: BSD-3-Clause
// The contact of two half spaces: its characteristic numbers, in closed form and with a cut-off.
#include "contact_reference.hpp"
#include "meniscus/error.hpp"
#include "physics/contact/contact_numbers.hpp"
#include "physics/contact/points/facet_grades.hpp"

#include <cmath>

namespace meniscus::test_contact_numbers {
namespace {

using test::contact_laws;
using test::contact_references;
using test::expect_relative;

void expect_reference(Real value, const std::string& name) {
  const auto reference = contact_references(name)[0];
  expect_relative(value, reference.value[0], reference.rel_tol, name);
}

TEST(ContactNumbers, AreTheReferencesWithoutCutoff) {
  for (const PairKernel kernel : {PairKernel::space, PairKernel::integrated}) {
    const PlaneContact c = plane_contact({kernel, 1, 1}, 1);
    expect_reference(c.equilibrium_gap, "halfspace_equilibrium_gap_over_s0");
    expect_reference(c.adhesion, "halfspace_W_adh_over_eps_b2_s0^4");
    expect_reference(c.peak_traction, "halfspace_max_attractive_traction_over_eps_b2_s0^3");
    expect_reference(c.stiffness, "halfspace_contact_stiffness_at_eq_over_eps_b2_s0^2");
    expect_relative(c.peak_gap, std::pow(5, -1.0 / 6), 1e-15, "gap of the peak");
    expect_relative(c.softening_gap, std::pow(2, -1.0 / 6), 1e-15, "gap of the softening");
    expect_relative(c.softening, 2.99218, 2e-6, "softening");
    EXPECT_EQ(c.lost_adhesion(), 0);
  }
  const PlaneContact planar = plane_contact({PairKernel::planar, 1, 1}, 1);
  expect_reference(planar.equilibrium_gap, "planar_variant_eq_gap_over_s0");
  expect_relative(planar.adhesion, 0.361317482, 1e-9, "W");
  expect_relative(planar.peak_traction, 0.742921365, 1e-9, "peak");
  expect_relative(planar.peak_gap, 0.830500, 1e-6, "gap of the peak");
}

TEST(ContactNumbers, HaveTheirUnits) {
  const auto water = contact_references("ch6.2_W_adh_J_per_m2")[0];
  const Real product = water.inputs["b1"].get<Real>() * water.inputs["b2"].get<Real>();
  const PlaneContact c = plane_contact(law_of(water, PairKernel::space), product);
  expect_relative(c.adhesion, water.value[0], water.rel_tol, "W of water on copper");
  expect_relative(c.equilibrium_gap, 0.194e-9, 3e-3, "gap");
  expect_relative(c.peak_traction, 1.06e9, 5e-3, "peak");
  expect_relative(c.stiffness, 8.5e19, 5e-3, "stiffness");
  // Two cylinders of Fan 2014, section 5.3.
  const PlaneContact integrated = plane_contact({PairKernel::integrated, 1.5, 0.2}, 1);
  expect_relative(integrated.adhesion, 2.324e-3, 2e-4, "W");
  expect_relative(integrated.peak_traction, 0.01873, 3e-4, "peak");
  const PlaneContact planar = plane_contact({PairKernel::planar, 1.5, 0.2}, 1);
  expect_relative(planar.adhesion, 4.336e-3, 1e-4, "W planar");
  expect_relative(planar.equilibrium_gap, 0.1426, 3e-4, "gap planar");
  expect_relative(planar.peak_traction, 0.04458, 1.2e-4, "peak planar");
}

TEST(ContactNumbers, LoseWhatTheCutoffTakes) {
  for (const auto& reference : contact_references("switched_u_W_over_W0")) {
    const Real cutoff = reference.inputs["rc_over_s0"];
    const ContactLaw law{PairKernel::space, 1.3, 0.7, cutoff};
    const PlaneContact cut = plane_contact(law, 2.1);
    const PlaneContact full = plane_contact({PairKernel::space, 1.3, 0.7}, 2.1);
    expect_relative(1 - cut.lost_adhesion(), reference.value[0], reference.rel_tol, "W/W0");
    // All gaps are before the switch, where U_c = -2 pi a u_c is not changed.
    expect_relative(cut.equilibrium_gap, full.equilibrium_gap, 2e-14, "gap");
    expect_relative(cut.peak_gap, full.peak_gap, 2e-14, "gap of the peak");
    expect_relative(cut.peak_traction, full.peak_traction, 2e-14, "peak");
    expect_relative(cut.stiffness, full.stiffness, 2e-14, "stiffness");
    expect_relative(cut.softening, full.softening, 2e-14, "softening");
    expect_relative(cut.softening_gap, full.softening_gap, 1e-7, "gap of the softening");
    expect_relative(cut.uncut_adhesion, full.adhesion, 1e-15, "W0");
  }
}

TEST(ContactNumbers, HoldForTheLeastCutoff) {
  for (const PairKernel kernel : {PairKernel::space, PairKernel::integrated, PairKernel::planar}) {
    const ContactLaw law{kernel, 1, 1, least_cutoff};
    const PlaneContact c = plane_contact(law, 1);
    EXPECT_LT(c.equilibrium_gap, c.peak_gap);
    EXPECT_LT(c.peak_gap, c.softening_gap);
    EXPECT_NEAR(plane_state(law, 1, c.equilibrium_gap).pressure, 0, 1e-13);
    EXPECT_NEAR(plane_state(law, 1, c.peak_gap).stiffness, 0, 1e-13);
    EXPECT_GT(c.peak_traction, 0);
    EXPECT_GT(c.softening, 0);
    EXPECT_GT(c.lost_adhesion(), 0.1);
    EXPECT_LT(c.lost_adhesion(), 0.5);
  }
}

/// An interaction with parameters of any size has finite numbers or is refused.
TEST(ContactNumbers, AreFiniteOrRefused) {
  int refused = 0;
  for (const Real epsilon : {5e-324, 1e-200, 1.0, 1e200, 1e308})
    for (const Real sigma0 : {5e-324, 1e-110, 1.0, 1e110, 1e308})
      for (const Real beta : {5e-324, 1e-110, 1.0, 1e110, 1e308})
        for (const Real cutoff : {4.0, std::numeric_limits<Real>::infinity()}) {
          const ContactLaw law{PairKernel::space, epsilon, sigma0, cutoff};
          const PlaneContact c = plane_contact(law, beta * beta);
          FacetGrades(4, LennardJones(law, beta * beta), 1);
          FacetGrades::of_pairs(8, LennardJones(law, beta * beta), 1);
          try {
            require_finite(c, "s.toml:3");
            for (const Real x : {c.adhesion, c.equilibrium_gap, c.peak_traction, c.peak_gap})
              EXPECT_TRUE(x > 0 && std::isfinite(x)) << epsilon << " " << sigma0 << " " << beta;
          } catch (const InputError& error) {
            ++refused;
            EXPECT_TRUE(std::string(error.what()).starts_with("s.toml:3: the ")) << error.what();
          }
        }
  EXPECT_GT(refused, 100);
  EXPECT_LT(refused, 250);
  EXPECT_NO_THROW(require_finite(plane_contact({PairKernel::space, 1, 1, 4}, 1), ""));
}

TEST(ContactNumbers, CutHalfSpaceIsTheClosedFormInSpace) {
  const ContactLaw law{PairKernel::space, 1.7, 0.8, 2.5};
  for (const Real gap : {0.3, 0.5, 1.0, 1.6, 1.9}) {
    const auto f = pair_functions(law, gap);
    const PlaneState state = plane_state(law, 1, gap);
    constexpr Real pi = std::numbers::pi;
    EXPECT_NEAR(state.pressure, -2 * pi * gap * f.u, 1e-13 * (1 + std::abs(state.pressure)));
    EXPECT_NEAR(state.stiffness, 2 * pi * (f.u + gap * f.du),
                1e-13 * (1 + std::abs(state.stiffness)));
  }
  EXPECT_EQ(plane_state(law, 1, 2.1).pressure, 0);
}

/// p = -de/dg and K = -dp/dg, by differences of sixth order.
TEST(ContactNumbers, PressureAndStiffnessAreDerivatives) {
  for (const ContactLaw& law : contact_laws())
    for (const Real gap : {0.35, 0.6, 1.2, 1.7, 2.9}) {
      const Real h = 0.004 * gap;
      const auto derivative = [&](Real PlaneState::*member) {
        const auto f = [&](int k) { return plane_state(law, 1, gap + k * h).*member; };
        return (45 * (f(1) - f(-1)) - 9 * (f(2) - f(-2)) + (f(3) - f(-3))) / (60 * h);
      };
      const PlaneState s = plane_state(law, 1, gap);
      EXPECT_NEAR(derivative(&PlaneState::energy), -s.pressure,
                  1e-8 * (0.01 + std::abs(s.pressure)));
      EXPECT_NEAR(derivative(&PlaneState::pressure), -s.stiffness,
                  1e-8 * (0.01 + std::abs(s.stiffness)));
    }
}

TEST(ContactNumbers, GiveTheAngleOfYoungAndDupre) {
  EXPECT_NEAR(contact_angle(1.5, 1).value(), std::numbers::pi / 3, 1e-15);
  EXPECT_NEAR(contact_angle(0, 1).value(), std::numbers::pi, 1e-15);
  EXPECT_FALSE(contact_angle(2, 1).has_value());
  EXPECT_EQ(contact_angle_text(1.5, 1), "60 degrees");
  EXPECT_EQ(contact_angle_text(0.2003, 0.0728), "complete wetting");
}

}  // namespace
}  // namespace meniscus::test_contact_numbers
