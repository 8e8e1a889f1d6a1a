// SPDX-License-Identifier: BSD-3-Clause
// Surface tension and pressure on the same closed surface: patches, the fluid with its enclosed
// volume, damping of coefficients, and measures of drops.
#include "body/surface/surface_patches.hpp"
#include "measure/drop_measures.hpp"
#include "meniscus/error.hpp"
#include "physics/internal/coefficient_damping.hpp"
#include "physics/loads/body_force.hpp"
#include "physics/surface/surface_tension.hpp"
#include "run/simulation.hpp"
#include "support.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace meniscus::test_balanced_surface_tension {
namespace {

constexpr Real pi = std::numbers::pi;
const Integration enclosed{"q_scni", 0, "automatic", true};
const Integration enclosed_full{"q_scni", 0, "full", true};
const Integration enclosed_gauss{"gauss", 2, "automatic", true};

std::string fluid(const std::string& equation) {
  return "density = 1\nbulk_modulus = 20\nviscosity = 0.5\nequation_of_state = \"" + equation +
         "\"\n";
}

template <int D>
Geometry<D> cylinder() {
  if constexpr (D == 3) {
    Cylinder shape;
    shape.core = 2;
    shape.rings = 1;
    shape.layers = 3;
    return shape.geometry();
  } else {
    return test::brick<2>({4, 3});
  }
}

template <int D>
void expect_closed(Geometry<D> geometry) {
  const auto body = test::body_of<D>(std::move(geometry));
  const SurfacePatches<D> patches(*body);
  // Quadrilaterals on a closed surface without holes have twice as many edges as faces, and two
  // more corners than faces.
  const Index faces = patches.patch_count();
  EXPECT_EQ(patches.point_count(), D == 3 ? 4 * faces + 2 : 2 * faces);
}

TEST(SurfacePatches, AreClosedAlsoAtEdges) {
  expect_closed<3>(test::ball(2, 1));
  expect_closed<3>(test::potato<3>());
  expect_closed<3>(test::brick<3>({3, 2, 4}));
  expect_closed<3>(cylinder<3>());
  expect_closed<2>(test::disk(4, 2));
  expect_closed<2>(test::brick<2>({4, 3}));
}

TEST(SurfacePatches, SizesAreExactForBricksAndOfFourthOrderForBalls) {
  using Size = SurfacePatches<3>::Size;
  const auto brick = test::body_of<3>(test::brick<3>({2, 3, 4}));
  EXPECT_NEAR(SurfacePatches<3>(*brick).reference(Size::volume), 24, 1e-12);
  EXPECT_NEAR(SurfacePatches<3>(*brick).reference(Size::area), 52, 1e-12);
  const auto error = [](int core, Size size, Real exact) {
    const auto ball = test::body_of<3>(test::ball(core, 2));
    return std::abs(SurfacePatches<3>(*ball).reference(size) / exact - 1);
  };
  for (const auto& [size, exact] : {std::pair(Size::volume, 4 * pi / 3), {Size::area, 4 * pi}}) {
    const Real coarse = error(4, size, exact), fine = error(8, size, exact);
    EXPECT_LT(coarse, 1e-3);
    EXPECT_GT(coarse / fine, 14);
  }
}

TEST(SurfacePatches, FollowTheParticles) {
  using Size = SurfacePatches<3>::Size;
  const auto body = test::body_of<3>(test::potato<3>());
  SurfacePatches<3> patches(*body);
  const NodalVectors u = test::field_on<3>(
      *body, [](const Vec<3>& X) { return Vec<3>(0.5 * X[0] + 100, 0.2 * X[0] + 3, -7); });
  patches.place(u.data());
  EXPECT_NEAR(patches.follow(Size::volume) / patches.reference(Size::volume), 1.5, 1e-12);
  EXPECT_EQ(patches.follow(Size::area), patches.measure(Size::area, u.data()));
}

template <int D>
void expect_exact_gradient(Geometry<D> geometry, const std::string& text) {
  const auto body = test::body_of<D>(std::move(geometry));
  for (const Integration& integration : {enclosed, enclosed_full, enclosed_gauss}) {
    SCOPED_TRACE(text + integration.rule + ", " + integration.volumetric);
    const auto term = test::internal_force<D>(*body, "newtonian", text, integration);
    for (unsigned seed = 0; seed < 2; ++seed) {
      NodalVectors u = test::random_field<D>(body->size(), 0.02, seed);
      const NodalVectors direction = test::random_field<D>(body->size(), 1, 50 + seed);
      EXPECT_LT(test::gradient_error(*term, u, direction, 2e-4), 1e-7);
      const NodalVectors v = test::random_field<D>(body->size(), 1, 8);
      const test::Balance net = test::balance_of<D>(*body, u, test::force_of(*term, u, v));
      EXPECT_LT(net.force, 1e-14);
      EXPECT_LT(net.torque, 1e-14);

      const Motion motion{0, u, v};
      NodalVectors force = test::zeros(u);
      std::vector<StoredEnergy> energies;
      Forces asked(force);
      asked.energies = &energies;
      term->add_force(motion, asked);
      ASSERT_EQ(energies.size(), 1U);
      const Real energy = term->stored_energy(motion).value();
      EXPECT_NEAR(energies[0].value, energy, 1e-12 * std::abs(energy));
    }
  }
}

TEST(EnclosedFluid, IsTheGradientOfItsEnergyWithoutNetForce) {
  for (const std::string equation : {"linear", "log", "tait"}) {
    expect_exact_gradient<2>(test::potato<2>(), fluid(equation));
    expect_exact_gradient<3>(test::potato<3>(), fluid(equation));
    expect_exact_gradient<3>(test::brick<3>({2, 3, 2}), fluid(equation));
  }
  expect_exact_gradient<2>(
      test::potato<2>(),
      "density = 1\nbulk_modulus = \"20 + 5*x\"\nviscosity = 0.5\nequation_of_state = \"tait\"\n");
}

/// Displacements that compress a body uniformly.
template <int D>
NodalVectors compressed(const Body<D>& body) {
  return test::field_on<D>(body, [](const Vec<D>& X) {
    Vec<D> u = -0.02 * X;
    u[0] += 0.3 * X[1];
    return u;
  });
}

TEST(EnclosedFluid, InsideIsFreeOfForceWhereThePressureIsUniform) {
  const auto body = test::body_of<3>(test::ball(6, 3));
  for (const std::string equation : {"linear", "log", "tait"}) {
    const auto term = test::internal_force<3>(*body, "newtonian", fluid(equation), enclosed);
    const NodalVectors force = test::force_of(*term, compressed(*body));
    Real inside = 0, largest = 0;
    for (Index A = 0; A < body->size(); ++A) {
      const Real size = vector_at<3>(force, A).norm();
      largest = std::max(largest, size);
      if (at(body->particles.X(), A).norm() + at(body->particles.support(), A) < 0.98)
        inside = std::max(inside, size);
    }
    EXPECT_GT(inside, 0);
    EXPECT_LT(inside, 1e-13 * largest);
  }
}

/// The enclosed form changes the forces of the pressure but not the pressure itself.
TEST(EnclosedFluid, EnergyAndPressureAreThoseOfTheLawWhereTheVolumeChangeIsUniform) {
  const auto body = test::body_of<3>(test::ball(4, 2));
  const auto pressure = [&](ForceTerm& term, const NodalVectors& u) {
    for (const MeasureSource& m : term.measures())
      if (m.name == "mean_pressure") return m.compute({0, u, u});
    throw std::runtime_error("no pressure");
  };
  const NodalVectors u = compressed(*body);
  for (const std::string equation : {"linear", "log", "tait"}) {
    const auto local = test::internal_force<3>(*body, "newtonian", fluid(equation));
    const auto about = test::internal_force<3>(*body, "newtonian", fluid(equation), enclosed);
    EXPECT_NEAR(test::energy_of(*about, u) / test::energy_of(*local, u), 1, 1e-11) << equation;
    test::force_of(*about, u);
    EXPECT_NEAR(pressure(*about, u) / pressure(*local, u), 1, 1e-12) << equation;
  }
}

/// Sum of the residual forces over the sum of the capillary forces.
template <int D>
Real residual_of(Geometry<D> geometry, bool balanced, Real theta) {
  const auto body = test::body_of<D>(std::move(geometry));
  const Real stretch = std::pow(1 + theta, 1.0 / D) - 1;
  const NodalVectors u =
      test::field_on<D>(*body, [&](const Vec<D>& X) { return Vec<D>(stretch * X); });
  // In equilibrium with the Laplace pressure (D - 1) gamma / R.
  const std::string text =
      "density = 1\nequation_of_state = \"linear\"\nviscosity = 1\n"
      "bulk_modulus = " +
      std::to_string(-(D - 1) / (theta * (1 + stretch)));
  const auto bulk =
      test::internal_force<D>(*body, "newtonian", text, balanced ? enclosed : Integration{});
  const auto surface =
      balanced ? balanced_surface_tension<D>(*body, 1) : weak_surface_tension<D>(*body, 1, 3);
  const NodalVectors force = test::sum_of(test::force_of(*bulk, u), 1, test::force_of(*surface, u));
  const Real R = 1 + stretch;
  return capillary_residual(force, 1, D == 3 ? 4 * pi * R * R : 2 * pi * R,
                            D == 3 ? 4 * pi / 3 * R * R * R : pi * R * R, D);
}

TEST(BalancedSurfaceTension, ABallInItsLaplacePressureIsAtRest) {
  EXPECT_LT(residual_of<3>(test::ball(6, 3), true, -0.0116), 1e-4);
  EXPECT_GT(residual_of<3>(test::ball(6, 3), false, -0.0116), 1e-3);
  EXPECT_LT(residual_of<2>(test::disk(12, 6), true, -0.0058), 2e-6);
  EXPECT_GT(residual_of<2>(test::disk(12, 6), false, -0.0058), 1e-4);
}

template <int D>
void expect_damping(Geometry<D> geometry) {
  const auto body = test::body_of<D>(std::move(geometry));
  const std::vector<Real> viscosity(static_cast<std::size_t>(body->size()), 0.5);
  const auto term = coefficient_damping<D>(*body, viscosity, 2);
  const NodalVectors u = test::random_field<D>(body->size(), 0.05, 1);
  const NodalVectors v = test::random_field<D>(body->size(), 1, 2);
  const NodalVectors force = test::force_of(*term, u, v);
  EXPECT_GT(test::norm(force), 0);
  const Real heat = test::report_of(*term, u, v).heat;
  EXPECT_NEAR(-test::dot(force, v), heat, 1e-12 * heat);
  const test::Balance net = test::balance_of<D>(*body, u, force);
  EXPECT_LT(net.force, 1e-14);
  EXPECT_LT(net.torque, 1e-13);
  // An additional rigid rotation does not change the force.
  NodalVectors spun = v;
  for (Index A = 0; A < body->size(); ++A) {
    const Vec<D> x = at(body->particles.X(), A) + vector_at<D>(u, A);
    Lanes& w = at(spun, A);
    w.set(0, w[0] - 3 * x[1]);
    w.set(1, w[1] + 3 * x[0]);
  }
  const NodalVectors change = test::sum_of(test::force_of(*term, u, spun), -1, force);
  EXPECT_LT(test::norm(change), 1e-12 * test::norm(force));
  // Shape functions reproduce quadratic fields at the particles.
  const NodalVectors smooth = test::field_on<D>(*body, [](const Vec<D>& X) {
    Vec<D> w = 0.3 * X;
    w[0] += X[0] * X[1] - 2;
    w[D - 1] -= X[1] * X[1];
    return w;
  });
  EXPECT_LT(test::norm(test::force_of(*term, test::zeros(u), smooth)), 1e-12 * test::norm(force));
}

TEST(CoefficientDamping, IsWithoutNetForceAndTorqueAndLeavesQuadraticFields) {
  expect_damping<2>(test::potato<2>());
  expect_damping<3>(test::potato<3>());
}

Real measure(const std::vector<MeasureSource>& measures, const std::string& name,
             const NodalVectors& u, const NodalVectors& v) {
  for (const MeasureSource& m : measures)
    if (m.name == name) return m.compute({0, u, v});
  throw std::runtime_error("no measure " + name);
}

TEST(DropMeasures, OfAStretchedBallThatTurns) {
  const auto body = test::body_of<3>(test::ball(4, 2));
  const std::vector<Real> viscosity(static_cast<std::size_t>(body->size()), 0.5);
  test::internal_force<3>(*body, "newtonian", fluid("linear"));  // sets the masses
  const auto measures = drop_measures<3>(*body, viscosity, 0.25);
  const NodalVectors rest = NodalVectors(static_cast<std::size_t>(body->size()), Lanes::zero());
  EXPECT_NEAR(measure(measures, "isoperimetric", rest, rest), 1, 1e-9);
  EXPECT_LT(measure(measures, "roughness", rest, rest), 1e-12);
  EXPECT_NEAR(measure(measures, "least_area_ratio", rest, rest), 1, 1e-12);
  const NodalVectors u =
      test::field_on<3>(*body, [](const Vec<3>& X) { return Vec<3>(0, 0, X[2]); });
  // Prolate, c = 2 a: A = 2 pi a^2 (1 + c/(a e) asin e), e^2 = 3/4.
  const Real e = std::sqrt(0.75), area = 2 * pi * (1 + 2 / e * std::asin(e));
  EXPECT_NEAR(measure(measures, "isoperimetric", u, rest), area / (4 * pi * std::cbrt(4.0)), 1e-5);
  EXPECT_NEAR(measure(measures, "least_area_ratio", u, rest), 1, 2e-3);  // at the poles
  EXPECT_GT(measure(measures, "roughness", u, rest), 0.2);
  // A uniform velocity has energy, but does not count as motion about the centre of mass; the field
  // z^2 does.
  const Real mass = 4 * pi / 3;
  const NodalVectors moving =
      test::field_on<3>(*body, [](const Vec<3>&) { return Vec<3>(0, 3, 0); });
  EXPECT_NEAR(measure(measures, "kinetic_at_places", u, moving), 4.5 * mass, 1e-3 * mass);
  // The square cancels numbers of order 3 up to rounding; the bound is the root of this rounding.
  EXPECT_LT(measure(measures, "ca", u, moving),
            0.5 / 0.25 * 3 * std::sqrt(16 * std::numeric_limits<Real>::epsilon()));
  const NodalVectors spinning =
      test::field_on<3>(*body, [](const Vec<3>& X) { return Vec<3>(-X[1], X[0], 0); });
  EXPECT_NEAR(measure(measures, "ca", u, spinning), 0.5 / 0.25 * std::sqrt(0.4), 2e-2);
}

const char* const drop_scene = R"toml(
dimension = 3
time = { end = 1 }
[[body]]
name = "drop"
shape = "ball"
radius = 1
core = 2
layers = 1
material = { type = "newtonian", density = 1, bulk_modulus = 20, viscosity = 0.3 }
[[surface_tension]]
body = "drop"
gamma = 1
)toml";

