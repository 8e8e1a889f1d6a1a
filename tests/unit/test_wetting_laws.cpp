// SPDX-License-Identifier: BSD-3-Clause
// Wetting in motion: energies and forces of varying adhesion, cycles, friction, reactions.
#include "cases.hpp"
#include "io_helpers.hpp"
#include "meniscus/error.hpp"
#include "run/simulation.hpp"
#include "support.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace meniscus::test_wetting_laws {
namespace {

/// A drop of radius 1 under tension, its lowest point 0.1 above a wall, and a contact 'wall' with
/// these lines.
template <int D>
std::string on_wall_text(const std::string& lines, const std::string& partner = {},
                         const std::string& time = "end = 1e3") {
  const std::string half_space =
      D == 3 ? "type = \"half_space\"\npoint = [0, 0, -1.1]\nnormal = [0, 0, 1]\n"
             : "type = \"half_space\"\npoint = [0, -1.1]\nnormal = [0, 1]\n";
  return "dimension = " + std::to_string(D) + "\n[time]\n" + time + "\n" + test::one_drop(D) +
         "[[surface_tension]]\nbody = \"drop\"\ngamma = 1\n"
         "[[contact]]\nname = \"wall\"\nbodies = [\"drop\"]\n" +
         lines + "[contact.partner]\n" + (partner.empty() ? half_space : partner);
}
template <int D>
Scene<D> on_wall(const std::string& lines, const std::string& partner = {},
                 const std::string& time = "end = 1e3") {
  return test::scene_of<D>(on_wall_text<D>(lines, partner, time));
}

template <int D>
ForceTerm& contact_of(Scene<D>& scene) {
  return *scene.system.terms.back();
}
template <int D>
Real measure(const Scene<D>& scene, const std::string& name, const Motion& motion) {
  for (const MeasureSource& source : scene.measures)
    if (source.name == name) return source.compute(motion);
  throw std::logic_error("no measure " + name);
}
template <int D>
Vec<D> net(const NodalVectors& force) {
  Vec<D> sum = Vec<D>::Zero();
  for (std::size_t A = 0; A < force.size(); ++A)
    for (int i = 0; i < D; ++i) sum[i] += force[A][i];
  return sum;
}

const std::string young = "interaction = \"smooth_young\"\noffset = 0.05\nrange = 0.25\n";
const std::string varied =
    young + "adhesion = \"0.8 + 0.2*x*z + 0.3*sin(2*y + t)\"\nactin = \"0.1*x^2 + 0.05*t\"\n";
const std::string varied_in_plane =
    young + "adhesion = \"0.8 + 0.2*x + 0.3*sin(2*y + t)\"\nactin = \"0.1*x^2 + 0.05*t\"\n";
/// A contact in which the lowest points lie in the core.
const std::string varied_in_core =
    "interaction = \"smooth_young\"\noffset = 0.16\nrange = 0.25\n"
    "adhesion = \"0.8 + 0.2*x*z + 0.3*sin(2*y + t)\"\n";
const std::string varied_in_core_of_plane =
    "interaction = \"smooth_young\"\noffset = 0.16\nrange = 0.25\nadhesion = \"0.8 + 0.2*x\"\n";
const std::string moving_ball =
    "type = \"ball\"\nradius = 0.7\ncentre = [0.1, 0.2, -1.75]\n"
    "displacement = [\"0.03 + 0.1*t\", \"0.05*sin(t + 0.5)\", \"0.02*t\"]\n";
const std::string moving_disk =
    "type = \"ball\"\nradius = 0.7\ncentre = [0.2, -1.75]\ndisplacement = [\"0.1*t\", "
    "\"0.02*t\"]\n";

template <int D>
void expect_gradient(const std::string& lines, const std::string& partner) {
  Scene<D> scene = on_wall<D>(lines, partner);
  ForceTerm& term = contact_of(scene);
  for (const unsigned seed : {1u, 2u, 3u}) {
    const NodalVectors u = test::random_field<D>(scene.system.size(), 0.03, seed),
                       way = test::random_field<D>(scene.system.size(), 1, seed + 10);
    EXPECT_LT(test::gradient_error(term, u, way, 1e-4), 1e-7) << lines << partner;
  }
}

TEST(WettingLaws, ForcesAreTheGradientOfTheEnergy) {
  for (const std::string& lines :
       {young + "contact_angle = 60\n", young + "contact_angle = \"60 + 20*x - 5*y^2\"\n", varied,
        varied_in_core,
        std::string("interaction = \"scaled_lennard_jones\"\ncontact_angle = 75\nsigma0 = 0.15\n")})
    for (const std::string& partner : {std::string(), moving_ball})
      expect_gradient<3>(lines, partner);
  for (const std::string& partner : {std::string(), moving_disk})
    expect_gradient<2>(varied_in_plane, partner);
}

/// Two drops and a contact 'wall' between them with these lines.
template <int D>
Scene<D> between_drops(const std::string& lines) {
  return test::scene_of<D>(
      "dimension = " + std::to_string(D) + "\n[time]\nend = 1\n" + test::two_drops(D) +
      "[[surface_tension]]\nbody = \"drop\"\ngamma = 1\n[[contact]]\nname = \"wall\"\nbodies = "
      "[\"drop\", \"other\"]\nskin = 10\n" +
      lines);
}

const std::string growing = "adhesion = \"0.8 + 0.3*sin(2*t)\"\nactin = \"t > 0.3 ? 0.5 : 0\"\n";

TEST(WettingLaws, ForcesBetweenBodiesOnPatchesAreTheGradientToo) {
  for (const std::string& lines :
       {"adhesion = 1\n" + young, growing + young,
        growing + "interaction = \"smooth_young\"\noffset = 0.16\nrange = 0.25\n"}) {
    Scene<3> scene = between_drops<3>(lines);
    ForceTerm& term = contact_of(scene);
    for (const unsigned seed : {1u, 2u}) {
      const NodalVectors u = test::random_field<3>(scene.system.size(), 0.02, seed),
                         way = test::random_field<3>(scene.system.size(), 1, seed + 10);
      EXPECT_LT(test::gradient_error(term, u, way, 5e-5), 1e-7);
      const NodalVectors force = test::force_of(term, u);
      EXPECT_LT(net<3>(force).norm(), 1e-12 * test::norm(force));
    }
  }
}

/// A half ball above a layer, with these lines of the contact 'wall' between them.
template <int D>
Scene<D> on_ground(const std::string& lines) {
  const bool space = D == 3;
  return test::scene_of<D>(
      "dimension = " + std::to_string(D) +
      "\n[time]\nend = 1\n[[body]]\nname = \"drop\"\nshape = \"" +
      (space ? "half_sphere\"\nradius = 1\ncore = 4\nlayers = 2\ncentre = [0.1, 0, 0.1]\n"
             : "half_disk\"\nradius = 1\ncore = 6\nrings = 3\ncentre = [0.1, 0.1]\n") +
      "material = { type = \"newtonian\", density = 1, bulk_modulus = 100, viscosity = 1 }\n"
      "[[surface_tension]]\nbody = \"drop\"\ngamma = 1\n[[body]]\nname = \"layer\"\n" +
      (space ? "shape = \"cylinder\"\nradius = 1.5\nheight = 0.6\ncore = 4\nrings = 2\nlayers = 3\n"
               "centre = [0, 0, -0.3]\n"
             : "shape = \"rectangle\"\nsize = [3, 0.6]\ncorner = [-1.5, -0.6]\nspacing = 0.21\n") +
      "material = { type = \"neo_hookean\", density = 1, mu = 1, lambda = 1 }\n"
      "[[contact]]\nname = \"wall\"\nbodies = [\"drop\", \"layer\"]\nskin = 10\n" +
      lines);
}

/// An adhesion that depends on the position in the reference of the ground, and on time.
std::string graded(int D) {
  return std::string("adhesion = \"0.8 + 0.5*sin(2*x + t) + 0.3*y") + (D == 3 ? "*z" : "") +
         "\"\nactin = \"t > 0.3 ? 0.5 : 0\"\n";
}

/// A drop on deformable ground: forces are balanced. Facets of the ground are found below the
/// points in any motion.
template <int D>
void expect_gradient_on_ground() {
  const std::string up = D == 3 ? "up = [0.1, 0, 1]\n" : "up = [0.1, 1]\n";
  for (const std::string& lines :
       {"adhesion = 0.7\n" + young, growing + young, growing + "offset = 0.16\nrange = 0.25\n",
        graded(D) + young, graded(D) + "offset = 0.16\nrange = 0.25\n"}) {
    Scene<D> scene = on_ground<D>(up + lines);
    ForceTerm& term = contact_of(scene);
    for (const unsigned seed : {1u, 2u}) {
      const NodalVectors u = test::random_field<D>(scene.system.size(), 0.03, seed),
                         way = test::random_field<D>(scene.system.size(), 1, seed + 10);
      EXPECT_LT(test::gradient_error(term, u, way, 1e-6), 1e-6);
      const NodalVectors force = test::force_of(term, u);
      EXPECT_GT(test::norm(force), 0.1);
      EXPECT_LT(net<D>(force).norm(), 1e-12 * test::norm(force));
    }
  }
}

TEST(SoftWetting, ForcesOnGroundAreTheGradientOfTheEnergy) {
  expect_gradient_on_ground<2>();
  expect_gradient_on_ground<3>();
}

/// Flat ground at rest acts on a drop like a rigid half space.
template <int D>
void expect_ground_like_a_plane(const std::string& adhesion) {
  const bool space = D == 3;
  const std::string law =
      adhesion + "actin = \"0.2 + t\"\noffset = 0.11\nrange = 0.25\npoints = 3\n";
  const Scene<D> scene = on_ground<D>(
      law + "up = " + (space ? "[0, 0, 1]\n" : "[0, 1]\n") +
      "[[contact]]\nname = \"plane\"\nbodies = [\"drop\"]\n" + law +
      "[contact.partner]\ntype = \"half_space\"\n" +
      (space ? "point = [0, 0, 0]\nnormal = [0, 0, 1]\n" : "point = [0, 0]\nnormal = [0, 1]\n"));
  const auto& terms = scene.system.terms;
  ForceTerm &soft = *terms[terms.size() - 2], &rigid = *terms.back();
  const Body<D>& drop = scene.system.bodies.front();
  NodalVectors u = test::random_field<D>(scene.system.size(), 0.02, 3);
  for (Index A = drop.size(); A < scene.system.size(); ++A) at(u, A) = Lanes::zero();
  EXPECT_LT(test::energy_of(rigid, u), -0.1);
  EXPECT_NEAR(test::energy_of(soft, u), test::energy_of(rigid, u), 1e-12);
  const NodalVectors f = test::force_of(soft, u), expected = test::force_of(rigid, u);
  for (Index A = 0; A < drop.size(); ++A)
    for (int i = 0; i < D; ++i) EXPECT_NEAR(at(f, A)[i], at(expected, A)[i], 1e-11);
  const Motion motion{0, u, test::zeros(u)};
  const Real area = measure(scene, "wall.wetted_area", motion);
  EXPECT_NEAR(measure(scene, "plane.wetted_area", motion), area, 1e-12 * area);
}

TEST(SoftWetting, FlatGroundIsLikeARigidPlane) {
  for (const std::string adhesion : {"adhesion = 0.7\n", "adhesion = \"0.8 + 0.4*x\"\n"}) {
    expect_ground_like_a_plane<2>(adhesion);
    expect_ground_like_a_plane<3>(adhesion);
  }
}

/// The run ends if a facet of the ground turns over.
TEST(SoftWetting, GroundThatFoldsOverIsAFailure) {
  const Scene<2> scene = on_ground<2>("up = [0, 1]\nadhesion = 0.7\n" + young);
  const Body<2>& layer = scene.system.bodies.back();
  NodalVectors u(scene.system.mass.size(), Lanes::zero()), force = u;
  const auto fold = [&](Real by) {
    for (Index A = 0; A < layer.size(); ++A)
      at(u, layer.first + A).set(0, by * std::sin(8 * layer.particles.X()[A][0]));
    return scene.system.terms.back()->add_force({0, u, test::zeros(u)}, force).failure;
  };
  EXPECT_FALSE(fold(0.05));
  const auto failure = fold(0.3);
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->cause.find("the surface of 'layer' folds over"), 0u) << failure->cause;
  EXPECT_GE(failure->particle, layer.first);
}

