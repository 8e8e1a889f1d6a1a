// SPDX-License-Identifier: BSD-3-Clause
// Surface laws: forces are the gradient of the energy, viscous stress is objective. Bodies at rest
// under elastic surfaces, flows driven by tensions, oscillation of a drop with a surface law,
// refused scenes. Larger clouds are in tests/verify/verify_surface_laws.cpp.
#include "meniscus/error.hpp"
#include "meniscus/physics/surface_registry.hpp"
#include "surface_scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meniscus::test_surface_laws {
namespace {

using test::law_of;

template <int D>
void expect_gradients() {
  for (const auto& body : {test::body_of<D>(test::potato<D>()),
                           test::body_of<D>(test::brick<D>(D == 3 ? std::vector<Real>{3, 3, 2}
                                                                  : std::vector<Real>{4, 3}))})
    for (const auto& [type, numbers] : {std::pair("gurtin_murdoch", "lambda = 0.4\nmu = 0.3\n"),
                                        {"gurtin_murdoch", "lambda = -0.2\nmu = 0.3\n"},
                                        {"neo_hookean_skin", "lambda = 0.4\nmu = 0.3\n"},
                                        {"varying_tension", "gamma = \"1 + 0.3*x - 0.2*x*y\"\n"}}) {
      SCOPED_TRACE(type);
      const auto term = test::surface_term(*body, type, numbers);
      test::expect_balanced_gradient<D>(*term, *body, 0.03, 2e-4, 1e-13);
    }
}

TEST(SurfaceLaws, ForcesAreTheGradientOfTheEnergyAndBalanced) {
  expect_gradients<2>();
  expect_gradients<3>();
}

/// A rotated motion has the same energy; the reference has no stress.
TEST(SurfaceLaws, EnergiesAreThoseOfStrainAlone) {
  const auto body = test::body_of<3>(test::potato<3>());
  Mat<3> R, G;
  R << 0.6, -0.8, 0, 0.8, 0.6, 0, 0, 0, 1;
  G << 1.1, 0.2, -0.1, 0.05, 0.9, 0.1, 0, -0.15, 1.05;
  for (const auto& type : {"gurtin_murdoch", "neo_hookean_skin"}) {
    const auto term = test::surface_term(*body, type, "lambda = 0.4\nmu = 0.3\n");
    const auto moved = [&](const Mat<3>& F) {
      return test::field_on<3>(*body, [&](const Vec<3>& X) { return Vec<3>(F * X - X); });
    };
    EXPECT_NEAR(test::energy_of(*term, moved(R)), 0, 1e-13);
    EXPECT_LT(test::norm(test::force_of(*term, moved(R))), 1e-13);
    const Real strained = test::energy_of(*term, moved(G));
    EXPECT_GT(strained, 0.01);
    EXPECT_NEAR(test::energy_of(*term, moved(R * G)), strained, 1e-13);
  }
}

/// The heat of a growing ball is 4 kappa area rate^2 (2D: (mu + kappa) length rate^2). A rotating
/// body has no heat, however it is deformed.
template <int D>
void expect_viscosity() {
  const auto body = test::body_of<D>([] {
    if constexpr (D == 3)
      return test::ball(4, 2);
    else
      return test::disk(6, 3);
  }());
  const auto term =
      test::surface_term(*body, "boussinesq_scriven", "shear = 0.05\ndilatational = 0.1\n");
  const NodalVectors u = test::field_on<D>(*body, [](const Vec<D>& X) {
    Vec<D> w = 0.1 * X;
    w[0] += 0.2 * std::sin(2 * X[1]);
    return w;
  });
  const NodalVectors growing = test::field_on<D>(*body, [](const Vec<D>& X) { return Vec<D>(X); });
  NodalVectors turning = test::zeros(u);
  for (Index A = 0; A < body->size(); ++A) {
    const Vec<D> x = at(body->particles.X(), A) + vector_at<D>(u, A);
    Vec<D> w = Vec<D>::Zero();
    w[0] = -x[1];
    w[1] = x[0];
    set_vector<D>(turning, A, w);
  }
  const NodalVectors rest = test::zeros(u);
  const Real exact = D == 3 ? 4 * 0.1 * 4 * std::numbers::pi : 0.15 * 2 * std::numbers::pi;
  EXPECT_NEAR(test::report_of(*term, rest, growing).heat, exact, 2e-5 * exact);
  EXPECT_NEAR(-test::dot(test::force_of(*term, rest, growing), growing),
              test::report_of(*term, rest, growing).heat, 1e-12);
  EXPECT_LT(test::report_of(*term, u, turning).heat, 1e-15);
  EXPECT_LT(test::norm(test::force_of(*term, u, turning)), 1e-13);
  const test::Balance net = test::balance_of<D>(*body, u, test::force_of(*term, u, growing));
  EXPECT_LT(net.force, 1e-13);
  EXPECT_LT(net.torque, 1e-13);
}

TEST(SurfaceLaws, ViscosityIsObjectiveAndHeats) {
  expect_viscosity<2>();
  expect_viscosity<3>();
}

/// Tests all rows for the disk, and one row per law for the ball. The verification tests the whole
/// table.
TEST(SurfaceLaws, BallsAndDisksRestAtTheirExactRadius) {
  int balls = 0;
  for (const auto& row : test::cells_reference().at("surface").at("ball_radial").at("rows")) {
    SCOPED_TRACE(row.dump());
    const Real exact = std::stod(row.at("stretch").get<std::string>());
    if (row.at("d") == 2) {
      EXPECT_NEAR(test::radial_stretch<2>(row, 6, 3), exact, 1e-4 * exact);
      EXPECT_NEAR(test::radial_stretch_by_traction<2>(row, 6, 3), exact, 1e-4 * exact);
    } else if (row.at("bulk") == "nh" && ++balls <= 5) {
      EXPECT_NEAR(test::radial_stretch<3>(row, 4, 2), exact, 1e-4 * exact);
      EXPECT_NEAR(test::radial_stretch_by_traction<3>(row, 4, 2), exact, 1e-4 * exact);
    }
  }
}

TEST(SurfaceLaws, TidesOfABallWithAnElasticSurface) {
  const auto& rows = test::cells_reference().at("surface").at("ball_tidal").at("rows");
  EXPECT_LT(test::tidal_error(rows[1], 4, 2), 0.02);
}

/// A body at rest has the mean stress -(1/V) int sigma_s da; a small tension reduces its volume by
/// (2 gamma/3) (A/V)/kappa.
TEST(SurfaceLaws, TensionCompressesABoxByItsMeanStress) {
  constexpr Real tension = 1e-4, mu = 1, lambda = 1.5;
  Scene<3> scene = test::scene_of<3>(
      "dimension = 3\n[time]\nsolver = \"newton\"\nend = 1e3\n[[body]]\nname = \"b\"\nshape = "
      "\"box\"\nsize = [1, 1, 0.5]\ncells = [6, 6, 4]\nmaterial = { type = \"neo_hookean\", "
      "density "
      "= 1, mu = 1, lambda = 1.5 }\n" +
      law_of("tension", "gamma = 1e-4\n"));
  Simulation<3> simulation(scene);
  simulation.begin();
  const auto measured = [&](const std::string& name) {
    return test::measured(scene, simulation.state(), name);
  };
  const Real before = measured("b.volume");
  while (!simulation.finished()) simulation.advance();
  const Real pressure = 2 * tension / 3 * measured("b.area") / measured("b.volume");
  EXPECT_NEAR(measured("b.mean_pressure"), pressure, 1e-6 * pressure);
  const Real change = measured("b.volume") / before - 1,
             exact = -2 * tension / 3 * (4 / 0.5) / (lambda + 2.0 / 3 * mu);
  EXPECT_NEAR(exact, -2.4615e-4, 1e-8);
  EXPECT_NEAR(change, exact, 1e-3 * std::abs(exact));
  // By the virial, a plate with the edges a, a, t has the mean stress -gamma (2/t + 2/a) along it.
  const Body<3>& body = scene.system.bodies.front();
  const State& state = simulation.state();
  const NodalVectors stress = test::force_of(*scene.system.terms.front(), state.u);
  Real virial = 0;
  for (Index A = 0; A < body.size(); ++A)
    virial -= at(stress, A)[0] * (at(body.particles.X(), A)[0] + at(state.u, A)[0]);
  const Real along = -tension * (2 / 0.5 + 2);
  EXPECT_NEAR(virial / measured("b.volume"), along, 1e-3 * std::abs(along));
}

/// A cylinder with an elastic skin is stretched along its axis. The difference of the energies of
/// two cylinders of different length is the energy of a section, without end faces. The section is
/// free to contract. Compares the ratio of strains, and force over strain and area of the section.
TEST(SurfaceLaws, ASectionOfAStretchedCylinderIsStifferByItsSkin) {
  constexpr Real mu = 1, lambda = 1.5, skin_mu = 0.3, skin_lambda = 0.4, h = 1e-4;
  const auto cylinder = [](int height) {
    return test::scene_of<3>(
        fmt::format("dimension = 3\n[time]\nend = 1\n[[body]]\nname = \"b\"\nshape = "
                    "\"cylinder\"\nradius = 1\nheight = {}\ncore = 6\nrings = 3\nlayers = "
                    "4\nmaterial = {{ type = \"neo_hookean\", density = 1, mu = 1, lambda = 1.5 "
                    "}}\n",
                    height) +
        law_of("gurtin_murdoch", "lambda = 0.4\nmu = 0.3\n"));
  };
  const Scene<3> one = cylinder(1), two = cylinder(2);
  const auto energy = [](const Scene<3>& scene, Real across, Real along) {
    const NodalVectors u =
        test::field_on<3>(scene.system.bodies.front(), [&](const Vec<3>& X) -> Vec<3> {
          return {across * X[0], across * X[1], along * X[2]};
        });
    Real sum = 0;
    for (const auto& term : scene.system.terms) sum += test::energy_of(*term, u);
    return sum;
  };
  const auto section = [&](Real across, Real along) {
    return energy(two, across, along) - energy(one, across, along);
  };
  const auto second = [&](Real across, Real along) {
    return (section(h * across, h * along) + section(-h * across, -h * along)) / (h * h);
  };
  const Real rr = second(1, 0), zz = second(0, 1), rz = (second(1, 1) - rr - zz) / 2;
  const Real ratio = -(lambda + skin_lambda) / (2 * (lambda + mu) + skin_lambda + 2 * skin_mu),
             stiffness = lambda + 2 * mu + 2 * (skin_lambda + 2 * skin_mu) +
                         2 * (lambda + skin_lambda) * ratio;
  EXPECT_NEAR(stiffness, 4.2966667, 1e-7);
  EXPECT_NEAR(-rz / rr, ratio, 1e-4 * std::abs(ratio));
  EXPECT_NEAR((zz - rz * rz / rr) / std::numbers::pi, stiffness, 1e-4 * stiffness);
}

TEST(SurfaceLaws, TensionsDriveTheExactFlowInADisk) {
  const test::Marangoni clean = test::marangoni<2>({}, 6, 3, 1.2),
                        viscous = test::marangoni<2>({1, 0.5, 0.1, 0.2, "material"}, 6, 3, 1.2);
  for (const auto& run : {clean, viscous}) {
    EXPECT_NEAR(run.amplitude.back(), 1, 0.01);
    EXPECT_LT(run.beside, 0.02);
    EXPECT_LT(run.balance, 1e-3);
  }
}

TEST(SurfaceLaws, SurfacesOfTheirOwnChangeTheOscillationOfADisk) {
  for (const auto& row : test::cells_reference().at("oscillation").at("rows")) {
    if (row.at("d") != 2) continue;
    SCOPED_TRACE(row.dump());
    EXPECT_LT(test::oscillation<2>(row, 8, 4).error(), 0.02);
  }
}

std::string refusal(const std::string& text) {
  try {
    Scene<3> scene = test::scene_of<3>(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(SurfaceLaws, UnstableSkinsNeedAStiffBody) {
  const std::string heading = "dimension = 3\n[time]\nend = 1\n" + test::ball_of(3, 2, 2),
                    solid =
                        "material = { type = \"neo_hookean\", density = 1, mu = 1, lambda = 1 }\n";
  const auto with = [&](const std::string& body, const std::string& numbers) {
    return refusal(heading + body + law_of("gurtin_murdoch", numbers));
  };
  EXPECT_EQ(with(solid, "lambda = 1\nmu = 0\n"), "");
  EXPECT_EQ(with(solid, "lambda = 1\nmu = -0.01\n"), "");  // with a warning
  const std::string soft = with(solid, "lambda = 15.6\nmu = -8.6\n");
  EXPECT_NE(soft.find("surface[0]: the energy of the skin of 'b' is not positive (least modulus in "
                      "the surface -8.6"),
            std::string::npos)
      << soft;
  EXPECT_NE(soft.find("expected are mu >= 0 and lambda + mu >= 0"), std::string::npos) << soft;
  const std::string liquid =
      "material = { type = \"newtonian\", density = 1, bulk_modulus = 10, viscosity = 1 }\n";
  EXPECT_NE(with(liquid, "lambda = 1\nmu = -0.01\n"), "");
}

/// The surface laws of a fluid together have a negative tension, which is refused. A solid can bear
/// it.
TEST(SurfaceLaws, TensionsOfFluidsAreNowhereNegative) {
  const std::string heading = "dimension = 3\n[time]\nend = 1\n" + test::ball_of(3, 2, 2),
                    liquid =
                        "material = { type = \"newtonian\", density = 1, bulk_modulus = 100, "
                        "viscosity = 1 }\n",
                    solid =
                        "material = { type = \"neo_hookean\", density = 1, mu = 1, lambda = 1 }\n",
                    one = "[[surface_tension]]\nbody = \"b\"\ngamma = 1\n";
  const auto found = [&](const std::string& body, const std::string& gamma) -> std::string {
    Scene<3> scene = test::scene_of<3>(heading + body + one +
                                       law_of("varying_tension", "gamma = \"" + gamma + "\"\n"));
    Simulation<3> simulation(scene);
    try {
      simulation.begin();
      simulation.audit_now();
    } catch (const StepError& error) {
      EXPECT_EQ(error.failure.body, "b");
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(found(liquid, "0.9*z"), "");
  EXPECT_EQ(found(solid, "1.5*z"), "");
  const std::string negative = found(liquid, "1.5*z");
  EXPECT_NE(negative.find("the tension of the surface is -0.4"), std::string::npos) << negative;
  EXPECT_NE(negative.find("nowhere negative"), std::string::npos) << negative;
}

/// An elastic skin alone does not make a body wet a wall.
TEST(SurfaceLaws, SkinsDoNotWet) {
  const auto wets = [](const std::string& law) {
    return !test::scene_of<3>(
                "dimension = 3\n[time]\nend = 1\n" + test::ball_of(3, 2, 2) +
                "material = { type = \"neo_hookean\", density = 1, mu = 1, lambda = 1 }\n" + law +
                "[[contact]]\nname = \"wall\"\nbodies = [\"b\"]\nadhesion = 0.05\nsigma0 = 0.1\n"
                "[contact.partner]\ntype = \"half_space\"\npoint = [0, 0, -1.2]\nnormal = [0, 0, "
                "1]\n")
                .wetting.empty();
  };
  EXPECT_FALSE(wets(law_of("gurtin_murdoch", "lambda = 1\nmu = 1\n")));
  EXPECT_FALSE(wets(law_of("boussinesq_scriven", "shear = 1\ndilatational = 1\n")));
  EXPECT_TRUE(wets(law_of("tension", "gamma = 1\n")));
}

TEST(SurfaceLaws, AreOnePerTypeAndBody) {
  const std::string heading =
                        "dimension = 3\n[time]\nend = 1\n" + test::ball_of(3, 2, 2) +
                        "material = { type = \"neo_hookean\", density = 1, mu = 1, lambda = 1 }\n",
                    skin = law_of("gurtin_murdoch", "lambda = 1\nmu = 1\n"),
                    tension = law_of("tension", "gamma = 1\n");
  EXPECT_EQ(refusal(heading + skin + tension), "");
  EXPECT_NE(refusal(heading + skin + skin)
                .find("the gurtin_murdoch of the surface of 'b' has a law already"),
            std::string::npos);
  EXPECT_NE(refusal(heading + tension + "[[surface_tension]]\nbody = \"b\"\ngamma = 1\n")
                .find("the surface of 'b' has a law already"),
            std::string::npos);
}

}  // namespace
}  // namespace meniscus::test_surface_laws
