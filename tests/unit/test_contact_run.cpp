// SPDX-License-Identifier: BSD-3-Clause
// Contact in runs of scenes: conservation, threads, restart, rejected steps, refused starts.
#include "meniscus/error.hpp"
#include "run/simulation.hpp"
#include "solve/step/central_difference.hpp"
#include "thrown.hpp"

#include <gtest/gtest.h>
#include <omp.h>

namespace meniscus::test_contact_run {
namespace {

std::string disk(const std::string& name, const std::string& more) {
  return "[[body]]\nname = \"" + name + "\"\nshape = \"disk\"\nradius = 1\ncore = 6\nrings = 3\n" +
         more + "\nmaterial = { type = \"neo_hookean\", density = 1, mu = 40, lambda = 30 }\n";
}
std::string contact(const std::string& bodies, const std::string& more) {
  return "[[contact]]\nbodies = " + bodies + "\nepsilon = 1.5\nsigma0 = 0.4\nbeta = 1\n" + more +
         "\n";
}

/// Two disks collide off-centre; a plate moves upward below them.
std::string collision(const std::string& more_of_contact = "") {
  return "dimension = 2\n[time]\nend = 100\n" +
         disk("left", "centre = [-1.4, 0]\ninitial_velocity = [0.8, 0]") +
         disk("right", "centre = [1.4, 0.3]\ninitial_velocity = [-0.2, 0]") +
         contact("[\"left\", \"right\"]", more_of_contact);
}
std::string collision_on_plate() {
  return collision() + contact("[\"left\"]",
                               "partner = { type = \"half_space\", point = [0, -1.7], normal = [0, "
                               "1], displacement = [0, \"0.05*t + 0.02*sin(3*t)\"] }");
}

Scene<2> scene_of(const std::string& text) {
  const SceneInput input = SceneInput::from_text(text);
  EXPECT_EQ(scene_dimension(input), 2);
  return build_scene<2>(input);
}

struct SceneRun {
  Scene<2> scene;
  Simulation<2> simulation;

