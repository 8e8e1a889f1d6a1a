// SPDX-License-Identifier: BSD-3-Clause
// Tractions, springs and viscosity of solids: states at rest to round-off, and exact solutions.
#include "body/particle_values.hpp"
#include "cases.hpp"
#include "kernel/row_sums.hpp"
#include "meniscus/error.hpp"
#include "run/simulation.hpp"
#include "support.hpp"
#include "thrown.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace meniscus::test_face_loads {
namespace {

std::string block(int D, const std::string& keys, const std::string& time = "end = 100",
                  const std::string& cells = "") {
  return "dimension = " + std::to_string(D) + "\n[time]\n" + time +
         "\n[[body]]\nname = \"block\"\n" +
         (!cells.empty() ? cells
          : D == 3       ? "shape = \"box\"\nsize = [1, 1, 1]\ncells = [5, 5, 5]\njitter = 0.3\n"
                         : "shape = \"rectangle\"\nsize = [1, 1]\ncells = [8, 8]\njitter = 0.3\n") +
         keys + "material = { type = \"neo_hookean\", density = 1, mu = 1, lambda = 1.5 }\n";
}

template <int D>
Real measured(const Scene<D>& scene, const State& state, const std::string& name) {
  for (const MeasureSource& measure : scene.measures)
    if (measure.name == name) return measure.compute(state.motion());
  ADD_FAILURE() << "no measure " << name;
  return 0;
}

template <int D>
void expect_rest(const std::string& text) {
  Scene<D> scene = test::scene_of<D>(text);
  Simulation<D> simulation(scene);
  simulation.begin();
  Real most = 0;
  for (const Lanes& f : simulation.state().force) most = std::max(most, std::sqrt(sum(f * f)));
  EXPECT_LT(most, 1e-13);
  for (int step = 0; step < 20; ++step) simulation.advance();
  const NodalVectors moved = test::sum_of(simulation.state().u, -1, scene.initial.u);
  for (const Lanes& u : moved) most = std::max(most, std::sqrt(sum(u * u)));
  EXPECT_LT(most, 1e-12);
}

/// Pressure that scales a body by the factor s < 1: P = mu (F - F^-T) + lambda (J - 1) cof F with F
/// = s I.
Real pressure_of_size(int D, Real s) {
  constexpr Real mu = 1, lambda = 1.5;
  return -(mu * (s - 1 / s) / std::pow(s, D - 1) + lambda * (std::pow(s, D) - 1));
}

/// Puts that pressure on the whole surface of a body and finds its equilibrium by newton. Returns
/// the root mean square distance of the particles from s X.
template <int D>
Real error_of_size(const std::string& shape) {
  constexpr Real s = 0.9;
  Scene<D> scene = test::scene_of<D>(
      block(D, "", "end = 1\nsolver = \"newton\"\nstep = 0.5", shape) +
      fmt::format("[[traction]]\nbody = \"block\"\nwhere = 1\npressure = {:.17g}\nramp = [0, 1]\n",
                  pressure_of_size(D, s)));
  Simulation<D> simulation(scene);
  simulation.begin();
  while (!simulation.finished()) simulation.advance();
  const Body<D>& body = scene.system.bodies.front();
  const NodalVectors u = values_at_particles(body, simulation.state().u.data());
  Real square = 0;
  for (Index A = 0; A < body.size(); ++A) {
    const Vec<D>& X = at(body.particles.X(), A);
    square += (vector_at<D>(u, A) + (1 - s) * X).squaredNorm();
  }
  return std::sqrt(square / body.size());
}

/// A pressure all around makes bodies smaller without bending them.
TEST(Traction, PressureAllAroundCompressesEvenly) {
  EXPECT_LT(error_of_size<2>(""), 3e-4);
  EXPECT_LT(error_of_size<2>("shape = \"disk\"\nradius = 1\ncore = 4\nrings = 2\n"), 2e-4);
  EXPECT_LT(error_of_size<2>("shape = \"disk\"\nradius = 1\ncore = 8\nrings = 4\n"), 5e-5);
  EXPECT_LT(error_of_size<3>("shape = \"ball\"\nradius = 1\ncore = 4\nlayers = 2\n"), 8e-4);
}

/// The force is minus the gradient of the potential, at any displacement `u`.
template <int D>
void expect_gradient(ForceTerm& term, const NodalVectors& u) {
  const NodalVectors w = test::random_field<D>(static_cast<Index>(u.size()), 1, 4),
                     rest = test::zeros(u), force = test::force_of(term, u);
  const auto potential = [&](Real h) {
    const NodalVectors moved = test::sum_of(u, h, w);
    return term.potential({0, moved, rest}).value();
  };
  // The volume is a polynomial of third degree.
  constexpr Real h = 0.01;
  const Real slope =
      (8 * (potential(h) - potential(-h)) - (potential(2 * h) - potential(-2 * h))) / (12 * h);
  EXPECT_NEAR(slope, -test::dot(force, w), 1e-11);
  EXPECT_NEAR(term.load_power({0, u, w}), test::dot(force, w), 1e-13);
  NodalVectors tangent = rest;
  term.add_tangent({0, u, rest}, {0, w, rest}, tangent);
  const NodalVectors change = test::sum_of(test::force_of(term, test::sum_of(u, h, w)), -1,
                                           test::force_of(term, test::sum_of(u, -h, w)));
  EXPECT_LT(test::norm(test::sum_of(change, -2 * h, tangent)), 1e-12);
}

/// A uniform pressure on the whole surface of a deformed body has no net force and no net moment,
/// and is the gradient of p times the enclosed volume.
template <int D>
void expect_even_pressure_balanced(const std::string& shape) {
  Scene<D> scene = test::scene_of<D>(block(D, "", "end = 100", shape) +
                                     "[[traction]]\nbody = \"block\"\nwhere = 1\npressure = 0.7\n");
  ForceTerm& term = *scene.system.terms.back();
  const Body<D>& body = scene.system.bodies.front();
  const NodalVectors u = test::random_field<D>(body.size(), 0.02, 3);
  const NodalVectors force = test::force_of(term, u);
  const auto balance = test::balance_of(body, u, force);
  EXPECT_LT(balance.force, 1e-14);
  EXPECT_LT(balance.torque, 1e-14);
  EXPECT_EQ(test::report_of(term, u).outside.force_size, 0);
  expect_gradient<D>(term, u);
}
TEST(Traction, EvenPressureOnAClosedFaceIsTheGradientOfTheVolume) {
  expect_even_pressure_balanced<2>("");
  expect_even_pressure_balanced<3>("");
  expect_even_pressure_balanced<2>("shape = \"disk\"\nradius = 1\ncore = 4\nrings = 2\n");
  expect_even_pressure_balanced<3>("shape = \"ball\"\nradius = 1\ncore = 2\nlayers = 2\n");
}

std::string held(const std::string& face, const std::string& components) {
  return fmt::format("[[held]]\nbody = \"block\"\nface = \"{}\"\ncomponents = [{}]\n", face,
                     components);
}
template <int D>
std::unique_ptr<Scene<D>> pushed(const std::string& held_faces, const std::string& more = "") {
  return std::make_unique<Scene<D>>(test::scene_of<D>(
      block(D, "") + held_faces +
      "[[traction]]\nbody = \"block\"\nface = \"x_max\"\npressure = 0.7\n" + more));
}
/// Whether newton finds a potential.
template <int D>
bool has_potential(Scene<D>& scene) {
  const NodalVectors rest(static_cast<std::size_t>(scene.system.size()), Lanes::zero());
  return scene.system.terms.back()->potential({0, rest, rest}).has_value();
}

/// An edge that is held on planes, in all directions or normal to them: the force is a gradient
/// also where the places of the edge, which is held in the mean only, leave the planes. Where they
/// do not, the force is that of a face whose edge is free.
template <int D>
void expect_gradient_of_held_edge(const std::string& held_faces, Real along = 0) {
  const auto with = pushed<D>(held_faces), without = pushed<D>("");
  ForceTerm &term = *with->system.terms.back(), &free_edge = *without->system.terms.back();
  const NodalVectors u = test::random_field<D>(with->system.size(), 0.02, 3);
  expect_gradient<D>(term, u);
  EXPECT_GT(test::report_of(term, u).outside.force_size, 0.1);
  const NodalVectors in_planes = test::field_on<D>(
      with->system.bodies.front(),
      [&](const Vec<D>& X) { return Vec<D>(along * (X[0] + 2 * X[1]) * Vec<D>::Unit(0)); });
  const NodalVectors force = test::force_of(term, in_planes),
                     other = test::force_of(free_edge, in_planes);
  EXPECT_LT(test::norm(test::sum_of(force, -1, other)), 1e-14);
}
TEST(Traction, EvenPressureBetweenHeldEdgesIsAGradient) {
  expect_gradient_of_held_edge<2>(held("y_min", "") + held("y_max", ""));
  expect_gradient_of_held_edge<2>(held("y_min", "") + held("y_max", "\"y\""));
  expect_gradient_of_held_edge<2>(held("y_min", "\"normal\"") + held("y_max", "\"y\""), 0.1);
  expect_gradient_of_held_edge<3>(held("y_min", "") + held("y_max", "\"y\"") +
                                  held("z_min", "\"z\"") + held("z_max", "\"z\""));
  expect_gradient_of_held_edge<3>(held("y_min", "\"y\"") + held("y_max", "\"y\"") +
                                      held("z_min", "\"z\"") + held("z_max", "\"z\""),
                                  0.1);
  expect_gradient_of_held_edge<3>(held("y_min", "") + held("y_max", "") + held("z_min", "") +
                                  held("z_max", ""));
}

/// An edge that can leave its place, by a free end or a displacement.
TEST(Traction, EvenPressureWithAFreeEdgeIsNone) {
  const std::string low = held("y_min", ""), high = held("y_max", "");
  EXPECT_TRUE(has_potential(*pushed<2>(low + high)));
  EXPECT_TRUE(has_potential(*pushed<2>(low + held("y_max", "\"x\"")))) << "slides along the face";
  EXPECT_FALSE(has_potential(*pushed<2>(low)));
  EXPECT_FALSE(has_potential(*pushed<2>(low + high + "displacement = [0, \"0.1*t\"]\n")));
  EXPECT_FALSE(has_potential(*pushed<2>(low + high + "displacement = [0, 0.1]\n")));
  // A face that ends in the middle of others.
  EXPECT_FALSE(has_potential(*pushed<2>(low + high, "where = \"y < 0.05\"\n")));
  EXPECT_FALSE(has_potential(*pushed<3>(low + high)));
}

/// The net force of a uniform pressure on an open face depends on the edge of the face only: - p/2
/// oint x cross dx along quadratic curves through the current positions of corners and middles of
/// edges. In 2D it depends on the ends of the face.
TEST(Traction, EvenPressureOnAnOpenFaceIsThatOfItsEdge) {
  constexpr Real p = 0.7;
  const std::string load = "[[traction]]\nbody = \"block\"\nface = \"x_max\"\npressure = 0.7\n";
  {
    Scene<2> scene = test::scene_of<2>(block(2, "") + load);
    const Body<2>& body = scene.system.bodies.front();
    const NodalVectors u = test::random_field<2>(body.size(), 0.02, 3);
    const std::vector<Vec<2>> X{{0.5, -0.5}, {0.5, 0.5}};
    const auto rows = build_point_rows<2>(body.particles, X, {.value = true}, "ends");
    const Lanes chord =
        Lanes(0, 1, 0, 0) + value_at(rows, 1, u.data()) - value_at(rows, 0, u.data());
    const Report report = test::report_of(*scene.system.terms.back(), u);
    EXPECT_NEAR(report.outside.force[0], -p * chord[1], 1e-14);
    EXPECT_NEAR(report.outside.force[1], p * chord[0], 1e-14);
  }
  Scene<3> scene = test::scene_of<3>(block(3, "") + load);
  const Body<3>& body = scene.system.bodies.front();
  const NodalVectors u = test::random_field<3>(body.size(), 0.02, 3);
  constexpr int n = 10;  // half edges of each side
  std::vector<Vec<3>> X;
  const Vec<3> corner[] = {{0.5, -0.5, -0.5}, {0.5, 0.5, -0.5}, {0.5, 0.5, 0.5}, {0.5, -0.5, 0.5}};
  for (int side = 0; side < 4; ++side)
    for (int k = 0; k < n; ++k)
      X.push_back(corner[side] + (corner[(side + 1) % 4] - corner[side]) * k / n);
  const auto rows = build_point_rows<3>(body.particles, X, {.value = true}, "edge");
  std::vector<Vec<3>> x;
  for (Index q = 0; q < rows.size(); ++q) {
    const Lanes moved = value_at(rows, q, u.data());
    x.push_back(at(X, q) + Vec<3>(moved[0], moved[1], moved[2]));
  }
  Vec<3> area = Vec<3>::Zero();
  for (std::size_t k = 0; k < x.size(); k += 2) {  // per edge: 4/3, -1/3, 4/3 of a x b / 2
    const Vec<3>&a = x[k], &b = x[k + 1], &c = x[(k + 2) % x.size()];
    area += 0.5 * (4.0 / 3 * a.cross(b) - 1.0 / 3 * a.cross(c) + 4.0 / 3 * b.cross(c));
  }
  const Report report = test::report_of(*scene.system.terms.back(), u);
  EXPECT_LT((report.outside.force + p * area).norm(), 1e-14);
  // The sum of the forces equals the reported net force.
  const NodalVectors force = test::force_of(*scene.system.terms.back(), u);
  Vec<3> net = Vec<3>::Zero();
  for (const Lanes& f : force) net += Vec<3>(f[0], f[1], f[2]);
  EXPECT_LT((net - report.outside.force).norm(), 1e-14);
}

/// A column with Poisson's ratio 0 sinks by rho g H^2/(2 E) under its weight, and the weight does
/// the work rho^2 g^2 A H^3/(3 E). The masses of the time step at the corners are raised.
TEST(BodyForce, AColumnSinksUnderItsWeight) {
  Scene<2> scene = test::scene_of<2>(
      "dimension = 2\n[time]\nsolver = \"newton\"\nend = 1\nstep = 1\n[[body]]\nname = "
      "\"column\"\nshape = \"rectangle\"\nsize = [0.5, 1]\nspacing = 0.1\nmaterial = { type = "
      "\"st_venant_kirchhoff\", density = 1, mu = 5000, lambda = 0 }\n[[held]]\nbody = "
      "\"column\"\nface = \"y_min\"\n[[body_force]]\nbody = \"column\"\nacceleration = [0, -1]\n");
  Simulation<2> simulation(scene);
  simulation.begin();
  while (!simulation.finished()) simulation.advance();
  const State& state = simulation.state();
  const Real sag = 1 - measured(scene, state, "column.extent_y");
  EXPECT_NEAR(sag, 5e-5, 1e-3 * 5e-5);
  EXPECT_NEAR(state.books.external_work, 0.5 / 3e4, 1e-3 * 0.5 / 3e4);
}

/// Dead tractions on all four sides balance a uniform stress of simple shear.
TEST(Traction, DeadForcesBalanceAUniformStress) {
  // F = [1.2 0.3; 0 1], J = 1.2, cof F = [1 0; -0.3 1.2]
  constexpr Real mu = 1, lambda = 1.5, J = 1.2, c = lambda * (J - 1) - mu / J;
  const Real P[2][2] = {{mu * 1.2 + c, mu * 0.3}, {-0.3 * c, mu + 1.2 * c}};
  std::string text = block(2, "initial_displacement = [\"0.2*x + 0.3*y\", 0]\n");
  for (const auto& [face, k, sign] :
       {std::tuple("x_min", 0, -1), {"x_max", 0, 1}, {"y_min", 1, -1}, {"y_max", 1, 1}})
    text +=
        fmt::format("[[traction]]\nbody = \"block\"\nface = \"{}\"\nforce = [{:.17g}, {:.17g}]\n",
                    face, sign * P[0][k], sign * P[1][k]);
  expect_rest<2>(text);
}

/// The force is minus the gradient of the potential, and the work of a dead load is the change of
/// the potential.
TEST(Traction, DeadForcesHaveAPotential) {
  Scene<3> scene = test::scene_of<3>(
      block(3, "") +
      "[[traction]]\nbody = \"block\"\nface = \"x_max\"\nforce = [\"1 + y\", \"z\", 0.3]\n");
  ForceTerm& term = *scene.system.terms.back();
  const NodalVectors u = test::random_field<3>(scene.system.size(), 0.01, 5);
  const NodalVectors force = test::force_of(term, u);
  EXPECT_NEAR(*term.potential({0, u, u}), -test::dot(force, u), 1e-14);
  EXPECT_NEAR(term.load_power({0, u, u}), test::dot(force, u), 1e-14);
  EXPECT_NEAR(measured(scene, scene.initial, "block-x_max-traction.force_x"), 1, 1e-12);
}

/// A stiff block on a soft spring moves for half a period.
TEST(Spring, ABlockSwings) {
  constexpr Real k = 1e-3;
  for (const std::string on : {"face = \"x_min\"\nstiffness = 1e-3\ncomponents = [\"x\"]\n",
                               "at = [0, 0]\nconstant = 1e-3\n"}) {
    Scene<2> scene =
        test::scene_of<2>(block(2, "initial_displacement = [0.1, 0]\n",
                                fmt::format("end = {:.17g}", std::numbers::pi / std::sqrt(k))) +
                          "[[spring]]\nname = \"spring\"\nbody = \"block\"\n" + on);
    Simulation<2> simulation(scene);
    simulation.begin();
    while (!simulation.finished()) simulation.advance();
    const State& state = simulation.state();
    EXPECT_NEAR(take_ledger(scene.system, state).balance(), k / 200, 1e-4 * k / 200);
    EXPECT_NEAR(measured(scene, state, "spring.force_x"), 0.1 * k, 1e-2 * 0.1 * k);
  }
}

/// The velocity obeys c = -m v'/v; the heat is the loss of kinetic energy.
TEST(Spring, ADamperStopsABlock) {
  Scene<2> scene = test::scene_of<2>(
      block(2, "initial_velocity = [0.01, 0]\n", "end = 10") +
      "[[spring]]\nbody = \"block\"\nface = \"x_min\"\ndamping = 0.01\ncomponents = [\"x\"]\n");
  Simulation<2> simulation(scene);
  simulation.begin();
  while (!simulation.finished()) simulation.advance();
  const Ledger ledger = take_ledger(scene.system, simulation.state());
  EXPECT_NEAR(ledger.momentum[0], 0.01 * std::exp(-0.1), 2e-5);
  EXPECT_NEAR(ledger.balance(), 0.5e-4, 1e-8);
}

/// The slowest wave along a bar between rollers decays by exp(-(2 eta + zeta) k^2 t/(2 rho)).
TEST(SolidViscosity, WavesDecay) {
  const std::string rollers =
      "[[held]]\nbody = \"block\"\nface = \"y_min\"\ncomponents = [\"y\"]\n"
      "[[held]]\nbody = \"block\"\nface = \"y_max\"\ncomponents = [\"y\"]\n";
  constexpr Real k = std::numbers::pi, eta = 0.02, zeta = 0.01;
  const Real decay = (2 * eta + zeta) * k * k, omega = std::sqrt(3.5 * k * k - decay * decay / 4);
  const Real period = 2 * std::numbers::pi / omega, periods = 2;
  Scene<2> scene = test::scene_of<2>(
      block(2, "initial_velocity = [\"1e-3*sin(pi*x)\", 0]\n",
            fmt::format("end = {:.17g}", periods * period),
            "shape = \"rectangle\"\nsize = [1, 0.25]\ncells = [16, 4]\n") +
      rollers +
      fmt::format("[[solid_viscosity]]\nbody = \"block\"\nshear = {}\nvolumetric = {}\n", eta,
                  zeta));
  Simulation<2> simulation(scene);
  simulation.begin();
  const Real begin = take_ledger(scene.system, simulation.state()).kinetic;
  while (!simulation.finished()) simulation.advance();
  const Ledger ledger = take_ledger(scene.system, simulation.state());
  const Real left = ledger.kinetic + ledger.stored.at("strain");
  EXPECT_NEAR(std::log(begin / left) / (decay * periods * period), 1, 0.02);
  EXPECT_NEAR(ledger.balance(), begin, 2e-3 * begin);
}

/// Rate at which the energy of a bar held at x = 0 decays. The bar starts with v = sin(pi x/2 L),
/// its slowest wave, and rings for 7 periods. The rate is minus the slope of a line fitted to
/// ln(kinetic + strain). This function of time is wavy, since the decay is fastest when the bar is
/// fastest.
template <int D>
Real rate_of_decay(const std::string& shape, Real length, Real modulus, const std::string& more,
                   const std::string& viscosity) {
  const Real end = 7 * 4 * length / std::sqrt(modulus);
  Scene<D> scene = test::scene_of<D>(
      "dimension = " + std::to_string(D) + fmt::format("\n[time]\nend = {:.17g}\n", end) +
      "[[body]]\nname = \"block\"\n" + shape +
      fmt::format("initial_velocity = [\"1e-4*sin(pi*x/{})\", 0{}]\n", 2 * length,
                  D == 3 ? ", 0" : "") +
      "material = { type = \"neo_hookean\", density = 1, mu = 1, lambda = 1.5" + viscosity +
      "[[held]]\nbody = \"block\"\nface = \"x_min\"\ncomponents = [\"x\"]\n" + more);
  Simulation<D> simulation(scene);
  simulation.begin();
  const Real first = take_ledger(scene.system, simulation.state()).kinetic;
  Real n = 0, t = 0, tt = 0, y = 0, ty = 0;
  while (!simulation.finished()) {
    simulation.advance();
    const Ledger now = take_ledger(scene.system, simulation.state());
    const Real time = simulation.state().time,
               left = std::log((now.kinetic + now.stored.at("strain")) / first);
    n += 1, t += time, tt += time * time, y += left, ty += time * left;
    EXPECT_NEAR(now.balance() / first, 1, 2e-3);
  }
  return -(n * ty - t * y) / (n * tt - t * t);
}

/// The decay of a ringing bar in 7 periods, compared with c k^2/rho. Viscosity changes the modulus
/// M of the bar to M + c d/dt. Between rollers, M = lambda + 2 mu and c = 2 eta + zeta. With free
/// sides, c = eta dM/dmu + zeta dM/dlambda; in plane strain M = 4 mu (lambda + mu)/(lambda + 2 mu),
/// and in 3D M = E = mu (3 lambda + 2 mu)/(lambda + mu). The elastic constants alone determine the
/// contraction of the bar. So c is 2.36 eta here, not 2 (1 + nu) eta = 2.6 eta.
TEST(SolidViscosity, ABarRingsWithItsExactDecrement) {
  constexpr Real k = std::numbers::pi / 2, M = 20.0 / 7;
  const std::string between_rollers =
      "[[held]]\nbody = \"block\"\nface = \"y_min\"\ncomponents = [\"y\"]\n"
      "[[held]]\nbody = \"block\"\nface = \"y_max\"\ncomponents = [\"y\"]\n";
  const Real strip = rate_of_decay<2>(
      "shape = \"rectangle\"\nsize = [1, 0.25]\ncorner = [0, 0]\ncells = [16, 4]\n", 1, 3.5,
      between_rollers,
      " }\n[[solid_viscosity]]\nbody = \"block\"\nshear = 0.005\nvolumetric = 0.0025\n");
  EXPECT_NEAR(strip / (0.0125 * k * k), 1, 0.003);

  const Real plane = rate_of_decay<2>(
      "shape = \"rectangle\"\nsize = [4, 0.25]\ncorner = [0, 0]\ncells = [32, 2]\n", 4, M, "",
      ", viscosity = 0.02 }\n");
  EXPECT_NEAR(plane / (29 / 12.25 * 0.02 * k * k / 16), 1, 0.003);

  const Real bar = rate_of_decay<3>(
      "shape = \"box\"\nsize = [4, 0.25, 0.25]\ncorner = [0, 0, 0]\ncells = [32, 2, 2]\n", 4, 2.6,
      "", ", viscosity = 0.02 }\n");
  EXPECT_NEAR(bar / (2.36 * 0.02 * k * k / 16), 1,
              0.015);  // as in 2D, two cells across
}

TEST(SolidViscosity, IsAnOptionOfEveryMaterialThatIsNoFluid) {
  const auto rate = [](const std::string& viscosity) {
    return rate_of_decay<2>(
        "shape = \"rectangle\"\nsize = [1, 0.25]\ncorner = [0, 0]\ncells = [8, 2]\n", 1, 3.5, "",
        viscosity);
  };
  const Real damped = rate(", viscosity = 0.02 }\n");
  EXPECT_GT(damped, 0.05);
  EXPECT_NEAR(damped, rate(" }\n[[solid_viscosity]]\nbody = \"block\"\nshear = 0.02\n"), 1e-12);
  EXPECT_THROW_WITH(rate(", viscosity = -1 }\n"), InputError, "viscosity");
}

/// A strip between rollers whose end is moved: a plane wave of constant form. Until the wave
/// returns, the force on the grip is rho c times its velocity. Returns the largest error of this
/// force after the first steps, relative to the largest force.
Real error_of_a_wave(int cells) {
  const Real c = std::sqrt(3.5), end = 3.2 / c;
  Scene<2> scene = test::scene_of<2>(
      block(2, "", fmt::format("end = {:.17g}", end),
            fmt::format("shape = \"rectangle\"\nsize = [2, 0.25]\ncells = [{}, {}]\n", cells,
                        cells / 8)) +
      "[[held]]\nbody = \"block\"\nface = \"y_min\"\ncomponents = [\"y\"]\n"
      "[[held]]\nbody = \"block\"\nface = \"y_max\"\ncomponents = [\"y\"]\n"
      "[[held]]\nname = \"grip\"\nbody = \"block\"\nface = \"x_min\"\ncomponents = "
      "[\"x\"]\ndisplacement = [\"1e-5*sin(4*t)^2\", 0]\n");
  Simulation<2> simulation(scene);
  simulation.begin();
  const Real scale = c * 0.25 * 4e-5;
  Real worst = 0;
  while (!simulation.finished()) {
    simulation.advance();
    const State& state = simulation.state();
    if (state.time < 0.1) continue;
    const Real exact = scale * std::sin(8 * state.time);
    worst = std::max(worst, std::abs(measured(scene, state, "grip.force_x") - exact) / scale);
  }
  return worst;
}

TEST(Held, AGripSendsAWave) {
  const Real coarse = error_of_a_wave(64), fine = error_of_a_wave(128);
  EXPECT_LT(fine, 0.01);
  EXPECT_LT(fine, 0.4 * coarse);
}

TEST(FaceLoads, WhatMakesNoLoadIsRefused) {
  const auto expect = [](const std::string& more, const std::string& part) {
    std::string message;
    try {
      test::scene_of<2>(block(2, "") + more);
    } catch (const InputError& e) {
      message = e.what();
    }
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  const std::string on = "body = \"block\"\nface = \"x_min\"\n";
  expect("[[traction]]\n" + on, "allowed is one of force, total and pressure");
  expect("[[traction]]\n" + on + "pressure = 1\nforce = [1, 0]\n",
         "allowed is one of force, total and pressure");
  expect("[[spring]]\n" + on, "stiffness or damping has to be > 0");
  expect("[[spring]]\n" + on + "constant = 1\n", "is of a spring at a place");
  expect("[[spring]]\nbody = \"block\"\nat = [0, 0, 0]\nconstant = 1\n", "allowed are 2");
  expect("[[solid_viscosity]]\nbody = \"block\"\nshear = 0\n", "allowed is > 0");
}

}  // namespace
}  // namespace meniscus::test_face_loads