/// External work booked, and change of the energy, while all particles are held.
struct Supply {
  Real booked = 0, change = 0;
};
template <int D>
Supply supply(const Scene<D>& scene, Real step) {
  ForceTerm& term = *scene.system.terms.back();
  const NodalVectors u = test::random_field<D>(scene.system.size(), 0.03, 4), v = test::zeros(u);
  NodalVectors force = v;
  const auto energy = [&](Real time) { return *term.stored_energy({time, u, v}); };
  Supply supply;
  Real t = 0, before = term.add_force({0, u, v}, force).external_power;
  for (int k = 0; t < 0.5; ++k) {
    const Real dt = step * (1 + 0.3 * (k % 3));
    t += dt;
    const Report report = term.add_force({t, u, v}, force);
    supply.booked += report.external_work + dt / 2 * (before + report.external_power);
    before = report.external_power;
    term.commit({t, u, v});
  }
  supply.change = energy(t) - energy(0);
  return supply;
}

template <int D>
Supply supply(const std::string& lines, const std::string& partner, Real step) {
  return supply(on_wall<D>(lines, partner, "end = 1"), step);
}

TEST(WettingLaws, WhatChangesWithTimeIsExternalWork) {
  const Supply space = supply<3>(varied, {}, 0.03), plane = supply<2>(varied_in_plane, {}, 0.03);
  EXPECT_GT(std::abs(space.change), 0.01);
  EXPECT_NEAR(space.booked, space.change, 1e-12);
  EXPECT_NEAR(plane.booked, plane.change, 1e-12);
  for (const std::string& lines : {varied, varied_in_core})
    for (const Real step : {0.02, 0.01}) {
      const Supply moved = supply<3>(lines, moving_ball, step);
      EXPECT_GT(std::abs(moved.change), 0.01);
      EXPECT_NEAR(moved.booked, moved.change, 20 * step * step * std::abs(moved.change));
    }
}

