// SPDX-License-Identifier: BSD-3-Clause
// What holds for every registered load: its forces are what it claims, a run with it has the same
// bits for any number of threads and through a restart, and a scene without it does not have it.
#include "meniscus/physics/interaction_registry.hpp"
#include "meniscus/physics/surface_registry.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cstring>
#include <sstream>

#include "load_examples.hpp"
#include "support.hpp"

namespace meniscus {
namespace {

using test::LoadExample;

const Registry<LoadExample>& examples() {
  return Registry<LoadExample>::all();
}

/// The terms of the load: those of the bodies come first.
template <int D>
std::span<const std::unique_ptr<ForceTerm>> own_terms(const Scene<D>& scene) {
  return std::span(scene.system.terms).subspan(scene.system.bodies.size());
}

TEST(Loads, AllHaveAnExample) {
  const auto has_example = [](const std::string& load, int D) {
    return std::any_of(examples().begin(), examples().end(), [&](const auto& example) {
      return example.second.load() == load && !example.second.tables(D).empty();
    });
  };
  for (const auto& [name, load] : loads<2>()) EXPECT_TRUE(has_example(name, 2)) << name;
  for (const auto& [name, load] : loads<3>()) EXPECT_TRUE(has_example(name, 3)) << name;
  for (const auto& [name, example] : examples())
    EXPECT_NE(loads<3>().find(example.load()), nullptr) << name;
}

/// Surface laws and interactions are seen through the loads that use them.
TEST(Loads, AllLawsHaveAnExample) {
  const auto has_example = [](const std::string& text, int D) {
    return std::any_of(examples().begin(), examples().end(), [&](const auto& example) {
      return example.second.tables(D).find(text) != std::string::npos;
    });
  };
  for (const auto& [name, law] : surface_laws())
    EXPECT_TRUE(has_example("type = \"" + name + "\"", 3)) << name;
  for (const auto& [name, interaction] : interactions<3>())
    EXPECT_TRUE(name == "lennard_jones" || has_example("\"" + name + "\"", 3)) << name;
  for (const auto& [name, partner] : partners<2>())
    EXPECT_TRUE(has_example("type = \"" + name + "\"", 2)) << name;
}

/// The table of a law is the shorthand of another: the same bits.
TEST(Loads, SurfaceTensionIsTheSurfaceLawTension) {
  const auto force = [](const char* example) {
    const Scene<3> scene = test::scene_of<3>(examples().at(example).scene(3));
    const NodalVectors u = test::random_field<3>(scene.system.size(), 0.01, 9);
    return test::force_of(*own_terms(scene).front(), u);
  };
  const NodalVectors one = force("surface_tension.weak"), other = force("surface.tension");
  EXPECT_EQ(std::memcmp(one.data(), other.data(), one.size() * sizeof(Lanes)), 0);
}

TEST(Loads, AllAreInTheReferenceOfKeys) {
  std::ostringstream keys;
  describe_keys(keys);
  for (const auto& [name, load] : loads<3>())
    EXPECT_NE(keys.str().find("\n[[" + name + "]]: "), std::string::npos) << name;
}

/// Calls f(example, scene) for all examples of this dimension.
template <int D, class F>
void for_all(F&& f) {
  for (const auto& [name, example] : examples()) {
    if (example.tables(D).empty()) continue;
    SCOPED_TRACE(name + " in " + std::to_string(D) + "D");
    Scene<D> scene = test::scene_of<D>(example.scene(D));
    f(example, scene);
  }
}

template <int D>
void expect_gradients() {
  for_all<D>([](const LoadExample& example, Scene<D>& scene) {
    const NodalVectors u = test::random_field<D>(scene.system.size(), 0.01, 5),
                       way = test::random_field<D>(scene.system.size(), 1, 6);
    for (const auto& term : own_terms(scene)) {
      ASSERT_TRUE(term->stored_energy({0, u, test::zeros(u)}) || !example.conservative);
      if (!example.conservative) continue;
      constexpr Real h = 1e-5;
      const Real slope = (test::energy_of(*term, test::sum_of(u, h, way)) -
                          test::energy_of(*term, test::sum_of(u, -h, way))) /
                         (2 * h);
      const NodalVectors force = test::force_of(*term, u);
      EXPECT_GT(test::norm(force), 0);
      EXPECT_NEAR(test::dot(force, way), -slope, 2e-7 * test::norm(force) * test::norm(way));
    }
  });
}

TEST(Loads, ForcesAreTheGradientOfTheEnergyWhereClaimed) {
  expect_gradients<2>();
  expect_gradients<3>();
}

template <int D>
void expect_balance() {
  for_all<D>([](const LoadExample& example, Scene<D>& scene) {
    if (!example.closed) return;
    const NodalVectors u = test::random_field<D>(scene.system.size(), 0.01, 7);
    for (const auto& term : own_terms(scene)) {
      const NodalVectors force = test::force_of(*term, u);
      Eigen::Vector3d net = Eigen::Vector3d::Zero(), torque = net;
      Real size = 0, moment = 0;
      for (const Body<D>& body : scene.system.bodies)
        for (Index A = 0; A < body.size(); ++A) {
          Eigen::Vector3d x = Eigen::Vector3d::Zero(), f = x;
          x.head<D>() = at(body.particles.X(), A) + vector_at<D>(u, body.first + A);
          f.head<D>() = vector_at<D>(force, body.first + A);
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

TEST(Loads, HaveNoNetForceAndTorqueWhereClaimed) {
  expect_balance<2>();
  expect_balance<3>();
}

/// State after 24 steps; `restart_at` > 0: those after it are done by another simulation.
template <int D>
std::uint64_t state_after_run(const LoadExample& example, int threads, int restart_at) {
  constexpr int steps = 24;
  const int before = omp_get_max_threads();
  omp_set_num_threads(threads);
  Scene<D> scene = test::scene_of<D>(example.scene(D)), other = test::scene_of<D>(example.scene(D));
  Simulation<D> simulation(scene), continuation(other);
  simulation.begin();
  for (int k = 0; k < (restart_at > 0 ? restart_at : steps); ++k) simulation.advance();
  if (restart_at > 0) {
    continuation.restore(simulation.snapshot());
    for (int k = restart_at; k < steps; ++k) continuation.advance();
  }
  omp_set_num_threads(before);
  return (restart_at > 0 ? continuation : simulation).snapshot().hash();
}

template <int D>
void expect_same_runs() {
  for (const auto& [name, example] : examples()) {
    if (example.tables(D).empty()) continue;
    SCOPED_TRACE(name + " in " + std::to_string(D) + "D");
    const std::uint64_t one = state_after_run<D>(example, 1, 0);
    EXPECT_EQ(state_after_run<D>(example, 3, 0), one);
    EXPECT_EQ(state_after_run<D>(example, 2, 11), one);
  }
}

TEST(Loads, RunsHaveTheSameBitsForAnyThreadsAndThroughARestart) {
  expect_same_runs<2>();
  expect_same_runs<3>();
}

template <int D>
void expect_nothing_when_absent() {
  for_all<D>([](const LoadExample& example, Scene<D>& with) {
    LoadExample without = example;
    without.tables = [](int) { return std::string(); };
    const Scene<D> scene = test::scene_of<D>(without.scene(D));
    EXPECT_EQ(scene.system.terms.size(), scene.system.bodies.size());
    EXPECT_GT(with.system.terms.size() + with.measures.size(),
              scene.system.terms.size() + scene.measures.size());
  });
}

/// Of bodies without it, a field is zero; of the same name on the same body, it adds up.
TEST(Loads, FieldsMayBeOfSomeBodiesOnly) {
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

TEST(Loads, AddNothingToASceneThatDoesNotNameThem) {
  expect_nothing_when_absent<2>();
  expect_nothing_when_absent<3>();
}

}  // namespace
}  // namespace meniscus