Scene<3> scene_of(const std::string& text) {
  const SceneInput input = SceneInput::from_text(text);
  scene_dimension(input);
  return build_scene<3>(input);
}

TEST(BalancedSurfaceTension, IsWhatFluidsGetWithDampingUnlessASceneSaysElse) {
  const auto names = [](const Scene<3>& scene) {
    std::vector<std::string> found;
    for (const auto& term : scene.system.terms) found.push_back(term->name());
    return found;
  };
  const std::vector<std::string> with{"internal force of 'drop'", "surface tension of 'drop'",
                                      "coefficient damping of 'drop'"};
  const std::vector<std::string> without{with[0], with[1]};
  EXPECT_EQ(names(scene_of(drop_scene)), with);
  EXPECT_EQ(names(scene_of(std::string(drop_scene) + "coefficient_damping = 0\n")), without);
  const std::vector<std::string> weak{with[0], "tension of the surface of 'drop'"};
  EXPECT_EQ(names(scene_of(std::string(drop_scene) + "form = \"weak\"\n")), weak);
}

TEST(Simulation, StopsADropWhoseAreaIsImpossible) {
  Scene<3> scene = scene_of(drop_scene);
  Simulation<3> simulation(scene);
  simulation.begin();
  EXPECT_NO_THROW(simulation.audit_now());
  const auto true_area = scene.bodies.front().tension->area;
  scene.bodies.front().tension->area = [&](const Motion& motion) {
    return 0.99 * true_area(motion);
  };
  try {
    simulation.audit_now();
    FAIL() << "an area below the least possible was accepted";
  } catch (const SolveError& e) {
    EXPECT_NE(std::string(e.what()).find("body 'drop' has the isoperimetric ratio 0.99"),
              std::string::npos)
        << e.what();
  }
}

