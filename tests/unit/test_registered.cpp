// SPDX-License-Identifier: BSD-3-Clause
// Properties of everything that is registered: its forces are as claimed; a run with it has the
// same bits for any number of threads and through a restart; a scene without it does not build it.
#include "cases.hpp"
#include "meniscus/body/shapes.hpp"
#include "meniscus/measure/measure_registry.hpp"
#include "meniscus/physics/interaction_registry.hpp"
#include "meniscus/physics/law_registry.hpp"
#include "meniscus/physics/surface_registry.hpp"
#include "parallel/ranks.hpp"
#include "parallel/thread_ranks.hpp"
#include "scene/key_reference.hpp"
#include "stiffness_support.hpp"
#include "support.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cstring>
#include <sstream>

namespace meniscus::test_registered {
namespace {

using test::Case;
using test::missing_examples;
using test::own_terms;

/// Calls f(case, scene) for all cases.
template <int D, class F>
void for_all(F&& f) {
  for (const Case& c : test::cases<D>()) {
    SCOPED_TRACE(c.name + " in " + std::to_string(D) + "D");
    Scene<D> scene = test::scene_of<D>(c.scene);
    f(c, scene);
  }
}

using Missing = std::vector<std::string>;

TEST(Registered, EverythingBringsAnExample) {
  EXPECT_EQ(missing_examples(loads<2>(), "load (2D)"), Missing());
  EXPECT_EQ(missing_examples(loads<3>(), "load (3D)"), Missing());
  EXPECT_EQ(missing_examples(surface_laws(), "surface law"), Missing());
  EXPECT_EQ(missing_examples(interactions<2>(), "interaction"), Missing());
  EXPECT_EQ(missing_examples(partners<2>(), "rigid partner (2D)"), Missing());
  EXPECT_EQ(missing_examples(partners<3>(), "rigid partner (3D)"), Missing());
  EXPECT_EQ(missing_examples(shapes<2>(), "shape (2D)"), Missing());
  EXPECT_EQ(missing_examples(shapes<3>(), "shape (3D)"), Missing());
  EXPECT_EQ(missing_examples(laws(), "material"), Missing());
}

TEST(Registered, WhatBringsNoExampleIsNamed) {
  Registry<SurfaceLawEntry> registry;
  registry.add({"with", "", "gamma = 1\n", {}, nullptr});
  registry.add({"without", "", "", {}, nullptr});
  const Missing missing = missing_examples(registry, "surface law");
  ASSERT_EQ(missing.size(), 1u);
  EXPECT_EQ(missing.front().find("surface law 'without' brings no example: give its struct "
                                 "`static constexpr std::string_view example`"),
            0u);
}

/// Each entry appears with its example.
TEST(Registered, EverythingIsInTheReferenceOfKeys) {
  std::ostringstream out;
  print_keys(out);
  const std::string keys = out.str();
  const auto expect = [&](const std::string& text) {
    EXPECT_NE(keys.find(text), std::string::npos) << text;
  };
  for (const auto& [name, load] : loads<3>()) {
    expect("\n[[" + name + "]]: ");
    expect("\n    [[" + name + "]]\n    " +
           std::string(load.example.substr(0, load.example.find('\n'))) + "\n");
  }
  for (const auto& [name, law] : surface_laws()) expect("\n[surface.law] type = \"" + name + "\"");
  for (const auto& [name, by] : interactions<3>()) expect("] interaction = \"" + name + "\"");
  for (const auto& [name, partner] : partners<2>()) expect("[contact.partner] type = \"" + name);
  for (const auto& [name, law] : laws()) expect("\n[body.material] type = \"" + name + "\"");
  for (const auto& [name, shape] : shapes<2>()) expect("[[body]] shape = \"" + name + "\" (2D)");
  for (const auto& [name, shape] : shapes<3>()) expect("[[body]] shape = \"" + name + "\" (3D)");
}

template <int D>
void expect_gradients() {
  for_all<D>([](const Case& c, Scene<D>& scene) {
    const NodalVectors u = test::random_field<D>(scene.system.size(), 0.01, 5),
                       way = test::random_field<D>(scene.system.size(), 1, 6);
    const std::vector<Unknown>& fields = scene.initial.fields;
    for (const auto& term : own_terms(c, scene)) {
      if (!c.claims.gradient || !term->stored_energy({0, u, test::zeros(u), fields})) continue;
      SCOPED_TRACE(term->name());
      constexpr Real h = 1e-5;
      const Real slope = (test::energy_of(*term, test::sum_of(u, h, way), fields) -
                          test::energy_of(*term, test::sum_of(u, -h, way), fields)) /
                         (2 * h);
      const NodalVectors force = test::force_of(*term, u, test::zeros(u), fields);
      EXPECT_GT(test::norm(force), 0);
      EXPECT_NEAR(test::dot(force, way), -slope, 2e-7 * test::norm(force) * test::norm(way));
    }
  });
}

TEST(Registered, ForcesAreTheGradientOfTheEnergyWhereClaimed) {
  expect_gradients<2>();
  expect_gradients<3>();
}

/// The power of ramps is the change of the energy in time at fixed positions. Adhesion and tension
/// that change, and moved partners, are booked as work instead.
template <int D>
int expect_powers() {
  int with_power = 0;
  for_all<D>([&](const Case& c, Scene<D>& scene) {
    const NodalVectors u = test::random_field<D>(scene.system.size(), 0.01, 5);
    const std::vector<Unknown>& fields = scene.initial.fields;
    constexpr Real time = 0.05, h = 1e-5;
    for (const auto& term : own_terms(c, scene)) {
      const auto energy_at = [&](Real t) {
        return term->stored_energy({t, u, test::zeros(u), fields}).value_or(0);
      };
      SCOPED_TRACE(term->name());
      const Real rate = (energy_at(time + h) - energy_at(time - h)) / (2 * h);
      NodalVectors force = test::zeros(u);
      std::vector<Unknown> forces = fields;
      const Report report =
          term->add_force({time, u, test::zeros(u), fields}, Forces(force, forces));
      // The friction of a wall that moves does work without an energy.
      const bool by_work = term->name().starts_with("contact") ||
                           term->name().starts_with("varying tension") ||
                           term->name().starts_with("line friction");
      // Energy that a memory loses at fixed positions becomes heat.
      if (by_work || report.lost > 0) continue;
      EXPECT_NEAR(report.external_power, rate, 1e-6 * std::abs(energy_at(time)) + 1e-9);
      with_power += std::abs(rate) > 1e-3 * std::abs(energy_at(time));
    }
  });
  return with_power;
}

TEST(Registered, PowerOfRampsIsTheChangeOfTheEnergyInTime) {
  EXPECT_GE(expect_powers<2>(), 3) << "cavities, springs and laws that ramps change";
  EXPECT_GE(expect_powers<3>(), 3);
}

template <int D>
void expect_tangents() {
  for_all<D>([](const Case& c, Scene<D>& scene) {
    const Index n = scene.system.size();
    const NodalVectors u = test::random_field<D>(n, 0.01, 5), v = test::random_field<D>(n, 0.1, 6),
                       du = test::random_field<D>(n, 0.1, 7), dv = test::random_field<D>(n, 0.1, 8);
    const std::vector<Unknown>& fields = scene.initial.fields;
    std::vector<Unknown> unchanged = fields;
    for (Unknown& field : unchanged) field.x = test::zeros(field.x);
    for (const auto& term : own_terms(c, scene)) {
      SCOPED_TRACE(term->name());
      NodalVectors tangent = test::zeros(u);
      term->add_tangent({0, u, v, fields}, {0, du, dv, unchanged}, tangent);
      constexpr Real h = 1e-4;
      const auto force = [&](Real s) {
        return test::force_of(*term, test::sum_of(u, s, du), test::sum_of(v, s, dv), fields);
      };
      const NodalVectors ahead = force(h);
      const NodalVectors change = test::sum_of(ahead, -1, force(-h));
      EXPECT_LT(test::norm(test::sum_of(change, -2 * h, tangent)),
                1e-5 * test::norm(change) + 1e-13 * test::norm(ahead));
    }
  });
}

/// Assembled tangents of all forces but internal forces. Returns how many there are.
template <int D>
int expect_stiffness() {
  int assembled = 0;
  for_all<D>([&](const Case& c, Scene<D>& scene) {
    const Index n = scene.system.size();
    const NodalVectors u = test::random_field<D>(n, 0.01, 5), w = test::random_field<D>(n, 0.1, 7),
                       still = test::zeros(u);
    for (const auto& term : own_terms(c, scene)) {
      auto* force = dynamic_cast<AssembledForce*>(term.get());
      if (!force || !force->has_stiffness() || term->energy_kind() == "strain") continue;
      SCOPED_TRACE(term->name());
      NodalVectors tangent = still;
      term->add_tangent({0.05, u, still}, {0, w, still}, tangent);
      const NodalVectors matrix = test::assembled_tangent<D>(*force, {0.05, u, still}, w);
      // The matrix leaves out errors of the quadrature of cavities. Fields of partners have
      // differences for derivatives.
      const Real exact = term->name().starts_with("cavity") ? 5e-3 : 1e-6;
      EXPECT_LT(test::norm(test::sum_of(matrix, -1, tangent)), exact * test::norm(tangent));
      assembled += test::norm(tangent) > 0;
    }
  });
  return assembled;
}

TEST(Registered, AssembledTangentsAreTangents) {
  EXPECT_GE(expect_stiffness<2>(), 3);
  EXPECT_GE(expect_stiffness<3>(), 3);
}

TEST(Registered, TangentsAreTheChangeOfForces) {
  expect_tangents<2>();
  expect_tangents<3>();
}

/// C v equals the change of the force by the velocity, and C is symmetric and positive. The
/// diagonal in use is at most 1.2 times the exact one.
template <int D>
void expect_viscosity() {
  for_all<D>([](const Case&, Scene<D>& scene) {
    const Index n = scene.system.size();
    const NodalVectors u = test::random_field<D>(n, 0.01, 5), v = test::random_field<D>(n, 0.1, 6),
                       w = test::random_field<D>(n, 0.1, 7), still = test::zeros(u);
    for (const auto& term : scene.system.terms) {
      if (!term->viscous()) continue;
      SCOPED_TRACE(term->name());
      term->expect_viscous_calls();
      const NodalVectors at_rest = test::force_of(*term, u, still);
      const auto resisted = [&](const NodalVectors& rate) {
        NodalVectors f = still;
        term->add_viscous({0, u, rate}, f);
        return f;
      };
      const NodalVectors Cv = resisted(v), Cw = resisted(w);
      NodalVectors diagonal = still;
      term->add_viscous_diagonal(diagonal);
      NodalVectors e = still;
      at(e, n / 2).set(1, 1);
      const Real entry = -at(resisted(e), n / 2)[1];
      const NodalVectors difference = test::sum_of(test::force_of(*term, u, v), -1, at_rest);
      EXPECT_LT(test::norm(test::sum_of(Cv, -1, difference)),
                1e-12 * (test::norm(Cv) + test::norm(at_rest)));
      EXPECT_GT(test::norm(Cv), 0);
      EXPECT_NEAR(test::dot(w, Cv), test::dot(v, Cw), 1e-12 * test::norm(w) * test::norm(Cv));
      EXPECT_LE(test::dot(v, Cv), 0);
      EXPECT_GE(at(diagonal, n / 2)[1], 0);
      EXPECT_LE(at(diagonal, n / 2)[1], entry * 1.2 + 1e-12);
    }
  });
}

TEST(Registered, ViscousForcesAreLinearAndSymmetric) {
  expect_viscosity<2>();
  expect_viscosity<3>();
}

template <int D>
void expect_balance() {
  for_all<D>([](const Case& c, Scene<D>& scene) {
    if (!c.claims.balanced) return;
    const NodalVectors u = test::random_field<D>(scene.system.size(), 0.01, 7);
    for (const auto& term : own_terms(c, scene)) {
      const NodalVectors force = test::force_of(*term, u, test::zeros(u), scene.initial.fields);
      Eigen::Vector3d net = Eigen::Vector3d::Zero(), torque = net;
      Real size = 0, moment = 0;
      for (const Body<D>& body : scene.system.bodies)
        for (Index A = 0; A < body.size(); ++A) {
          const Eigen::Vector3d x = spatial<D>(at(body.particles.X(), A) +
                                               vector_at<D>(u, body.first + A)),
                                f = spatial<D>(vector_at<D>(force, body.first + A));
          const Eigen::Vector3d arm(x[1] * f[2] - x[2] * f[1], x[2] * f[0] - x[0] * f[2],
                                    x[0] * f[1] - x[1] * f[0]);
          net += f;
          torque += arm;
          size += f.norm();
          moment += arm.norm();
        }
      EXPECT_LT(net.norm(), 1e-12 * size);
      EXPECT_LT(torque.norm(), 1e-12 * moment);
    }
  });
}

TEST(Registered, ForcesHaveNoNetForceAndTorqueWhereClaimed) {
  expect_balance<2>();
  expect_balance<3>();
}

/// The result after some steps.
struct Outcome {
  std::uint64_t state;
  std::vector<Real> measures;
  bool operator==(const Outcome& other) const {
    return state == other.state && measures.size() == other.measures.size() &&
           std::memcmp(measures.data(), other.measures.data(), measures.size() * sizeof(Real)) == 0;
  }
};

template <int D>
class Threaded {
 public:
  Threaded(const Case& c, int threads)
      : before_(omp_get_max_threads()),
        scene_((omp_set_num_threads(threads), test::scene_of<D>(c.scene))),
        simulation_(scene_) {}
  ~Threaded() { omp_set_num_threads(before_); }