TEST(WettingLaws, WorkOfAdhesionThatJumpsIsBooked) {
  const std::string jump = young + "adhesion = \"0.5 + (t > 0.3 ? 0.7 : 0)\"\n";
  for (const Real step : {0.02, 0.037}) {
    const Supply all = supply<2>(jump, {}, step);
    EXPECT_GT(std::abs(all.change), 0.1);
    EXPECT_NEAR(all.booked, all.change, 1e-12);
  }
}

/// The core is as strong as the tension of the drop, at any adhesion.
TEST(WettingLaws, TheCoreIsOneWhereHardlyAnythingAdheres) {
  const auto push = [](const std::string& adhesion) {
    Scene<3> scene = on_wall<3>("adhesion = " + adhesion + "\n" + young);
    NodalVectors u(static_cast<std::size_t>(scene.system.size()), Lanes(0.0, 0.0, -0.08, 0.0));
    const NodalVectors v = test::zeros(u);
    NodalVectors force = v;
    contact_of(scene).add_force({0, u, v}, force);
    return net<3>(force)[2];
  };
  const Real weak = push("0.001");
  EXPECT_GT(weak, 1);
  // With varying adhesion the core is twice as stiff.
  EXPECT_NEAR(weak, push("\"0.001*exp(-t)\"") / 2, 1e-2 * weak);
}

