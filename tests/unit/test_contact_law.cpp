// SPDX-License-Identifier: BSD-3-Clause
// Pair functions against reference values and identities, and the form used in loops against the
// full one.
#include "contact_reference.hpp"
#include "meniscus/error.hpp"
#include "numbers/simd.hpp"
#include "physics/contact/pair/ring_law.hpp"

namespace meniscus::test_contact_law {
namespace {

using test::contact_laws;
using test::contact_references;
using test::expect_relative;

using Member = Real PairFunctions<Real>::*;

TEST(ContactLaw, HasTheReferenceValues) {
  const std::vector<std::tuple<std::string, PairKernel, Member>> functions{
      {"phi_3d", PairKernel::space, &PairFunctions<Real>::phi},
      {"dphi_dr_3d", PairKernel::space, &PairFunctions<Real>::dphi},
      {"psi_3d", PairKernel::space, &PairFunctions<Real>::psi},
      {"dpsi_dr_3d", PairKernel::space, &PairFunctions<Real>::dpsi},
      {"u_3d", PairKernel::space, &PairFunctions<Real>::u},
      {"phi_2d_planestrain", PairKernel::integrated, &PairFunctions<Real>::phi},
      {"psi_2d_planestrain", PairKernel::integrated, &PairFunctions<Real>::psi},
      {"u_2d_planestrain", PairKernel::integrated, &PairFunctions<Real>::u},
      {"psi_2d_planar_variant", PairKernel::planar, &PairFunctions<Real>::psi}};
  for (const auto& [name, kernel, member] : functions)
    for (const auto& reference : contact_references(name)) {
      const auto f = pair_functions<Real>(law_of(reference, kernel), reference.inputs["r"]);
      expect_relative(f.*member, reference.value[0], reference.rel_tol, name);
    }
}

TEST(ContactLaw, AttractsMostWhereTheNoteSays) {
  const ContactLaw law;
  const Real r = contact_references("r_of_max_pair_attraction_over_s0")[0].value[0];
  const auto most = contact_references("max_pair_attraction_over_eps_by_s0")[0];
  expect_relative(pair_functions(law, r).dphi, most.value[0], most.rel_tol, "max attraction");
  for (const Real other : {0.999 * r, 1.001 * r})
    EXPECT_LT(pair_functions(law, other).dphi, pair_functions(law, r).dphi);
}

TEST(ContactLaw, IsLennardJonesWithoutCutoff) {
  constexpr Real pi = std::numbers::pi;
  for (const Real r : {0.3, 0.55, 0.9, 1.3, 4.0}) {
    const Real e = 1.7, s = 0.8, x = std::pow(s / r, 6);
    const auto space = pair_functions(ContactLaw{PairKernel::space, e, s}, r);
    expect_relative(space.phi, e * (x * x - 2 * x), 3e-14, "phi");
    expect_relative(space.dphi, 12 * e / r * (x - x * x), 3e-14, "phi'");
    expect_relative(space.chi, e * r * r * (x / 2 - x * x / 10), 3e-14, "chi");
    const auto line = pair_functions(ContactLaw{PairKernel::integrated, e, s}, r);
    expect_relative(line.phi, e * r * pi * (63 * x * x / 256 - 3 * x / 4), 3e-14, "phi2");
    expect_relative(line.dphi, e * pi * (-693 * x * x / 256 + 15 * x / 4), 3e-14, "phi2'");
    expect_relative(line.dpsi, e * pi * (-77 * x * x / 256 + 5 * x / 4), 3e-14, "psi2'");
    const auto planar = pair_functions(ContactLaw{PairKernel::planar, e, s}, r);
    expect_relative(planar.phi, e * (x * x - 2 * x), 3e-14, "phi planar");
    expect_relative(planar.u, e * r * r * (x / 8 - x * x / 100), 3e-14, "u planar");
  }
}

/// Derivatives by complex step are exact to rounding.
TEST(ContactLaw, DerivativesAndIdentitiesHoldWithAndWithoutCutoff) {
  constexpr Real h = 1e-30;
  for (const ContactLaw& law : contact_laws()) {
    const Real D = dimension_of(law.kernel);
    for (const Real z : {0.4, 0.64, 1.1, 1.8, 2.2, 2.45, 3.1, 3.7, 3.99}) {
      const Real r = z * law.sigma0;
      const auto f = pair_functions(law, r);
      const auto step = pair_functions(law, Complex(r, h));
      const auto slope = [&](Complex PairFunctions<Complex>::*member) {
        return std::imag(step.*member) / h;
      };
      const Real scale = law.epsilon * std::pow(z, -5);
      const auto near = [&](Real value, Real expected, const char* what) {
        EXPECT_NEAR(value, expected, 1e-13 * (std::abs(expected) + scale))
            << what << ", " << name_of(law.kernel) << ", cut-off " << law.cutoff << ", z " << z;
      };
      near(slope(&PairFunctions<Complex>::u), f.du, "u'");
      near(slope(&PairFunctions<Complex>::du), f.ddu, "u''");
      near(slope(&PairFunctions<Complex>::psi), f.dpsi, "psi'");
      near(slope(&PairFunctions<Complex>::phi), f.dphi, "phi'");
      near(slope(&PairFunctions<Complex>::chi), f.phi * r, "chi' = r phi");
      near(f.du, r * f.psi, "u' = r psi");
      near(r * slope(&PairFunctions<Complex>::psi) + D * f.psi, -f.phi, "div r psi = -phi");
    }
  }
}

TEST(ContactLaw, SwitchesOffWithTwoContinuousDerivatives) {
  for (const ContactLaw& law : contact_laws()) {
    if (!law.cut()) continue;
    for (const Real r : {switch_begin * law.reach(), law.reach()}) {
      const auto before = pair_functions(law, r * (1 - 1e-9));
      const auto after = pair_functions(law, r * (1 + 1e-9));
      EXPECT_NEAR(before.u, after.u, 1e-8 * law.epsilon);
      EXPECT_NEAR(before.psi, after.psi, 1e-8 * law.epsilon);
      EXPECT_NEAR(before.phi, after.phi, 1e-6 * law.epsilon);
    }
    const auto gone = pair_functions(law, law.reach());
    EXPECT_EQ(gone.u, 0);
    EXPECT_EQ(gone.phi, 0);
    ContactLaw uncut = law;
    uncut.cutoff = std::numeric_limits<Real>::infinity();
    const Real r = 0.999 * switch_begin * law.reach();
    EXPECT_EQ(pair_functions(law, r).psi, pair_functions(uncut, r).psi);
  }
}

TEST(ContactLaw, LoopFormIsTheFullOneInEveryLane) {
  for (const ContactLaw& law : contact_laws())
    with_kernel(law.kernel, [&](auto kernel) {
      const PairLaw<kernel()> pairs(law);
      for (Real z = 0.3; z < 5; z += 0.037) {
        const Real r = z * law.sigma0;
        const auto f = pair_functions(law, r);
        const auto surface = pairs.surface(r * r);
        const auto volume = pairs.volume(r * r);
        const auto near = [&](Real value, Real expected, const char* what) {
          EXPECT_NEAR(value, expected, 2e-13 * (std::abs(expected) + std::pow(z, -4)))
              << what << ", " << name_of(law.kernel) << ", cut-off " << law.cutoff << ", z " << z;
        };
        near(surface.u, f.u, "u");
        near(surface.psi, f.psi, "psi");
        near(volume.phi, f.phi, "phi");
        near(volume.dphi_by_r, f.dphi / r, "phi'/r");
        // The compiler may contract products and sums of lanes differently.
        const Lanes r_squared(0.25, r * r, 1.0, 9.0);
        near(pairs.surface(r_squared).u[1], surface.u, "u of a lane");
        near(pairs.surface(r_squared).psi[1], surface.psi, "psi of a lane");
        near(pairs.volume(r_squared).phi[1], volume.phi, "phi of a lane");
        near(pairs.volume(r_squared).dphi_by_r[1], volume.dphi_by_r, "phi'/r of a lane");
        if (law.cut() && r >= law.reach()) {
          EXPECT_EQ(surface.u, 0);
          EXPECT_EQ(surface.psi, 0);
          EXPECT_EQ(volume.dphi_by_r, 0);
          EXPECT_EQ(pairs.surface(r_squared).psi[1], 0);
        }
      }
    });
}

/// Means of u and u cos(phi) over the angle between two circles, and their derivatives.
RingPair<Real> summed_over_angles(const ContactLaw& law, Real radius, Real other, Real z) {
  constexpr int angles = 100000;
  const ContactLaw uncut{PairKernel::space, law.epsilon, law.sigma0};
  RingPair<Real> mean{};
  for (int k = 0; k < angles; ++k) {
    const Real c = std::cos(2 * std::numbers::pi * k / angles);
    const Real r = std::sqrt(radius * radius + other * other - 2 * radius * other * c + z * z);
    const auto f = pair_functions(uncut, r);
    const Real by_r = f.psi * (radius - other * c), by_z = f.psi * z;
    mean.along.value += f.u / angles;
    mean.along.by_r += by_r / angles;
    mean.along.by_z += by_z / angles;
    mean.across.value += c * f.u / angles;
    mean.across.by_r += c * by_r / angles;
    mean.across.by_z += c * by_z / angles;
  }
  return mean;
}

RingPair<Real> of_circles(const ContactLaw& law, Real radius, Real other, Real z) {
  const Real r[] = {radius - other, z};
  return RingLaw(law)(radius, r, r[0] * r[0] + z * z);
}

TEST(ContactLaw, CirclesHaveTheMeanOverTheAngle) {
  const ContactLaw law{PairKernel::integrated, 1.7, 0.8};
  for (const auto& [radius, other, z] : std::vector<std::array<Real, 3>>{{2, 2.5, 0.4},
                                                                         {2, 2, 0.7},
                                                                         {0.3, 0.1, 0.6},
                                                                         {1e-9, 1.2, 0.5},
                                                                         {0.4, 0, -0.9},
                                                                         {0, 0, 0.8},
                                                                         {30, 31, 0.1}}) {
    const auto exact = summed_over_angles(law, radius, other, z),
               found = of_circles(law, radius, other, z);
    const std::string at = " of circles " + std::to_string(radius) + " and " +
                           std::to_string(other) + " at " + std::to_string(z);
    const auto compare = [&](const auto& a, const auto& b, Real size, const std::string& what) {
      EXPECT_NEAR(a.value, b.value, 1e-11 * std::abs(size)) << what << at;
      EXPECT_NEAR(a.by_r, b.by_r, 1e-10 * std::abs(size / law.sigma0)) << what << at;
      EXPECT_NEAR(a.by_z, b.by_z, 1e-10 * std::abs(size / law.sigma0)) << what << at;
    };
    // Near its zero u is much smaller than its two powers.
    const Real size =
        std::max(std::abs(exact.along.value), std::abs(exact.along.by_z) * law.sigma0);
    compare(found.along, exact.along, size, "along the axis");
    compare(found.across, exact.across, size, "across the axis");
  }
}

TEST(ContactLaw, CirclesFarFromTheAxisAreInPlaneStrain) {
  const ContactLaw law{PairKernel::integrated, 1.7, 0.8, 4};
  for (const Real d : {0.5, 0.9, 2.0, 2.7, 3.1, 3.3}) {
    const auto line = pair_functions(law, d);
    Real error = 0;
    for (const Real R : {1e3, 1e4}) {
      const auto rings = of_circles(law, R, R + 0.6 * d, 0.8 * d);
      const Real circle = 2 * std::numbers::pi * R, scale = std::abs(line.u) + 1e-3;
      const Real before = error;
      error = std::abs(circle * rings.along.value - line.u) / scale +
              std::abs(circle * rings.across.value - line.u) / scale +
              std::abs(circle * rings.along.by_z - line.psi * 0.8 * d) / scale;
      EXPECT_LT(error, 10 / R) << "at distance " << d;
      EXPECT_LT(error, before > 0 ? 0.2 * before : 1) << "at distance " << d;
    }
  }
}

TEST(ContactLaw, KernelsHaveNames) {
  for (const char* name : {"space", "integrated", "planar"})
    EXPECT_EQ(name_of(pair_kernel_named(name)), name);
  try {
    pair_kernel_named("planer");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean 'planar'"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace meniscus::test_contact_law
