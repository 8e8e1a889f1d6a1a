// SPDX-License-Identifier: BSD-3-Clause
// Each force term and a small run give the same bits for any number of threads.
#include "physics/internal/coefficient_damping.hpp"
#include "physics/loads/body_force.hpp"
#include "physics/surface/surface_tension.hpp"
#include "run/simulation.hpp"
#include "support.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <cstring>

namespace meniscus::test_threads {
namespace {

/// Runs f with the given number of threads.
template <class F>
auto with_threads(int threads, F&& f) {
  const int before = omp_get_max_threads();
  omp_set_num_threads(threads);
  auto result = f();
  omp_set_num_threads(before);
  return result;
}

struct Outcome {
  NodalVectors force;
  std::vector<Real> numbers;
  bool operator==(const Outcome& other) const {
    return force.size() == other.force.size() && numbers == other.numbers &&
           std::memcmp(force.data(), other.force.data(), force.size() * sizeof(Lanes)) == 0;
  }
};

/// Force and scalar results of a term built on one thread and on three, evaluated on several.
template <int D, class Build>
void expect_same_bits(const Body<D>& body, Build&& build) {
  const NodalVectors u = test::random_field<D>(body.size(), 0.01, 3);
  const NodalVectors v = test::random_field<D>(body.size(), 1, 4);
  const auto evaluate = [&](ForceTerm* term) {
    Outcome o{test::force_of(*term, u, v), {test::report_of(*term, u, v).heat}};
    if (const auto energy = term->stored_energy({0, u, v})) o.numbers.push_back(*energy);
    for (const auto& m : term->measures()) o.numbers.push_back(m.compute({0, u, v}));
    return o;
  };
  const std::unique_ptr<ForceTerm> first = with_threads(1, build), second = with_threads(3, build);
  const Outcome one = with_threads(1, [&] { return evaluate(first.get()); });
  EXPECT_GT(test::norm(one.force), 0);
  for (const int threads : {2, 3, 5})
    for (ForceTerm* term : {first.get(), second.get()})
      EXPECT_TRUE(with_threads(threads, [&] { return evaluate(term); }) == one) << threads;
}

template <int D>
void expect_all_terms_same() {
  const auto body = test::body_of<D>(test::potato<D>());
  for (const Integration& integration : test::integrations()) {
    SCOPED_TRACE(integration.rule);
    expect_same_bits<D>(*body,
                        [&] { return test::internal_force<D>(*body, "newtonian", integration); });
  }
  const Integration enclosed{"q_scni", 0, "automatic", true};
  expect_same_bits<D>(*body, [&] { return test::internal_force<D>(*body, "newtonian", enclosed); });
  expect_same_bits<D>(*body, [&] {
    return coefficient_damping<D>(*body,
                                  std::vector<Real>(static_cast<std::size_t>(body->size()), 1), 2);
  });
  expect_same_bits<D>(*body, [&] { return balanced_surface_tension<D>(*body, 1); });
  expect_same_bits<D>(*body, [&] { return weak_surface_tension<D>(*body, 1, 3); });
  expect_same_bits<D>(*body, [&] { return curvature_surface_tension<D>(*body, 1, 3); });
  expect_same_bits<D>(*body, [&] { return triangle_surface_tension<D>(*body, 1); });
  expect_same_bits<D>(*body, [&] {
    return body_force<D>(*body, body->mass, std::vector<Expression>(D, Expression("x + y*y")));
  });
}

TEST(Threads, EveryTermGivesTheSameBits) {
  expect_all_terms_same<2>();
  expect_all_terms_same<3>();
}

constexpr const char* scene_3d = R"toml(
dimension = 3
[time]
end = 1e3
check_every = 60
[[body]]
name = "drop"
shape = "ellipsoid"
semi_axes = [1, 1.5, 1]
core = 3
layers = 2
material = { type = "newtonian", density = 1, bulk_modulus = 20, viscosity = 0.3 }
[[surface_tension]]
body = "drop"
gamma = 1
[[body]]
name = "cube"
shape = "box"
size = [1, 1, 1]
cells = [3, 3, 3]
centre = [5, 0, 0]
integration = "gauss"
gauss_points = 2
initial_velocity = ["0.1*y", "-0.1*x", 0]
material = { type = "neo_hookean", density = 1, mu = "1 + 0.1*x", lambda = 3 }
[[body_force]]
body = "cube"
acceleration = [0, 0, "-0.1*cos(t)"]
)toml";

constexpr const char* scene_2d = R"toml(
dimension = 2
[time]
end = 1e3
check_every = 60
[[body]]
name = "drop"
shape = "ellipse"
semi_axes = [1, 1.4]
core = 8
rings = 4
material = { type = "newtonian", density = 1, bulk_modulus = 20, viscosity = 0.3 }
[[surface_tension]]
body = "drop"
gamma = 1
form = "curvature"
)toml";

template <int D>
void expect_same_run(const char* text) {
  const auto run = [&] {
    const SceneInput input = SceneInput::from_text(text);
    EXPECT_EQ(scene_dimension(input), D);
    Scene<D> scene = build_scene<D>(input);
    Simulation<D> simulation(scene);
    simulation.begin();
    for (int step = 0; step < 200; ++step) simulation.advance();
    simulation.audit_now();
    EXPECT_EQ(simulation.state().step, 200);
    EXPECT_GT(test::norm(simulation.state().v), 0);
    simulation.snapshot().require_finite();
    return simulation.snapshot().hash();
  };
  const std::uint64_t one = with_threads(1, run);
  for (const int threads : {2, 3, 5}) EXPECT_EQ(with_threads(threads, run), one) << threads;
}

TEST(Threads, ARunGivesTheSameBits) {
  expect_same_run<3>(scene_3d);
  expect_same_run<2>(scene_2d);
}

}  // namespace
}  // namespace meniscus::test_threads