/// Two drops that hardly adhere are pressed together. The core, with the tensions of both, keeps
/// them apart.
TEST(WettingLaws, TheCoreBetweenTwoDropsBearsWhatPressesThem) {
  Scene<2> scene =
      between_drops<2>(young +
                       "adhesion = 0.01\n[[body_force]]\nbody = \"drop\"\nacceleration = [0.5, 0]\n"
                       "[[body_force]]\nbody = \"other\"\nacceleration = [-0.5, 0]\n");
  Simulation<2> simulation(scene);
  simulation.begin();
  while (simulation.state().time < 1) simulation.advance();
  EXPECT_GT(measure(scene, "wall.gap", simulation.state().motion()), 0.03);
}

/// Work between two bodies is booked, also for points in the core.
TEST(WettingLaws, WorkOfActinBetweenBodiesIsBooked) {
  for (const std::string offset : {"0.05", "0.16"})
    for (const Real step : {0.02, 0.037}) {
      const Supply all = supply(between_drops<2>(growing +
                                                 "interaction = \"smooth_young\"\nrange = "
                                                 "0.25\noffset = " +
                                                 offset + "\n"),
                                step);
      EXPECT_GT(std::abs(all.change), 0.01);
      EXPECT_NEAR(all.booked, all.change, 1e-12);
    }
  const Supply ground = supply(on_ground<3>("up = [0.1, 0, 1]\n" + graded(3) + young), 0.03);
  EXPECT_GT(std::abs(ground.change), 0.01);
  EXPECT_NEAR(ground.booked, ground.change, 1e-12);
}

/// The wetted area between two bodies is independent of the adhesion; the energy is not.
TEST(WettingLaws, WettedAreaBetweenBodiesIsThatOfUnitAdhesion) {
  const Scene<2> scene = between_drops<2>(growing + young),
                 unit = between_drops<2>("adhesion = \"1 + 0*t\"\n" + young);
  const NodalVectors u = test::random_field<2>(scene.system.size(), 0.03, 4), v = test::zeros(u);
  const Real area = measure(scene, "wall.wetted_area", {0, u, v});
  EXPECT_GT(area, 0.01);
  EXPECT_EQ(measure(scene, "wall.wetted_area", {0.5, u, v}), area);
  EXPECT_NEAR(measure(unit, "wall.energy", {0, u, v}), -area,
              1e-3 * area);  // the core is excluded
  EXPECT_NEAR(measure(scene, "wall.energy", {0, u, v}), -0.8 * area, 1e-3 * area);
}

/// Work of the contact in a cycle: a drop is widened far from the wall, lowered, narrowed on the
/// wall, and raised.
struct Cycle {
  Real net = 0, done = 0, spared = 0;  // difference of the wetted areas
};
Cycle cycle(const std::string& lines, Real gap, int parts) {
  const Scene<2> scene = on_wall<2>(lines);
  ForceTerm& term = *scene.system.terms.back();
  const auto state = [&](Real wide, Real up) {
    return test::field_on<2>(scene.system.bodies.front(), [&](const Vec<2>& X) -> Vec<2> {
      const Real below = std::max(0.0, -X[1]);
      return {wide * X[0], up - 0.4 + gap + 0.3 * below * below * below};
    });
  };
  const NodalVectors corners[] = {state(0, 1), state(0.3, 1), state(0.3, 0), state(0, 0)};
  constexpr std::array<Real, 4> place{0.0694318442029737, 0.3300094782075719, 0.6699905217924281,
                                      0.9305681557970263},
      weight{0.1739274225687269, 0.3260725774312731, 0.3260725774312731, 0.1739274225687269};
  Cycle sum;  // each side in parts with 4 Gauss points
  for (std::size_t side = 0; side < 4; ++side) {
    const NodalVectors way = test::sum_of(corners[(side + 1) % 4], -1, corners[side]);
    for (int part = 0; part < parts; ++part)
      for (std::size_t q = 0; q < 4; ++q) {
        const NodalVectors u = test::sum_of(corners[side], (part + at(place, q)) / parts, way);
        const Real work = at(weight, q) / parts * test::dot(test::force_of(term, u), way);
        sum.net += work;
        sum.done += std::abs(work);
      }
  }
  const auto wetted = [&](const NodalVectors& u) {
    return measure(scene, "wall.wetted_area", {0, u, test::zeros(u)});
  };
  sum.spared = wetted(corners[2]) - wetted(corners[3]);
  return sum;
}

TEST(WettingLaws, AClosedCycleDoesNoWork) {
  const Cycle c = cycle(young + "contact_angle = 70\npoints = 2\n", 0.06, 1000);
  EXPECT_GT(c.done, 0.5);
  EXPECT_LT(std::abs(c.net), 1e-10 * c.done);
}

/// The traction of the dissertation pulls the wide drop down and releases the narrow one.
TEST(WettingLaws, AClosedCycleGainsTheAdhesionWithTheTractionOfTheDissertation) {
  const Cycle c = cycle(
      "interaction = \"scaled_lennard_jones\"\nadhesion = 2\nsigma0 = 0.2\n"
      "form = \"dissertation\"\npoints = 4\n",
      0.127, 100);
  EXPECT_GT(c.spared, 0.1);
  EXPECT_NEAR(c.net, 2 * c.spared, 0.1 * c.net);
}

