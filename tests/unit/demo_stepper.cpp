// SPDX-License-Identifier: BSD-3-Clause
// Demonstration: a stepper in one file, without a change elsewhere. The symplectic Euler method;
// the tests of everything registered find it.
#include "cases.hpp"
#include "meniscus/solve/stepper.hpp"

#include <gtest/gtest.h>

namespace meniscus::demo_stepper {
namespace {

/// v += dt f/m, then u += dt v.
template <int D>
class DemoEuler final : public Stepper<D> {
 public:
  explicit DemoEuler(System<D>& system) : system_(system) {}

  void step(State& state, Real dt) override {
    for (Index A = 0; A < system_.size(); ++A) {
      at(state.v, A) += (dt / at(system_.mass, A)) * at(state.force, A);
      at(state.u, A) += dt * at(state.v, A);
    }
    state.time += dt;
    ++state.step;
    const Report report = system_.compute_forces(state.motion(), state.forces());
    system_.commit(state.motion());
    state.books.add(report, system_.load_power(state.motion()), dt);
    state.demand = report.demand;
  }

 private:
  System<D>& system_;
};

template <int D>
std::unique_ptr<Stepper<D>> make(System<D>& system, const StepperChoice&) {
  return std::make_unique<DemoEuler<D>>(system);
}

const bool registered = register_entry(StepperEntry{"demo_euler", {}, make<2>, make<3>});

/// A drop in free fall is g dt^2 n (n + 1)/2 below its start after n steps. Central differences are
/// exact; this is lower by n g dt^2/2.
TEST(DemoStepper, IsChosenByASceneAndMovesIt) {
  const auto fall = [](const std::string& solver) {
    Scene<2> scene = test::scene_of<2>("dimension = 2\n[time]\nend = 1\nstep = 0.002\nsolver = \"" +
                                       solver + "\"\n" + test::one_drop(2) +
                                       "[[body_force]]\nbody = \"drop\"\nacceleration = [0, -1]\n");
    Simulation<2> simulation(scene);
    simulation.begin();
    for (int k = 0; k < 50; ++k) simulation.advance();
    EXPECT_NEAR(simulation.state().time, 0.1, 1e-15);
    return simulation.state().u.front()[1];
  };
  EXPECT_NEAR(fall("demo_euler"), -0.002 * 0.002 * 50 * 51 / 2, 1e-14);
  EXPECT_NEAR(fall("dynamics"), -0.1 * 0.1 / 2, 1e-14);
}

}  // namespace
}  // namespace meniscus::demo_stepper