/// The force of the weight on patches has the net force M g and the net moment c x M g, and is the
/// gradient of M g . c.
template <int D>
void expect_weight_of_centroid(Geometry<D> geometry) {
  const auto body = test::body_of<D>(std::move(geometry));
  test::internal_force<D>(*body, "newtonian", fluid("linear"), enclosed);
  Real mass = 0;
  for (const Real m : body->mass_integral) mass += m;
  const Vec<D> g =
      D == 3 ? Vec<D>(Vec<D>::Constant(0.3) - Vec<D>::Unit(D - 1)) : Vec<D>(Vec<D>::Constant(-0.7));
  std::vector<Expression> acceleration;
  for (int i = 0; i < D; ++i) acceleration.emplace_back(g[i]);
  const auto term = weight_on_patches(*body, acceleration);
  const NodalVectors u = test::random_field<D>(body->size(), 0.03, 1),
                     w = test::random_field<D>(body->size(), 0.3, 2), rest = test::zeros(u);
  const NodalVectors force = test::force_of(*term, u);
  Eigen::Vector3d net = Eigen::Vector3d::Zero(), moment = net, centre = net;
  for (Index A = 0; A < body->size(); ++A) {
    const Eigen::Vector3d f = spatial(at(force, A));
    net += f;
    moment += (spatial<D>(at(body->particles.X(), A)) + spatial(at(u, A))).cross(f);
  }
  const SurfacePatches<D> patches(*body);
  for (int i = 0; i < D; ++i) centre[i] = patches.height(Vec<D>::Unit(i), u.data());
  const Eigen::Vector3d weight = mass * spatial<D>(g);
  EXPECT_LT((net - weight).norm(), 1e-13 * weight.norm());
  EXPECT_LT((moment - centre.cross(weight)).norm(), 1e-13 * weight.norm());
  const Report report = test::report_of(*term, u);
  EXPECT_LT((report.outside.force - net).norm(), 1e-13 * weight.norm());
  EXPECT_LT((report.outside.moment - moment).norm(), 1e-13 * weight.norm());

  const auto potential = [&](Real h) {
    const NodalVectors moved = test::sum_of(u, h, w);
    return *term->potential({0, moved, rest});
  };
  constexpr Real h = 1e-3;
  const Real slope =
      (8 * (potential(h) - potential(-h)) - (potential(2 * h) - potential(-2 * h))) / (12 * h);
  EXPECT_NEAR(slope, -test::dot(force, w), 1e-9);
  EXPECT_NEAR(term->load_power({0, u, w}), test::dot(force, w), 1e-13);
  NodalVectors tangent = rest;
  term->add_tangent({0, u, rest}, {0, w, rest}, tangent);
  const auto of = [&](Real s) { return test::force_of(*term, test::sum_of(u, s, w)); };
  const NodalVectors near = test::sum_of(of(h), -1, of(-h)),
                     far = test::sum_of(of(2 * h), -1, of(-2 * h));
  NodalVectors change = rest;
  for (std::size_t A = 0; A < change.size(); ++A) change[A] = (8 * near[A] - far[A]) / (12 * h);
  EXPECT_LT(test::norm(test::sum_of(tangent, -1, change)), 1e-8 * test::norm(tangent));
}
TEST(WeightOnPatches, PullsAtTheCentroid) {
  expect_weight_of_centroid<2>(test::disk(4, 2));
  expect_weight_of_centroid<3>(test::ball(2, 1));
  expect_weight_of_centroid<3>(cylinder<3>());
}