/// With a constant gradient of W, the net force is the gradient times the wetted area, and the wall
/// takes the reaction.
TEST(WettingLaws, AGradientPullsByTheWettedArea) {
  const Scene<3> scene = on_wall<3>(young + "adhesion = \"1 + 0.05*x\"\n");
  const NodalVectors u = test::random_field<3>(scene.system.size(), 0.02, 6), v = test::zeros(u);
  const Motion motion{0, u, v};
  const Vec<3> force = net<3>(test::force_of(*scene.system.terms.back(), u));
  EXPECT_NEAR(force[0], 0.05 * measure(scene, "wall.wetted_area", motion), 1e-9 * force[0]);
  EXPECT_LT(std::abs(force[1]), 1e-9);
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(force[i] + measure(scene, std::string("wall.reaction_") + "xyz"[i], motion), 0,
                1e-13 * force.norm());
}

/// Momentum along x.
Real momentum_of(const Body<2>& body, const State& state) {
  Real p = 0;
  for (Index A = 0; A < body.size(); ++A) p += at(body.mass, A) * at(state.v, body.first + A)[0];
  return p;
}

/// A drop on a W that grows to the right, and its mirror image. With Gauss points, since stress
/// points of nodal cells are mirror images only to 1e-6, which changes the viscous stress.
TEST(WettingLaws, AGradientAndItsMirrorImageDriveMirroredDrops) {
  const auto way = [](const char* sign) {
    std::string text = on_wall_text<2>(young + "adhesion = \"1 " + sign + " 0.2*x\"\n", {},
                                       "end = 1e3\nstep = 2e-3");
    text.insert(text.find("material"), "integration = \"gauss\"\n");
    Scene<2> scene = test::scene_of<2>(text);
    Simulation<2> simulation(scene);
    simulation.begin();
    Real pushed = 0;
    const auto pull = [&] { return measure(scene, "wall.force_x", simulation.state().motion()); };
    Real before = pull(), time = 0;
    while (simulation.state().time < 0.5) {
      simulation.advance();
      const Real now = pull(), dt = simulation.state().time - time;
      pushed += dt / 2 * (before + now);
      before = now;
      time = simulation.state().time;
    }
    const Real momentum = momentum_of(scene.system.bodies.front(), simulation.state());
    EXPECT_NEAR(momentum, pushed, 1e-10 * std::abs(pushed));
    return momentum;
  };
  const Real right = way("+"), left = way("-");
  EXPECT_GT(right, 0.01);
  EXPECT_NEAR(left, -right, 1e-8 * right);
}

/// A drop on an elastic layer whose modulus and adhesion grow to the right, and its mirror image:
/// momenta of the drop, and of both bodies.
TEST(SoftWetting, AGradedLayerAndItsMirrorImageDriveMirroredDrops) {
  const auto way = [](const char* sign) {
    const std::string grown = std::string("(1 ") + sign + " 0.3*x)\"";
    Scene<2> scene = test::scene_of<2>(
        "dimension = 2\n[time]\nend = 1e3\nstep = 2e-3\n[[body]]\nname = \"drop\"\nshape = "
        "\"half_disk\"\nradius = 1\ncore = 6\nrings = 3\ncentre = [0, 0.1]\nintegration = "
        "\"gauss\"\n" +
        example_liquid() +
        "[[body]]\nname = \"layer\"\nshape = \"rectangle\"\nsize = [4, 0.5]\ncorner = [-2, "
        "-0.5]\nspacing = 0.125\nintegration = \"gauss\"\nmaterial = { type = \"neo_hookean\", "
        "density = 1, poissons_ratio = 0.3, youngs_modulus = \"20*" +
        grown +
        " }\n[[surface_tension]]\nbody = \"drop\"\ngamma = 1\n[[contact]]\nname = "
        "\"line\"\nbodies = [\"drop\", \"layer\"]\nup = [0, 1]\noffset = 0.1\nrange = "
        "0.3\npoints = 3\nadhesion = \"" +
        grown + "\n");
    Simulation<2> simulation(scene);
    simulation.begin();
    for (int step = 0; step < 150; ++step) simulation.advance();
    const Real drop = momentum_of(scene.system.bodies.front(), simulation.state()),
               layer = momentum_of(scene.system.bodies.back(), simulation.state());
    EXPECT_NEAR(drop + layer, 0, 1e-12);
    return drop;
  };
  const Real right = way("+"), left = way("-");
  EXPECT_GT(right, 1e-3);
  EXPECT_NEAR(left, -right, 1e-8 * right);
}

/// The core is as strong as the tension of the drop. Points in the core do not count as wetted
/// area, in any units.
TEST(WettingLaws, TheWettedAreaOfVaryingAdhesionIsThatOfTheFilm) {
  const auto area = [](const char* tension) {
    std::string text = on_wall_text<2>(varied_in_core_of_plane);
    text.replace(text.find("gamma = 1"), 9, std::string("gamma = ") + tension);
    const Scene<2> scene = test::scene_of<2>(text);
    const NodalVectors u = test::random_field<2>(scene.system.size(), 0.02, 6), v = test::zeros(u);
    return measure(scene, "wall.wetted_area", {0, u, v});
  };
  EXPECT_GT(area("1"), 0.5);
  EXPECT_NEAR(area("20"), area("1"), 1e-12);
}

