// SPDX-License-Identifier: BSD-3-Clause
// Newton's method with expected pressures and factors of the tangent: the assembled tangent, its
// pressures, iterations for any bulk modulus, known equilibria and their stability.
#include "cases.hpp"
#include "one_body.hpp"
#include "solve/newton/tangent_factors.hpp"
#include "solved.hpp"
#include "stiffness_support.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meniscus::test_mixed_newton {
namespace {

/// A body with a law, and a state of it with finite strains.
template <int D>
struct Deformed {
  test::OneBody<D> one;
  NodalVectors still, u;
  ForceTerm& force;
  AssembledForce& mixed;

  Deformed(Geometry<D> geometry, const std::string& law, const std::string& keys)
      : Deformed(test::OneBody<D>(std::move(geometry), law, keys), law, nullptr) {}
  Deformed(Geometry<D> geometry, const std::string& law, const Integration& integration)
      : Deformed(test::OneBody<D>(std::move(geometry), law), law, &integration) {}
  Motion at(const NodalVectors& w) const { return {0, w, still}; }

 private:
  Deformed(test::OneBody<D> body, const std::string& law, const Integration* integration)
      : one(std::move(body)),
        still(one.state.u),
        u(test::random_field<D>(one.system.size(), 0.03, 5)),
        force(chosen(law, integration)),
        mixed(dynamic_cast<AssembledForce&>(force)) {}
  ForceTerm& chosen(const std::string& law, const Integration* integration) {
    auto& term = one.system.terms.front();
    if (integration) term = test::internal_force<D>(one.body(), law, *integration);
    return *term;
  }