  Simulation<D>* operator->() { return &simulation_; }
  Outcome outcome(std::int64_t steps = 24) {
    while (simulation_.state().step < steps) simulation_.advance();
    Outcome outcome{simulation_.snapshot().hash(), {}};
    for (const MeasureSource& measure : scene_.measures)
      outcome.measures.push_back(measure.compute(simulation_.state().motion()));
    return outcome;
  }

 private:
  int before_;
  Scene<D> scene_;
  Simulation<D> simulation_;
};

/// A run on two threads continues the state of a run on three threads.
template <int D>
void expect_same_runs() {
  for (const Case& c : test::cases<D>()) {
    SCOPED_TRACE(c.name + " in " + std::to_string(D) + "D");
    Threaded<D> alone(c, 1);
    alone->begin();
    const Outcome outcome = alone.outcome();
    std::optional<Snapshot> kept;
    {
      Threaded<D> run(c, 3);
      run->begin();
      for (int k = 0; k < 11; ++k) run->advance();
      kept = run->snapshot();
      EXPECT_TRUE(run.outcome() == outcome);
    }
    kept->require_finite();
    Threaded<D> restarted(c, 2);
    restarted->restore(*kept);
    EXPECT_EQ(restarted->snapshot().hash(), kept->hash());
    EXPECT_TRUE(restarted.outcome() == outcome);
  }
}

TEST(Registered, RunsHaveTheSameBitsForAnyThreadsAndThroughARestartIn2D) {
  expect_same_runs<2>();
}

TEST(Registered, RunsHaveTheSameBitsForAnyThreadsAndThroughARestartIn3D) {
  expect_same_runs<3>();
}

/// A run on several ranks in this process has the bits of a run alone. A term that does not
/// register its reads is among the cases.
template <int D>
void expect_same_ranks(int size) {
  for (const Case& c : test::cases<D>()) {
    SCOPED_TRACE(c.name + " in " + std::to_string(D) + "D on " + std::to_string(size) + " ranks");
    constexpr std::int64_t steps = 6;
    Threaded<D> alone(c, 1);
    alone->begin();
    const Outcome outcome = alone.outcome(steps);
    std::vector<int> same(static_cast<std::size_t>(size), 0);
    as_ranks(size, [&] {
      Threaded<D> run(c, 1);
      run->begin();
      at(same, ranks().rank()) = run.outcome(steps) == outcome;
    });
    for (const int is_same : same) EXPECT_TRUE(is_same);
  }
}

TEST(Registered, RunsHaveTheSameBitsOnThreeRanksIn2DAndOnTwoIn3D) {
  expect_same_ranks<2>(3);
  expect_same_ranks<3>(2);
}

/// At least one shape of body has measures of every group.
template <int D>
void expect_measures() {
  for (const auto& entry : measures<D>()) {
    const auto& group = entry.second;
    bool seen = false;
    for_all<D>([&](const Case&, Scene<D>& scene) {
      for (const Body<D>& body : scene.system.bodies)
        for (const MeasureSource& measure : group.make(body, scene.units)) {
          seen = true;
          EXPECT_TRUE(std::isfinite(measure.compute(scene.initial.motion()))) << measure.name;
        }
    });
    EXPECT_TRUE(seen) << "no shape has measures of the group '" << entry.first << "'";
  }
}

TEST(Registered, MeasuresAreFinite) {
  expect_measures<2>();
  expect_measures<3>();
}

template <int D>
void expect_nothing_when_absent() {
  for_all<D>([](const Case& c, Scene<D>& with) {
    if (c.own_bodies) return;
    const std::size_t bodies_end = c.scene.find("[[", c.scene.rfind("[[body]]") + 2);
    const Scene<D> scene = test::scene_of<D>(c.scene.substr(0, bodies_end));
    EXPECT_EQ(scene.system.terms.size(), scene.system.bodies.size());
    EXPECT_GT(with.system.terms.size() + with.measures.size() + with.remaps.size(),
              scene.system.terms.size() + scene.measures.size());
  });
}

TEST(Registered, LoadsAddNothingToASceneThatDoesNotNameThem) {
  expect_nothing_when_absent<2>();
  expect_nothing_when_absent<3>();
}

/// One table is a shorthand for the other: both give the same bits.
TEST(Registered, SurfaceTensionIsTheSurfaceLawTension) {
  const auto force = [](const std::string& name) {
    const auto& all = test::cases<3>();
    const auto c =
        std::find_if(all.begin(), all.end(), [&](const Case& one) { return one.name == name; });
    const Scene<3> scene = test::scene_of<3>(c->scene);
    const NodalVectors u = test::random_field<3>(scene.system.size(), 0.01, 9);
    return test::force_of(*own_terms(*c, scene).front(), u);
  };
  const NodalVectors one = force("load surface_tension, weak"),
                     other = force("surface law tension");
  EXPECT_EQ(std::memcmp(one.data(), other.data(), one.size() * sizeof(Lanes)), 0);
}

/// A field is zero on bodies that have none of this name. Fields of one body with the same name are
/// added.
TEST(Registered, FieldsMayBeOfSomeBodiesOnly) {
  const std::string springs = "[[demo_springs]]\nbody = \"other\"\nstiffness = 2\n";
  const std::string bodies = "dimension = 2\ntime = { end = 1 }\n" + test::two_drops(2);
  for (const int loads : {1, 2}) {
    const Scene<2> scene = test::scene_of<2>(bodies + springs + (loads == 2 ? springs : ""));
    const NodalVectors u = test::random_field<2>(scene.system.size(), 0.01, 8);
    const auto field = field_values(scene, "demo_stretch", {0, u, u});
    ASSERT_EQ(field.size(), u.size());
    const auto first_of_other = static_cast<std::size_t>(scene.system.bodies[1].first);
    for (std::size_t A = 0; A < u.size(); ++A)
      EXPECT_EQ(field[A], A < first_of_other ? 0 : loads * u[A][0]);
  }
  const Scene<2> scene = test::scene_of<2>(bodies + springs);
  const NodalVectors u = test::zeros(NodalVectors(scene.system.mass.size()));
  for (const Real J : field_values(scene, "J", {0, u, u})) EXPECT_NEAR(J, 1, 1e-12);
  EXPECT_THROW(field_values(scene, "temperature", {0, u, u}), std::logic_error);
}

}  // namespace
}  // namespace meniscus::test_registered