/// A drop that slides as a whole: force, reaction, heat, and the work of a moving wall.
TEST(WettingLaws, FrictionBrakesByTheWettedArea) {
  for (const Real wall : {0.0, 0.2}) {
    const Scene<3> scene = on_wall<3>(
        young + "contact_angle = 60\nfriction = 3\n",
        "type = \"half_space\"\npoint = [0, 0, -1.1]\nnormal = [0, 0, 1]\ndisplacement = [\"" +
            std::to_string(wall) + "*t\", 0, 0]\n");
    ForceTerm& term = *scene.system.terms.back();
    EXPECT_TRUE(term.viscous());
    const NodalVectors u = test::zeros(NodalVectors(scene.system.mass.size()));
    const NodalVectors v = test::field_on<3>(scene.system.bodies.front(),
                                             [](const Vec<3>&) { return Vec<3>(0.5, 0, 0.1); });
    const Motion motion{0, u, v};
    NodalVectors force = u;
    const Report report = term.add_force(motion, force);
    const Vec<3> braked =
        net<3>(force) -
        net<3>(test::force_of(term, u,
                              test::field_on<3>(scene.system.bodies.front(), [&](const Vec<3>&) {
                                return Vec<3>(wall, 0, 0);
                              })));
    const Real area = measure(scene, "wall.wetted_area", motion), slip = 0.5 - wall;
    EXPECT_GT(area, 0.1);
    EXPECT_NEAR(braked[0], -3 * area * slip, 0.02 * std::abs(braked[0]));
    EXPECT_LT(std::abs(braked[1]) + std::abs(braked[2]), 1e-10);
    EXPECT_NEAR(report.heat, -braked[0] * slip, 1e-10 * report.heat);
    EXPECT_EQ(report.external_work, 0);
    const Real later = term.add_force({0.1, u, v}, force).external_work;
    EXPECT_NEAR(later, net<3>(force)[0] / 2 * wall * 0.1, 1e-9);  // `force` contains both bodies
    EXPECT_NEAR(measure(scene, "wall.slip_x", motion), slip, 1e-12);
    EXPECT_NEAR(measure(scene, "wall.slip_z", motion), 0, 1e-12);
  }
}

TEST(WettingLaws, TheLineMovesAsTheBaseGrows) {
  const Scene<3> scene = on_wall<3>(young + "contact_angle = 60\n");
  const NodalVectors u = test::zeros(NodalVectors(scene.system.mass.size()));
  const NodalVectors v = test::field_on<3>(scene.system.bodies.front(), [](const Vec<3>& X) {
    return Vec<3>(0.3 * X[0], 0.3 * X[1], 0.1);
  });
  constexpr Real h = 1e-3;
  const auto radius = [&](Real by) {
    return measure(scene, "wall.base_radius", {0, test::sum_of(u, by, v), v});
  };
  const Real speed = (radius(h) - radius(-h)) / (2 * h);
  EXPECT_GT(std::abs(speed), 0.05);
  EXPECT_NEAR(measure(scene, "wall.line_speed", {0, u, v}), speed, 1e-4 * std::abs(speed));
  EXPECT_EQ(measure(scene, "wall.line_speed", {0, u, u}), 0);
}

/// Hardly any traction, so that the surface tensions alone act.
const std::string switched =
    "interaction = \"legacy_switch\"\ncontact_angle = 60\nadhesion = 1e-12\nsigma0 = 0.3\n"
    "switch_gap = 0.6\n";
template <int D>
Scene<D> switching(const std::string& lines = switched, const std::string& form = "triangles") {
  std::string text = on_wall_text<D>(lines);
  text.replace(text.find("gamma = 1\n"), 10, "gamma = 1\nform = \"" + form + "\"\n");
  return test::scene_of<D>(text);
}

template <int D>
void expect_switched_tensions() {
  const Scene<D> scene = switching<D>();
  ForceTerm& term = *scene.system.terms.back();
  const NodalVectors u = test::random_field<D>(scene.system.size(), 0.003, 1),
                     way = test::random_field<D>(scene.system.size(), 1, 2), v = test::zeros(u);
  EXPECT_GT(measure(scene, "wall.wet_triangles", {0, u, v}), 1);
  EXPECT_LT(test::gradient_error(term, u, way, 1e-6), 1e-7);
}

TEST(WettingLaws, SwitchedTensionsAreTheGradientWhileNothingSwitches) {
  expect_switched_tensions<2>();
  expect_switched_tensions<3>();
}

/// Lowering a drop onto the wall in one step loses W = gamma (1 + cos theta) times the area that is
/// wetted. Raising the drop returns this energy.
TEST(WettingLaws, EnergyOfSwitchesIsCounted) {
  const Scene<3> scene = switching<3>();
  ForceTerm& term = *scene.system.terms.back();
  const NodalVectors at_rest = test::zeros(NodalVectors(scene.system.mass.size()));
  const auto lowered = [&](Real by) {
    return test::field_on<3>(scene.system.bodies.front(),
                             [&](const Vec<3>&) { return Vec<3>(0, 0, -by); });
  };
  const auto count = [&](const char* name) { return measure(scene, name, {0, at_rest, at_rest}); };
  const auto energy = [&](Real by) { return test::energy_of(term, lowered(by)); };
  const auto stands = [&](Real by) {
    const NodalVectors u = lowered(by);
    term.commit({0, u, at_rest});
  };
  stands(-1);
  EXPECT_EQ(count("wall.switches"), 0);
  EXPECT_FALSE(term.warning({0, at_rest, at_rest}));
  stands(0);
  const Real wet = count("wall.wet_triangles");
  EXPECT_EQ(count("wall.switches"), wet);
  EXPECT_NEAR(count("wall.switch_loss"), -energy(0), 1e-9);
  EXPECT_GT(count("wall.switch_loss"), 0.1);
  EXPECT_NE(term.warning({0, at_rest, at_rest})->find("switched"), std::string::npos);
  stands(-1);
  EXPECT_EQ(count("wall.switches"), 2 * wet);
  EXPECT_NEAR(count("wall.switch_loss"), 0, 1e-9);
}

