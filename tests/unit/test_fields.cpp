// SPDX-License-Identifier: BSD-3-Clause
// Unknown fields beside the displacement: exact solutions, order, stable step, energy, and the same
// bits for any number of threads and through a restart.
#include "one_body.hpp"
#include "run/simulation.hpp"
#include "solve/step/central_difference.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>

namespace meniscus::test_fields {
namespace {

constexpr Real capacity = 0.7, stiffness = 2;

/// A field s on the particles with the energy E = sum k_A (s_A - pull u_A,x)^2 / 2, k_A = k (1 +
/// A/n). Without pull the particles are independent.
class Dye final : public ForceTerm {
 public:
  template <int D>
  Dye(System<D>& system, Evolution evolution, Real pull)
      : number_(system.add_field({"dye", 1, dimension::length, evolution, 0.1},
                                 std::vector<Real>(system.mass.size(), capacity))),
        pull_(pull) {}

  static Real k(std::size_t A, std::size_t n) {
    return stiffness * (1 + static_cast<Real>(A) / static_cast<Real>(n));
  }
  std::string name() const override { return "dye"; }
  std::string_view energy_kind() const override { return "dye"; }
  Report add_force(const Motion& motion, Forces force) override {
    NodalVectors& f = force.fields[number_].f;
    for (std::size_t A = 0; A < f.size(); ++A) {
      const Real tension = k(A, f.size()) * distance(motion, A);
      f[A] += Lanes(-tension, 0, 0, 0);
      force[A] += Lanes(pull_ * tension, 0, 0, 0);
    }
    return {};
  }
  std::optional<Real> stored_energy(const Motion& motion) const override {
    Real E = 0;
    for (std::size_t A = 0; A < motion.u.size(); ++A)
      E += 0.5 * k(A, motion.u.size()) * std::pow(distance(motion, A), 2);
    return E;
  }

 private:
  Real distance(const Motion& motion, std::size_t A) const {
    return motion.fields[number_].x[A][0] - pull_ * motion.u[A][0];
  }
  std::size_t number_;
  Real pull_;
};

template <int D>
struct Dyed : test::OneBody<D> {
  Dyed(Evolution evolution, Real pull, Real start = 1)
      : test::OneBody<D>(test::potato<D>(), "neo_hookean") {
    this->system.terms.push_back(std::make_unique<Dye>(this->system, evolution, pull));
    this->state.fields = this->system.fields;
    for (Lanes& s : this->state.fields[0].x) s = Lanes(start, 0, 0, 0);
  }
};

/// Largest error at time 1 with steps of dt.
Real error_of(Evolution evolution, int steps) {
  Dyed<2> one(evolution, 0);
  start(one.system, one.state);
  for (int n = 0; n < steps; ++n) advance(one.system, one.state, 1.0 / steps);
  const NodalVectors& s = one.state.fields[0].x;
  Real largest = 0;
  for (std::size_t A = 0; A < s.size(); ++A) {
    const Real k = Dye::k(A, s.size());
    const Real exact = evolution == Evolution::relaxational ? std::exp(-k / capacity)
                                                            : std::cos(std::sqrt(k / capacity));
    largest = std::max(largest, std::abs(s[A][0] - exact));
    EXPECT_EQ(s[A][1], 0);
  }
  return largest;
}

TEST(Fields, FollowTheirExactSolutionWithTheOrderOfTheScheme) {
  const Real coarse = error_of(Evolution::relaxational, 100),
             fine = error_of(Evolution::relaxational, 200);
  EXPECT_LT(fine, 0.01);
  EXPECT_NEAR(coarse / fine, 2, 0.1);
  const Real swing_coarse = error_of(Evolution::inertial, 100),
             swing_fine = error_of(Evolution::inertial, 200);
  EXPECT_LT(swing_fine, 1e-4);
  EXPECT_NEAR(swing_coarse / swing_fine, 4, 0.1);
}

TEST(Fields, LimitTheStep) {
  // The stiffest particle limits the step.
  const auto limits = [](Evolution evolution) {
    Dyed<3> one(evolution, 0);
    one.state.force = one.state.u;
    const Real n = static_cast<Real>(one.state.u.size()), k = stiffness * (2 - 1 / n);
    const StableStep step = StableStepEstimator<3>(one.system).estimate(one.state);
    const Real exact =
        evolution == Evolution::relaxational ? 2 * capacity / k : 2 / std::sqrt(k / capacity);
    EXPECT_NEAR(step.of_fields, exact, 0.03 * exact);
    EXPECT_LE(step.dt, step.of_fields);
  };
  limits(Evolution::relaxational);
  limits(Evolution::inertial);
}

/// The field turns the energy lost by the displacement into heat.
TEST(Fields, CoupledToTheDisplacementKeepTheBooks) {
  for (const Evolution evolution : {Evolution::relaxational, Evolution::inertial}) {
    Dyed<2> one(evolution, 0.3, 0.01);
    const auto error_with = [&](Real dt) {
      State state = one.state;
      start(one.system, state);
      const Real before = take_ledger(one.system, state).balance();
      EXPECT_GT(before, 1e-3);
      while (state.time < 1 - 0.5 * dt) advance(one.system, state, dt);
      const Ledger after = take_ledger(one.system, state);
      if (evolution == Evolution::relaxational) {
        EXPECT_GT(after.dissipated, 0.5 * before);
      }
      return std::abs(after.balance() - before) / before;
    };
    const Real coarse = error_with(0.02), fine = error_with(0.01);
    EXPECT_LT(fine, 2e-3);
    EXPECT_LT(fine, 0.4 * coarse);
  }
}

const char* scene_text = R"toml(
dimension = 2
[time]
end = 100
check_every = 7
[[body]]
name = "one"
shape = "disk"
radius = 1
core = 4
rings = 3
initial_velocity = ["0.1*x", 0]
material = { type = "neo_hookean", density = 1, mu = 1, lambda = 2 }
)toml";

struct DyedScene {
  Scene<2> scene;
  std::optional<Simulation<2>> simulation;