  explicit SceneRun(const std::string& text) : scene(scene_of(text)), simulation(scene) {}
  void steps(int count) {
    for (int k = 0; k < count; ++k) simulation.advance();
  }
  void until(Real time) {
    while (simulation.state().time < time) simulation.advance();
  }
  Real measure(const std::string& name) const {
    for (const MeasureSource& m : scene.measures)
      if (m.name == name) return m.compute(simulation.state().motion());
    throw std::runtime_error("no measure " + name);
  }
};

TEST(ContactRun, CollisionConservesEnergyAndMomenta) {
  SceneRun run(collision());
  run.simulation.begin();
  Real least = 1e300, worst_energy = 0;
  while (run.simulation.state().time < 3) {
    run.steps(5);
    const Ledger ledger = run.simulation.audit_now();
    const Audit& audit = run.simulation.audit();
    least = std::min(least, run.measure("left-right.gap"));
    worst_energy = std::max(worst_energy, std::abs(audit.balance_error(ledger)));
    EXPECT_LT(audit.momentum_error(ledger), 1e-13);
    EXPECT_LT(audit.angular_momentum_error(ledger), 1e-13);
    EXPECT_TRUE(ledger.stored.contains("contact"));
  }
  EXPECT_LT(least, 0.25);                                  // they met,
  EXPECT_GT(run.measure("left-right.gap"), least + 0.05);  // and parted
  EXPECT_LT(worst_energy, 5e-4);
}

/// The error of the energy comes from the time step: it falls to a quarter when the step is halved.
TEST(ContactRun, EnergyErrorIsOfSecondOrderInTheStep) {
  const auto error_with = [](Real step) {
    SceneRun run(collision());
    run.simulation.begin();
    State state = run.simulation.state();
    const Real before = take_ledger(run.scene.system, state).balance();
    Real worst = 0;
    while (state.time < 1.2) {
      advance(run.scene.system, state, step);
      worst = std::max(worst, std::abs(take_ledger(run.scene.system, state).balance() - before));
    }
    return worst;
  };
  const Real coarse = error_with(4e-3), fine = error_with(2e-3), finest = error_with(1e-3);
  EXPECT_NEAR(coarse / fine, 4, 0.6);
  EXPECT_NEAR(fine / finest, 4, 0.3);
}

/// A plate with prescribed motion does work.
TEST(ContactRun, WorkOfAMovingPlateIsBooked) {
  SceneRun run(collision_on_plate());
  run.simulation.begin();
  const Real before = run.simulation.audit_now().kinetic;
  run.until(4);
  const Ledger ledger = run.simulation.audit_now();
  EXPECT_GT(std::abs(ledger.external_work), 1e-3 * before);
  EXPECT_LT(std::abs(run.simulation.audit().balance_error(ledger)), 5e-4);
}

/// The error is of second order even in the step in which the plate starts and its power jumps.
TEST(ContactRun, EnergyErrorIsOfSecondOrderWhereAPlateSetsOff) {
  const auto error_with = [](Real step) {
    SceneRun run("dimension = 2\n[time]\nend = 100\n" + disk("left", "") +
                 contact("[\"left\"]",
                         "partner = { type = \"half_space\", point = [0, -1.3], normal = [0, 1], "
                         "displacement = [0, \"max(0, t - 0.4)\"] }"));
    run.simulation.begin();
    State state = run.simulation.state();
    const Real before = take_ledger(run.scene.system, state).balance();
    while (state.time < 0.44 - step / 2) advance(run.scene.system, state, step);
    EXPECT_GT(std::abs(state.books.external_work), 1e-3);
    return std::abs(take_ledger(run.scene.system, state).balance() - before);
  };
  const Real coarse = error_with(4e-3), fine = error_with(2e-3), finest = error_with(1e-3);
  EXPECT_NEAR(coarse / fine, 4, 0.6);
  EXPECT_NEAR(fine / finest, 4, 0.3);
}

TEST(ContactRun, RelaxationNeedsPartnersThatComeToRest) {
  const auto plate_after = [](const std::string& motion) {
    return "dimension = 2\n[time]\nend = 2\nsolver = \"relax\"\n" + disk("left", "") +
           contact("[\"left\"]",
                   "partner = { type = \"half_space\", point = [0, -1.7], normal = [0, 1], "
                   "displacement = [0, \"" +
                       motion + "\"] }");
  };
  Scene<2> stops = scene_of(plate_after("0.05*min(t, 1.5)"));
  EXPECT_NO_THROW(Simulation<2>{stops});
  EXPECT_NEAR(stops.system.terms.back()->steady_after(), 1.5, 2e-4);
  const auto displacement = [](const Scene<2>& scene, Real time) {
    for (const MeasureSource& m : scene.measures)
      if (m.name.ends_with(".displacement_y"))
        return m.compute({time, scene.initial.u, scene.initial.v});
    return std::nan("");
  };
  EXPECT_DOUBLE_EQ(displacement(stops, 1), 0.05);
  EXPECT_DOUBLE_EQ(displacement(stops, 2), 0.075);
  Scene<2> moves_on = scene_of(plate_after("0.05*t"));
  EXPECT_THROW_WITH(Simulation<2>{moves_on}, InputError,
                    "there is no rest that \"relax\" could reach");
  Scene<2> rests = scene_of(plate_after("0.05"));
  EXPECT_EQ(rests.system.terms.back()->steady_after(), 0);
  EXPECT_TRUE(std::isnan(displacement(rests, 1)));  // there is no such measure
}

TEST(ContactRun, SameBitsForAnyThreadsAndAfterARestart) {
  const auto state_after = [](int threads, int restart_at) {
    const int before = omp_get_max_threads();
    omp_set_num_threads(threads);
    SceneRun run(collision_on_plate());
    run.simulation.begin();
    run.steps(restart_at);
    EXPECT_TRUE(restart_at != 97 || run.measure("left-right.gap") < 0.4);  // in contact
    SceneRun again(collision_on_plate());
    if (restart_at > 0) again.simulation.restore(run.simulation.snapshot());
    SceneRun& last = restart_at > 0 ? again : run;
    last.steps(240 - restart_at);
    omp_set_num_threads(before);
    return last.simulation.snapshot().hash();
  };
  const auto expected = state_after(1, 0);
  EXPECT_EQ(state_after(3, 0), expected);
  EXPECT_EQ(state_after(2, 97), expected);
  EXPECT_EQ(state_after(1, 203), expected);
}

/// With a guard above the smallest gap of the collision, steps are halved. Then the run ends with a
/// complete state, and the message names the contact.
TEST(ContactRun, OverlapHalvesTheStepAndThenStops) {
  SceneRun run(collision("least_gap = 0.55"));
  run.simulation.begin();
  try {
    run.until(3);
    FAIL() << "went through";
  } catch (const SolveError& e) {
    const std::string what = e.what();
    for (const char* part : {"contact 'left-right'", "halved", "least is 0.55 sigma0", "particle"})
      EXPECT_NE(what.find(part), std::string::npos) << what;
  }
  EXPECT_GE(run.measure("left-right.gap"), 0.55 * 0.4 * (1 - 1e-9));
}

TEST(ContactRun, StartInOverlapIsRefusedWithItsPlace) {
  const std::string text = "dimension = 2\n[time]\nend = 1\n" + disk("left", "centre = [-1, 0]") +
                           disk("right", "centre = [1.05, 0]") +
                           contact("[\"left\", \"right\"]", "");
  try {
    scene_of(text);
    FAIL() << "accepted";
  } catch (const InputError& e) {
    const std::string what = e.what();
    for (const char* part : {"contact[0]", "overlap", "'left' and 'right'", "sigma0"})
      EXPECT_NE(what.find(part), std::string::npos) << what;
  }
}

TEST(ContactRun, WrongTablesAreNoted) {
  const auto problem_of = [](const std::string& bodies, const std::string& more) {
    try {
      scene_of("dimension = 2\n[time]\nend = 1\n" + disk("left", "centre = [-2, 0]") +
               disk("right", "centre = [2, 0]") + contact(bodies, more));
      return std::string("none");
    } catch (const InputError& e) {
      return std::string(e.what());
    }
  };
  const auto expect = [&](const std::string& bodies, const std::string& more, const char* part) {
    const std::string problem = problem_of(bodies, more);
    EXPECT_NE(problem.find(part), std::string::npos) << problem;
  };
  const std::string both = "[\"left\", \"right\"]";
  EXPECT_EQ(problem_of(both, ""), "none");
  expect("[\"left\", \"left\"]", "", "in contact with itself");
  expect("[\"left\"]", "", "allowed are two");
  expect("[\"left\", \"middle\"]", "", "no body 'middle'");
  expect(both, "partner = { type = \"ball\", centre = [9, 9], radius = 1 }", "allowed are two");
  expect(both, "form = \"volume\"\ndensity = \"constant\"", "referential");
  expect(both, "cutoff = 1", "out of range");
  expect("[\"left\"]", "partner = { type = \"ball\", centre = [9, 9, 9], radius = 1 }",
         "has 3 entries; allowed is an array of 2");
  expect("[\"left\"]",
         "form = \"volume\"\npartner = { type = \"ball\", centre = [9, 9], radius = 1 }",
         "volume is for two bodies");
}

}  // namespace
}  // namespace meniscus::test_contact_run