TEST(WettingLaws, SwitchedTensionsGoWithTheirTriangles) {
  EXPECT_THROW_WITH(switching<3>(switched, "balanced"), InputError,
                    "'drop' has none (its form is balanced); allowed is a [[surface_tension]] of "
                    "it with form = \"triangles\"");
  EXPECT_THROW_WITH(switching<3>(switched + "form = \"energy\"\n"), InputError,
                    "form: with legacy_switch the angle comes from the tensions");
  EXPECT_THROW_WITH(on_wall<3>(switched, moving_ball), InputError, "legacy_switch is for planes");
  EXPECT_THROW_WITH(test::scene_of<2>("dimension = 2\ntime = { end = 1 }\n" + test::two_drops(2) +
                                      "[[contact]]\nbodies = [\"drop\", \"other\"]\n" + switched),
                    InputError, "legacy_switch is for a body and a half space");
}

/// The complete input names the default interaction and the default form.
TEST(WettingLaws, TheCompleteInputNamesTheLawThatActs) {
  const auto contact = [](const std::string& lines, const std::string& key) {
    std::string text = on_wall_text<2>(lines);
    if (lines == switched)
      text.replace(text.find("gamma = 1\n"), 10, "gamma = 1\nform = \"triangles\"\n");
    const SceneInput input = SceneInput::from_text(text);
    scene_dimension(input);
    build_scene<2>(input);
    const std::string complete = input.complete(), start = "\n" + key + " = \"";
    const std::size_t table = complete.find("[[contact]]"),
                      begin = complete.find(start, table) + start.size();
    return complete.substr(begin, complete.find('"', begin) - begin);
  };
  EXPECT_EQ(contact("contact_angle = 60\n", "interaction"), "smooth_young");
  EXPECT_EQ(contact("adhesion = 1\nsigma0 = 0.3\n", "interaction"), "scaled_lennard_jones");
  EXPECT_EQ(contact("epsilon = 1\nsigma0 = 0.3\nbeta = 1\n", "interaction"), "lennard_jones");
  EXPECT_EQ(contact("contact_angle = 60\n", "form"), "energy");
  EXPECT_EQ(contact(switched, "form"), "dissertation");
}

/// Few points suffice if the field of the partner is smooth.
TEST(WettingLaws, UnresolvedGapsAreOfPartnersWithCorners) {
  const std::string few =
      "interaction = \"scaled_lennard_jones\"\nadhesion = 1\nsigma0 = 0.15\npoints = 1\n";
  const auto warns = [&](const std::string& partner) {
    const Scene<2> scene = on_wall<2>(few, partner);
    const NodalVectors u = test::zeros(NodalVectors(scene.system.mass.size()));
    return scene.system.terms.back()->warning({0, u, u}).has_value();
  };
  EXPECT_FALSE(warns({}));
  EXPECT_FALSE(warns("type = \"ball\"\nradius = 0.7\ncentre = [0, -1.8]\n"));
  EXPECT_TRUE(warns("type = \"frame\"\nlow = [-1.1, -1.1]\nhigh = [1.1, 1.1]\n"));
}

TEST(WettingLaws, FormulasAreCheckedWhereTheyAreUsed) {
  Scene<2> scene = on_wall<2>(young + "adhesion = \"1 + log(1 - t)\"\n");
  const NodalVectors u = test::zeros(NodalVectors(scene.system.mass.size()));
  NodalVectors force = u;
  const auto at_time = [&](Real t) { scene.system.terms.back()->add_force({t, u, u}, force); };
  EXPECT_THROW_WITH(at_time(2), SolveError, "adhesion: formula '1 + log(1 - t)' is not a number");
  EXPECT_THROW_WITH(at_time(0.9), SolveError, "adhesion is -1.3");
  Scene<2> angle = on_wall<2>(young + "contact_angle = \"90 + 100*t\"\n");
  EXPECT_THROW_WITH(angle.system.terms.back()->add_force({0.95, u, u}, force), SolveError,
                    "contact_angle is 185");
}