 public:
  /// Off-pressures that differ from point to point.
  std::vector<Lanes> off() const {
    std::vector<Lanes> off;
    const auto groups = mixed.pressures(at(u), at(still)).size();
    for (std::size_t g = 0; g < groups; ++g)
      off.push_back(Lanes(0.1, -0.2, 0.3, 0.05) * (1 + 0.1 * static_cast<Real>(g % 7)));
    return off;
  }
  /// Minus the tangent with these pressures, times w.
  NodalVectors tangent(const std::vector<Lanes>& off, const NodalVectors& w) {
    NodalVectors Kw = still;
    force.add_tangent(at(u), at(w), Kw);
    if (!off.empty()) mixed.add_pressure_tangent(at(u), at(w), off, Kw);
    for (NodalVector& f : Kw) f = -f;
    return Kw;
  }
};

/// Without shared pressures, the matrix is the tangent to round-off, with other pressures, too.
template <int D>
void expect_assembled(const Integration& integration) {
  Deformed<D> body(test::potato<D>(), "neo_hookean", integration);
  const NodalVectors w = test::random_field<D>(body.one.system.size(), 1, 9);
  for (const std::vector<Lanes>& off : {std::vector<Lanes>(), body.off()}) {
    StiffnessMatrix K(body.one.system.size(), D);
    body.mixed.announce(K);
    K.close();
    if (K.unknowns() > body.one.system.size() * D) return;  // shared pressures
    NodalVectors assembled = test::assembled_tangent<D>(body.mixed, body.at(body.u), w, off);
    for (NodalVector& f : assembled) f = -f;
    const NodalVectors exact = body.tangent(off, w);
    EXPECT_LT(test::norm(test::sum_of(exact, -1, assembled)), 1e-12 * test::norm(exact))
        << integration.rule << integration.volumetric;
  }
}

TEST(StiffnessMatrix, IsTheTangent) {
  for (const Integration& integration : test::integrations()) {
    expect_assembled<2>(integration);
    expect_assembled<3>(integration);
  }
}

/// Shared pressures are further unknowns, with an exact inverse in place of the polynomial, so that
/// K^-1 times the tangent of the force is nearly one.
template <int D>
void expect_inverse(Real lambda) {
  Deformed<D> body(test::potato<D>(), "neo_hookean",
                   fmt::format("density = 1\nmu = 1\nlambda = {}\n", lambda));
  for (NodalVector& w : body.u) w *= 1 / lambda;
  TangentFactors<D> K(body.one.system);
  const FreeMotions<D> free(body.one.system, body.at(body.u), 1);
  K.assemble(0, body.u, {}, free);
  EXPECT_EQ(K.factor(K.small_shift()), 0);
  NodalVectors w = test::random_field<D>(body.one.system.size(), 1, 9), z = w;
  free.remove_from(w);
  NodalVectors Kw = body.tangent({}, w);
  K.apply(Kw, z);
  free.remove_from(z);
  // In the norm of the tangent; the error of the polynomial is 0.05.
  const NodalVectors off = test::sum_of(z, -1, w);
  EXPECT_LT(test::dot(off, body.tangent({}, off)), 0.1 * 0.1 * test::dot(w, Kw)) << lambda;
}

TEST(TangentFactors, AreThoseOfTheTangentWithSharedPressures) {
  for (const Real lambda : {10.0, 1e3, 1e5}) {
    expect_inverse<2>(lambda);
    expect_inverse<3>(lambda);
  }
}

/// Pressures and their derivatives, and the tangent of constant pressures, against differences.
template <int D>
void expect_pressures(Real lambda) {
  Deformed<D> body(test::potato<D>(), "neo_hookean",
                   fmt::format("density = 1\nmu = 1\nlambda = {}\n", lambda));
  const NodalVectors w = test::random_field<D>(body.one.system.size(), 0.03, 9);
  constexpr Real h = 1e-5;
  const NodalVectors ahead = test::sum_of(body.u, h, w), behind = test::sum_of(body.u, -h, w);
  const auto here = body.mixed.pressures(body.at(body.u), body.at(w)),
             before = body.mixed.pressures(body.at(behind), body.at(w)),
             after = body.mixed.pressures(body.at(ahead), body.at(w));
  Real error = 0, size = 0;
  for (std::size_t g = 0; g < here.size(); ++g)
    for (int q = 0; q <= D; ++q) {
      error = std::max(error, std::abs((after[g].v[q] - before[g].v[q]) / (2 * h) - here[g].d[q]));
      size = std::max(size, std::abs(here[g].d[q]));
    }
  EXPECT_LT(error, 1e-7 * size) << lambda;

  const std::vector<Lanes> off = body.off();
  NodalVectors tangent = body.still, forth = body.still, back = body.still;
  const NodalVectors step = test::sum_of(body.still, h, w),
                     step_back = test::sum_of(body.still, -h, w);
  body.mixed.add_pressure_tangent(body.at(body.u), body.at(w), off, tangent);
  body.mixed.subtract_pressure_force(body.at(body.u), body.at(step), off, forth);
  body.mixed.subtract_pressure_force(body.at(body.u), body.at(step_back), off, back);
  const NodalVectors difference = test::sum_of(back, -1, forth);
  EXPECT_LT(test::norm(test::sum_of(difference, -2 * h, tangent)),
            1e-7 * 2 * h * test::norm(tangent));
}

TEST(AssembledForce, PressuresHaveTheirDerivatives) {
  for (const Real lambda : {1.0, 1e3}) {
    expect_pressures<2>(lambda);
    expect_pressures<3>(lambda);
  }
}

/// Cook's membrane in four load steps.
std::string cook(int cells, Real ratio) {
  return fmt::format(
      "dimension = 2\n[time]\nsolver = \"newton\"\nend = 4\nstep = 1\n[[body]]\nname = \"panel\"\n"
      "shape = \"rectangle\"\ncorner = [0, 0]\nsize = [48, 1]\ncells = [{0}, {0}]\n"
      "map = [\"x\", \"44/48*x + y*(44 - 28/48*x)\"]\nmaterial = {{ type = \"neo_hookean\", "
      "density "
      "= 1, mu = 80.194, lambda = {1} }}\n[[held]]\nbody = \"panel\"\nface = \"x_min\"\n"
      "[[traction]]\nbody = \"panel\"\nface = \"x_max\"\nforce = [0, \"6.25*min(1, t/4)\"]\n"
      "[[probe]]\nname = \"tip\"\nbody = \"panel\"\nat = [48, 60]\n",
      cells, 80.194 * ratio);
}

/// Iterations do not grow with the bulk modulus, and solutions converge to an incompressible body.
TEST(MixedNewton, TakesFewIterationsForAnyBulkModulus) {
  std::vector<Real> tips;
  for (const Real ratio : {1.5, 50.0, 5e3, 5e4}) {
    const test::Solved<2> run(cook(8, ratio));
    EXPECT_LE(run.newton().iterations(), 4 * 6) << ratio;
    EXPECT_LE(run.newton().left(), 1e-9) << ratio;
    EXPECT_GT(run.newton().stability(), 0.5) << ratio;
    tips.push_back(run.measure("tip.displacement_y"));
  }
  EXPECT_NEAR(tips[2] / tips[3], 1, 1e-3);
}

/// A cylinder twisted by 0.8 radians per unit length between rigid plates (Rivlin 1948): torque pi
/// R^4 tau (c1 + c2) and axial force - pi R^4 tau^2 (c1 + 2 c2)/2 of an incompressible
/// Mooney-Rivlin rod, between its ends.
TEST(MixedNewton, TwistsARod) {
  constexpr Real R = 0.5, tau = 0.8, c1 = 0.3, c2 = 0.1;
  const test::Solved<3> run(
      "dimension = 3\n[time]\nsolver = \"newton\"\nend = 1\nstep = 0.5\n[[body]]\nname = \"bar\"\n"
      "shape = \"cylinder\"\nradius = 0.5\nheight = 1\ncore = 4\nrings = 1\nlayers = 4\nmaterial = "
      "{ type = \"mooney_rivlin\", density = 1, c1 = 0.3, c2 = 0.1, lambda = 500 }\n"
      "[[held]]\nbody = \"bar\"\nface = \"z_min\"\n[[held]]\nname = \"grip\"\nbody = \"bar\"\n"
      "face = \"z_max\"\nangle = \"0.8*t\"\n");
  EXPECT_LE(run.newton().iterations(), 2 * 8);
  const Real torque = std::numbers::pi * std::pow(R, 4) * tau * (c1 + c2),
             force = -std::numbers::pi * std::pow(R, 4) * tau * tau * (c1 + 2 * c2) / 2;
  EXPECT_NEAR(run.measure("grip.torque_z") / torque, 1, 0.03);
  EXPECT_NEAR(run.measure("grip.force_z") / force, 1, 0.05);
}

/// A bar that nothing holds, pulled at both ends by forces in balance: plane strain of a
/// neo-Hookean body, mu (a - 1/a^3) = 1, nearly incompressible.
TEST(MixedNewton, PullsAFreeBar) {
  const auto face = [](const std::string& name, const std::string& force) {
    return "[[traction]]\nname = \"" + name + "\"\nbody = \"bar\"\nface = \"" + name +
           "\"\nforce = [\"" + force + "\", 0]\n";
  };
  const test::Solved<2> run(
      "dimension = 2\n[time]\nsolver = \"newton\"\nend = 2\nstep = 1\n[[body]]\nname = \"bar\"\n"
      "shape = \"rectangle\"\nsize = [4, 1]\ncells = [8, 3]\nmaterial = { type = \"neo_hookean\", "
      "density = 1, mu = 1, lambda = 5000 }\n" +
      face("x_max", "t/2") + face("x_min", "-t/2"));
  EXPECT_LE(run.newton().iterations(), 2 * 6);
  EXPECT_GT(run.newton().stability(), 0.1);
  const Real stretch = run.measure("bar.extent_x") / 4;
  EXPECT_NEAR(stretch - std::pow(stretch, -3), 1, 1e-3);
}

/// A thick sphere of an incompressible Mooney-Rivlin material, blown up by a content: p is the
/// integral of W'(a)/(a^3 - 1) over the stretches a of the wall, W(a) = W(1/a^2, a, a). The shell
/// passes its greatest pressure. The volume is an unknown of the tangent, so that it is stable.
TEST(MixedNewton, BlowsABalloonPastItsGreatestPressure) {
  constexpr Real c1 = 0.45, c2 = 0.05, inner = 0.7;
  const auto pressure = [&](Real fraction) {
    const auto stretch = [&](Real R) {
      return std::cbrt(1 + (fraction - 1) * std::pow(inner / R, 3));
    };
    const Real least = stretch(1), most = stretch(inner);
    constexpr int intervals = 2000;
    Real sum = 0;
    for (int k = 0; k < intervals; ++k) {
      const Real a = least + (k + 0.5) * (most - least) / intervals;
      const Real slope =
          4 * c1 * (a - std::pow(a, -5)) + 4 * c2 * (std::pow(a, 3) - std::pow(a, -3));
      sum += slope / (std::pow(a, 3) - 1) * (most - least) / intervals;
    }
    return sum;
  };
  const test::Solved<3> run(
      "dimension = 3\n[time]\nsolver = \"newton\"\nend = 3\nstep = 1\n[[body]]\nname = "
      "\"shell\"\nshape = \"sphere_shell\"\nradius = 1\nthickness = 0.3\nlayers = 3\nspacing = "
      "0.5\nmaterial = { type = \"mooney_rivlin\", density = 1, c1 = 0.45, c2 = 0.05, lambda = "
      "500 }\n[[cavity]]\nbody = \"shell\"\nsurface = \"inner\"\nvolume_target = 4\npenalty = 50\n"
      "ramp = [0, 3]\n");
  EXPECT_LE(run.newton().iterations(), 3 * 9);
  EXPECT_GT(run.newton().stability(), 0);
  EXPECT_LE(run.newton().left(), 1e-9);
  const Real fraction = run.measure("shell.cavity_fraction");
  EXPECT_GT(fraction, 3.9);
  EXPECT_NEAR(run.measure("shell.cavity_pressure") / pressure(fraction), 1, 0.02);
}

/// A slender beam pressed along its axis, with a force beside it or without: Euler's load of plane
/// strain is 0.548 at t = 5. Without that force the fork is found by the count of eigenvalues.
TEST(MixedNewton, GoesOnAtAFork) {
  const auto strut = [](const std::string& end, const std::string& beside) {
    return "dimension = 2\n[time]\nsolver = \"newton\"\nend = " + end +
           "\nstep = 2\n[[body]]\nname = \"beam\"\nshape = \"rectangle\"\nsize = [20, 1]\ncells = "
           "[60, 3]\nmaterial = { type = \"st_venant_kirchhoff\", density = 1, mu = 400, lambda = "
           "400 }\n[[held]]\nbody = \"beam\"\nface = \"x_min\"\n[[traction]]\nname = \"end\"\nbody "
           "= "
           "\"beam\"\nface = \"x_max\"\nforce = [\"-0.10966*t\", \"" +
           beside + "\"]\n";
  };
  const test::Solved<2> early(strut("4.5", "0")), late(strut("4.75", "0"));
  const Real before = early.newton().stability(), after = late.newton().stability();
  EXPECT_NEAR(4.75 + 0.25 * after / (before - after), 5, 0.01);
  const test::Solved<2> straight(strut("8", "0")), pushed(strut("8", "1e-4"));
  ASSERT_FALSE(straight.notes.empty());
  EXPECT_NE(straight.notes.front().find("an equilibrium was found that is not stable"),
            std::string::npos);
  EXPECT_LT(straight.measure("end.displacement_x"), -10);
  EXPECT_NEAR(straight.measure("end.displacement_x") / pushed.measure("end.displacement_x"), 1,
              1e-3);
  EXPECT_NEAR(
      std::abs(straight.measure("end.displacement_y") / pushed.measure("end.displacement_y")), 1,
      1e-3);
  EXPECT_GT(straight.newton().stability(), 0.1);
}

/// A ring under a pressure that follows its surface buckles at 3 E' I/R^3 with E' of plane strain
/// if it is thin, here at t = 10; the error is of second order in the thickness. The square of the
/// frequency falls in proportion to the pressure.
TEST(MixedNewton, FindsThePressureThatBucklesARing) {
  const auto buckles_at = [](Real thickness, int around) {
    const auto stability = [&](int end) {
      const test::Solved<2> run(fmt::format(
          "dimension = 2\n[time]\nsolver = \"newton\"\nend = {0}\nstep = 3\n[[body]]\nname = "
          "\"ring\"\nshape = \"ring\"\nradius = {1}\nthickness = {2}\naround = {3}\nlayers = 3\n"
          "material = {{ type = \"st_venant_kirchhoff\", density = 1, mu = 400, lambda = 400 }}\n"
          "[[traction]]\nbody = \"ring\"\nwhere = \"x^2 + y^2 > 1\"\npressure = \"{4}*t\"\n",
          end, 1 + thickness / 2, thickness, around, 3200.0 / 3 / 40 * std::pow(thickness, 3)));
      EXPECT_LE(run.newton().iterations(), 3 * end / 3);
      return run.newton().stability();
    };
    const Real at_6 = stability(6), at_9 = stability(9);
    return 9 + 3 * at_9 / (at_6 - at_9);
  };
  const Real thick = buckles_at(0.1, 120), thin = buckles_at(0.05, 240);
  EXPECT_NEAR((10 - thick) / (10 - thin), 4, 0.2);
  EXPECT_NEAR((4 * thin - thick) / 3, 10, 0.01);
}

/// A nearly incompressible disk between rigid plates: the lid moves by three times the range of the
/// contact per load step.
TEST(MixedNewton, PressesADiskBetweenPlates) {
  const std::string of_plate = "bodies = [\"disk\"]\nepsilon = 1\nsigma0 = 0.05\nbeta = 10\n";
  const test::Solved<2> run(
      "dimension = 2\n[time]\nsolver = \"newton\"\nend = 2\nstep = 1\n[[body]]\nname = \"disk\"\n"
      "shape = \"disk\"\nradius = 1\ncore = 4\nrings = 3\nmaterial = { type = \"neo_hookean\", "
      "density = 1, mu = 1, lambda = 5000 }\n[[contact]]\nname = \"floor\"\n" +
      of_plate +
      "partner = { type = \"half_space\", point = [0, -1.04], normal = [0, 1] }\n[[contact]]\nname "
      "= \"lid\"\n" +
      of_plate +
      "partner = { type = \"half_space\", point = [0, 1.04], normal = [0, -1], displacement = [0, "
      "\"-0.15*t\"] }\n");
  EXPECT_LE(run.newton().iterations(), 120);
  EXPECT_LE(run.newton().left(), 1e-9);
  EXPECT_GT(run.newton().stability(), 0);
  EXPECT_NEAR(run.measure("floor.force_y") / -run.measure("lid.force_y"), 1, 1e-9);
  EXPECT_GT(run.measure("floor.force_y"), 0.1);
}

/// A bar between springs, which alone hold it: the load is the force of the springs.
TEST(MixedNewton, PullsABarAtSprings) {
  const test::Solved<2> run(
      "dimension = 2\n[time]\nsolver = \"newton\"\nend = 2\nstep = 1\n[[body]]\nname = \"bar\"\n"
      "shape = \"rectangle\"\nsize = [4, 1]\ncells = [8, 3]\nmaterial = { type = \"neo_hookean\", "
      "density = 1, mu = 1, lambda = 5000 }\n[[spring]]\nname = \"spring\"\nbody = \"bar\"\nface = "
      "\"x_min\"\nstiffness = 3\n[[traction]]\nbody = \"bar\"\nface = \"x_max\"\nforce = "
      "[\"t/2\", \"0.01*t\"]\n");
  EXPECT_LE(run.newton().iterations(), 2 * 7);
  EXPECT_LE(run.newton().left(), 1e-9);
  EXPECT_NEAR(run.measure("spring.force_x"), -1, 1e-9);
  EXPECT_NEAR(run.measure("spring.force_y"), -0.02, 1e-9);
}

}  // namespace
}  // namespace meniscus::test_mixed_newton