  explicit DyedScene(Evolution evolution) {
    const SceneInput input = SceneInput::from_text(scene_text);
    scene_dimension(input);
    scene = build_scene<2>(input);
    EXPECT_TRUE(scene.initial.fields.empty());  // no object needs a field
    scene.system.terms.push_back(std::make_unique<Dye>(scene.system, evolution, 0.2));
    scene.initial.fields = scene.system.fields;
    for (std::size_t A = 0; A < scene.initial.u.size(); ++A)
      scene.initial.fields[0].x[A] = Lanes(0.05 * std::sin(static_cast<Real>(A)), 0, 0, 0);
    simulation.emplace(scene);
  }
  void go(int steps) {
    for (int n = 0; n < steps; ++n) simulation->advance();
  }
};

TEST(Fields, GoOnInTheMiddleWithTheSameBitsForAnyThreads) {
  const int before = omp_get_max_threads();
  for (const Evolution evolution : {Evolution::relaxational, Evolution::inertial}) {
    std::optional<std::uint64_t> first;
    for (const int threads : {1, 3}) {
      omp_set_num_threads(threads);
      DyedScene straight(evolution), continued(evolution);
      straight.simulation->begin();
      straight.go(20);
      const Snapshot middle = straight.simulation->snapshot();
      EXPECT_TRUE(middle.has("fields/dye/value"));
      continued.simulation->restore(middle);
      EXPECT_EQ(continued.simulation->snapshot().hash(), middle.hash());
      straight.go(20);
      continued.go(20);
      const std::uint64_t end = straight.simulation->snapshot().hash();
      EXPECT_EQ(continued.simulation->snapshot().hash(), end);
      EXPECT_EQ(first.value_or(end), end);
      first = end;
    }
  }
  omp_set_num_threads(before);
}

TEST(Fields, AskedForTwiceAreOne) {
  test::OneBody<2> one(test::potato<2>(), "neo_hookean");
  const std::vector<Real> half(one.system.mass.size(), 0.5);
  const FieldSpec dye{"dye", 1, dimension::none, Evolution::relaxational, 1};
  EXPECT_EQ(one.system.add_field(dye, half), 0u);
  EXPECT_EQ(one.system.add_field(dye, half), 0u);
  EXPECT_EQ(one.system.fields.size(), 1u);
  EXPECT_EQ(one.system.fields[0].capacity[3], 1);
  FieldSpec other = dye;
  other.components = 3;
  EXPECT_THROW(one.system.add_field(other, half), std::logic_error);
}

}  // namespace
}  // namespace meniscus::test_fields