TEST(WettingLaws, WhatCannotBeIsRefused) {
  EXPECT_THROW_WITH(on_wall<2>(young + "adhesion = \"1 + x\"\nform = \"pressure\"\n"), InputError,
                    "use form = \"energy\", or numbers");
  EXPECT_THROW_WITH(on_wall<2>(young + "adhesion = 0.5\nactin = -0.6\n"), InputError,
                    "adhesion with actin is -0.1 at");
  EXPECT_THROW_WITH(on_wall<2>("interaction = \"scaled_lennard_jones\"\nsigma0 = 0.2\n"),
                    InputError, "one of them is needed");
  const std::string pair = "dimension = 2\ntime = { end = 1 }\n" + test::two_drops(2) +
                           "[[contact]]\nbodies = [\"drop\", \"other\"]\n";
  EXPECT_THROW_WITH(test::scene_of<2>(pair + "adhesion = \"1 + x\"\n"), InputError,
                    "between two bodies adhesion may depend on the place where the second is "
                    "ground");
  EXPECT_THROW_WITH(on_wall<2>(young + "adhesion = \"0.9 + x\"\n"), InputError,
                    "adhesion: formula '0.9 + x': adhesion is -0.");
  EXPECT_THROW_WITH(on_ground<2>(young + "up = [0, 1]\nadhesion = \"1.4 + x\"\n"), InputError,
                    "adhesion: formula '1.4 + x': adhesion is -0.1");
  EXPECT_THROW_WITH(test::scene_of<2>(pair + "adhesion = 1\nfriction = 2\n"), InputError,
                    "friction: is for rigid partners");
}

/// A drop over a layer with a ridge of slope 0.3 below its rim.
Scene<2> over_ridge(const std::string& tension) {
  return test::scene_of<2>(
      "dimension = 2\n[time]\nend = 1\n[[body]]\nname = \"drop\"\nshape = \"half_disk\"\nradius = "
      "1\ncore = 8\nrings = 4\ncentre = [0, 0.2]\nmaterial = { type = \"newtonian\", density = 1, "
      "bulk_modulus = 100, viscosity = 1 }\n[[body]]\nname = \"layer\"\nshape = "
      "\"rectangle\"\nsize = "
      "[4, 0.5]\ncorner = [-2, -0.5]\nspacing = 0.025\ninitial_displacement = [\"0\", "
      "\"0.15 - 0.3*abs(abs(x) - 1)\"]\nmaterial = { type = \"neo_hookean\", density = 1, mu = 1, "
      "lambda = 1 }\n[[surface_tension]]\nbody = \"drop\"\ngamma = 1\n" +
      tension +
      "[[contact]]\nname = \"line\"\nbodies = [\"drop\", \"layer\"]\nadhesion = 1\noffset = "
      "0.03\nrange = 0.1\npoints = 3\n");
}

TEST(SoftWetting, MeasuresTheRidgeAndItsAngles) {
  Scene<2> scene = over_ridge("[[surface_tension]]\nbody = \"layer\"\ngamma = 1\n");
  EXPECT_TRUE(scene.warnings.empty());
  const Motion motion = scene.initial.motion();
  EXPECT_NEAR(measure(scene, "line.ridge_height", motion), 0.15, 0.015);  // the top is rounded
  EXPECT_NEAR(measure(scene, "line.ridge_radius", motion), 1, 0.02);
  const Real tilt = std::atan(0.3) * 180 / std::numbers::pi;
  EXPECT_NEAR(measure(scene, "line.solid_angle", motion), 180 - 2 * tilt, 0.5);
  // The rim of the half disk is vertical 0.05 above the ridge.
  const Real lean = std::asin(0.05) * 180 / std::numbers::pi;
  EXPECT_NEAR(measure(scene, "line.liquid_angle", motion), 90 + tilt + lean, 1.5);
  EXPECT_GT(measure(scene, "line.wetted_area", motion), 0);
}

/// The contact takes half of the adhesion from the tension of the ground. A warning is given if the
/// ground has less tension.
TEST(SoftWetting, WarnsWhereTheGroundHasTooLittleTension) {
  const Scene<2> scene = over_ridge("");
  ASSERT_EQ(scene.warnings.size(), 2u);
  EXPECT_NE(scene.warnings[0].find("is 4 of 'layer', 1 N/m at most, 2.5 Pa and 0.1 m"),
            std::string::npos)
      << scene.warnings[0];
  EXPECT_NE(scene.warnings[1].find("the surface of 'layer', whose tension is 0"),
            std::string::npos);
}

/// The warning uses the largest adhesion of the whole run. Ground with an adhesion below a third of
/// modulus times range does not fold.
TEST(SoftWetting, WarnsWhereTheGroundWouldFold) {
  const auto warned = [](const std::string& adhesion) {
    const Scene<2> scene = on_ground<2>("up = [0, 1]\noffset = 0.05\nrange = 0.25\n" + adhesion);
    return std::any_of(scene.warnings.begin(), scene.warnings.end(), [](const std::string& words) {
      return words.find(
                 "contact 'wall': adhesion with actin / (Young's modulus x range) is 0.334 of "
                 "'layer', 0.209 N/m at most, 2.5 Pa and 0.25 m") == 0;
    });
  };
  // Young's modulus is E = 2.5.
  EXPECT_FALSE(warned("adhesion = 0.208\n"));
  EXPECT_FALSE(warned("adhesion = 0.1\nactin = \"t > 0.5 ? 0.108 : 0\"\n"));
  EXPECT_TRUE(warned("adhesion = 0.209\n"));
  EXPECT_TRUE(warned("adhesion = 0.1\nactin = \"t > 0.5 ? 0.109 : 0\"\n"));
}

}  // namespace
}  // namespace meniscus::test_wetting_laws