/// The work of a body force is density times displacement times acceleration, compared with an
/// independent quadrature. This holds at corners, too, where the masses of the time step are
/// raised.
TEST(BodyForce, ActsOnTheIntegralsOfTheDensity) {
  const auto body = test::body_of<3>(test::brick<3>({4, 4, 4}));
  test::internal_force<3>(*body, "neo_hookean");
  const auto term =
      body_force<3>(*body, body->mass_integral, {Expression(0), Expression(0), Expression(-1)});
  const NodalVectors force = test::force_of(*term, NodalVectors(body->mass.size(), Lanes::zero()));
  const auto points = cell_gauss_points(body->geometry.grid, 6);
  const auto rows = build_point_rows<3>(body->particles, points.X, {.value = true}, "points");
  std::vector<Real> integral(body->mass.size(), 0.0);
  for (Index q = 0; q < rows.size(); ++q)
    for (Offset e = at(rows.start, q); e < at(rows.start, q + 1); ++e)
      at(integral, at(rows.particle, e)) += 1.25 * at(points.weight, q) * at(rows.value, e);
  Real load = 0, step = 0;
  for (Index A = 0; A < body->size(); ++A) {
    load = std::max(load, std::abs(at(force, A)[2] + at(integral, A)));
    step = std::max(step, std::abs(at(body->mass, A) - at(integral, A)));
  }
  EXPECT_LT(load, 0.01);
  EXPECT_GT(step, 0.1);
}

}  // namespace
}  // namespace meniscus::test_balanced_surface_tension
