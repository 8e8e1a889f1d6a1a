// SPDX-License-Identifier: BSD-3-Clause
// Relaxation finds known equilibria, stops there by itself, keeps the balance of energy, and
// continues from a snapshot with the same bits.
#include "meniscus/error.hpp"
#include "one_body.hpp"
#include "run/simulation.hpp"
#include "solve/step/central_difference.hpp"
#include "solve/step/relaxation.hpp"
#include "thrown.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace meniscus::test_relaxation {
namespace {

/// A scene and its simulation.
template <int D>
struct Relaxed {
  Scene<D> scene;
  Simulation<D> simulation;

  explicit Relaxed(const std::string& text) : scene(read(text)), simulation(scene) {}
  static Scene<D> read(const std::string& text) {
    const SceneInput input = SceneInput::from_text(text);
    scene_dimension(input);
    return build_scene<D>(input);
  }

  const Relaxation<D>& relaxation() const {
    return dynamic_cast<const Relaxation<D>&>(simulation.stepper());
  }
  Real measure(const std::string& name) const {
    for (const MeasureSource& m : scene.measures)
      if (m.name == name) return m.compute(simulation.state().motion());
    throw std::logic_error(name);
  }
  void expect_rest(Real force_tolerance, Real shape_tolerance) const {
    EXPECT_TRUE(relaxation().arrived());
    EXPECT_LT(simulation.state().time, scene.time.end);
    EXPECT_LE(relaxation().force_residual(simulation.state()), force_tolerance);
    EXPECT_LE(relaxation().shape_change(), shape_tolerance);
  }
};

/// Constant forces on the coefficients of a body.
class DeadLoad final : public ForceTerm {
 public:
  explicit DeadLoad(NodalVectors load) : load_(std::move(load)) {}
  std::string name() const override { return "dead load"; }
  Report add_force(const Motion&, Forces force) override {
    for (std::size_t A = 0; A < load_.size(); ++A) force[A] += load_[A];
    return {};
  }
  Real load_power(const Motion& motion) override {
    Real power = 0;
    for (std::size_t A = 0; A < load_.size(); ++A) power += sum(load_[A] * motion.v[A]);
    return power;
  }

 private:
  NodalVectors load_;
};

/// Applies the load that is in equilibrium at given displacements to a body at rest, and compares
/// the state found. The displacements are symmetric about the planes of the brick, so that there is
/// no torque. They pull in all directions, since bodies under compressive dead loads turn over.
template <int D>
void expect_loaded_brick(const std::string& law) {
  test::OneBody<D> one(D == 3 ? test::brick<D>({4, 2, 3}) : test::brick<D>({6, 4}), law);
  const NodalVectors target = test::field_on<D>(one.body(), [](const Vec<D>& X) {
    Vec<D> u = 0.05 * X;
    u[0] = 0.1 * X[0] + 0.01 * X[0] * X[1] * X[1];
    return u;
  });
  NodalVectors load = test::force_of(*one.system.terms.front(), target);
  for (NodalVector& f : load) f = -f;
  one.system.terms.push_back(std::make_unique<DeadLoad>(load));

  start(one.system, one.state);
  StepController<D> controller(one.system, {.fixed = {}, .safety = 0.4});
  controller.begin(one.state);
  Relaxation<D> relaxation(one.system, {1e-10, 1e-9});
  relaxation.begin(one.state);
  const Ledger first = take_ledger(one.system, one.state);
  Audit audit;
  audit.begin(first);
  for (int n = 0; n < 20000 && !relaxation.arrived(); ++n) {
    const Real dt = controller.next(one.state, 1e300);
    relaxation.step(one.state, dt);
    audit.follow(one.system, one.state, take_ledger(one.system, one.state));
  }
  EXPECT_TRUE(relaxation.arrived());
  EXPECT_LE(relaxation.force_residual(one.state), 1e-10);
  for (Index A = 0; A < one.body().size(); ++A) {
    const Lanes off = value_at(one.body().at_particles, A, one.state.u.data()) -
                      value_at(one.body().at_particles, A, target.data());
    EXPECT_LT(std::sqrt(sum(off * off)), 1e-8) << A;
  }
  const Ledger last = take_ledger(one.system, one.state);
  EXPECT_GT(last.dissipated, 0.3 * last.external_work);
  // The load acts suddenly, which causes an error of the balance of dt^2/8 |f|^2/m.
  EXPECT_LT(std::abs(audit.balance_error(last)), 0.03);
}

TEST(Relaxation, FindsTheStateThatALoadHolds) {
  for (const std::string law : {"neo_hookean", "st_venant_kirchhoff"}) {
    expect_loaded_brick<2>(law);
    expect_loaded_brick<3>(law);
  }
}

const std::string sheet =
    "dimension = 2\n[time]\nsolver = \"relax\"\nend = 1000\n"
    "[[body]]\nname = \"it\"\nshape = \"rectangle\"\nsize = [2, 1]\ncells = [6, 3]\n"
    "[body.material]\ntype = \"neo_hookean\"\ndensity = 1.25\nmu = 0.75\nlambda = 1.5\n";

TEST(Relaxation, BodiesWithoutLoadAreAtRestAtOnce) {
  Relaxed<2> run(sheet);
  run.simulation.begin();
  while (!run.simulation.finished()) run.simulation.advance();
  run.expect_rest(0, 0);
  EXPECT_LT(run.simulation.state().step, 100);
}

/// A body that drifts keeps its shape, so that the run ends. Under an unbalanced force, the run
/// ends with a message about the net force.
TEST(Relaxation, RigidDriftIsNoChangeOfShape) {
  const std::string drifting = sheet + "[[body_force]]\nbody = \"it\"\nacceleration = ";
  std::string text = sheet;
  text.replace(text.find("[body.material]"), 0, "initial_velocity = [0.003, 0.001]\n");
  Relaxed<2> free(text);
  free.simulation.begin();
  while (!free.simulation.finished()) free.simulation.advance();
  free.expect_rest(1e-5, 1e-4);
  EXPECT_GT(free.simulation.state().u.front()[0], 0.003);

  Relaxed<2> pulled(drifting + "[0, -0.02]\n");
  pulled.simulation.begin();
  EXPECT_EQ(pulled.simulation.stepper().obstacle(pulled.simulation.state()),
            "net force (0, -0.05) on body 'it'");
  while (!pulled.simulation.finished()) pulled.simulation.advance();
  EXPECT_FALSE(pulled.relaxation().arrived());
  EXPECT_TRUE(pulled.relaxation().blocked());
  EXPECT_LT(pulled.simulation.state().step, 2000);
}

/// A fluid at rest has its exact shape, although no force returns particles to their initial
/// positions.
template <int D>
void expect_drop_at_rest(const std::string& shape) {
  Relaxed<D> run("dimension = " + std::to_string(D) +
                 "\n[time]\nsolver = \"relax\"\nend = 60\n[[body]]\nname = \"drop\"\n" + shape +
                 "material = { type = \"newtonian\", density = 1, bulk_modulus = 200, viscosity = "
                 "0.3 }\n[[surface_tension]]\nbody = \"drop\"\ngamma = 1\n");
  run.simulation.begin();
  while (!run.simulation.finished()) run.simulation.advance();
  run.expect_rest(1e-5, 1e-4);
  EXPECT_NEAR(run.measure("drop.aspect"), 1, 2e-3);
  EXPECT_NEAR(run.measure("drop.isoperimetric"), 1, 1e-4);
  EXPECT_LT(run.simulation.state().time, 20);
}

TEST(Relaxation, DropsComeToRest) {
  expect_drop_at_rest<2>(
      "shape = \"disk\"\nradius = 1\ncore = 4\nrings = 2\ninitial_displacement = [\"0.1*x\", "
      "\"-0.09*y\"]\n");
  expect_drop_at_rest<3>("shape = \"ellipsoid\"\nsemi_axes = [1, 1.2, 1]\ncore = 4\nlayers = 2\n");
}

/// A drop on a wall that it hardly wets swings for long. At each turning point it does not move,
/// but the wall exerts a force; this is not rest. At rest the wall exerts no force, and the height
/// equals the result of implicit Euler, which does not swing.
TEST(Relaxation, DropsDoNotRestWhereTheyTurn) {
  const auto drop = [](const std::string& time) {
    return "dimension = 2\n[time]\n" + time +
           "[[body]]\nname = \"drop\"\nshape = \"disk\"\nradius = 1\ncore = 6\nrings = 3\n"
           "centre = [0, 1.13]\nmaterial = { type = \"newtonian\", density = 1, bulk_modulus = "
           "200, "
           "viscosity = 0.3 }\n[[surface_tension]]\nbody = \"drop\"\ngamma = 1\n"
           "[[contact]]\nname = \"wall\"\nbodies = [\"drop\"]\ncontact_angle = 150\nsigma0 = 0.2\n"
           "partner = { type = \"half_space\", point = [0, 0], normal = [0, 1] }\n";
  };
  Relaxed<2> run(drop("solver = \"relax\"\nend = 100\n")),
      flow(drop("solver = \"newton\"\nend = 100\n"));
  for (Relaxed<2>* each : {&run, &flow}) {
    each->simulation.begin();
    each->simulation.settle();
    while (!each->simulation.finished()) each->simulation.advance();
    EXPECT_TRUE(each->simulation.stepper().arrived());
  }
  EXPECT_NEAR(run.measure("wall.force_y"), 0, 1e-3);
  EXPECT_NEAR(run.measure("drop.extent_y"), flow.measure("drop.extent_y"), 1e-3);
}

const std::string active_bar =
    "dimension = 3\n[time]\nsolver = \"relax\"\nend = 500\nforce_tolerance = 1e-8\n"
    "shape_tolerance = 1e-6\n"
    "[[body]]\nname = \"bar\"\nshape = \"box\"\nsize = [1, 1, 2]\ncells = [3, 3, 6]\n"
    "[body.material]\ntype = \"liquid_crystal_elastomer\"\ndensity = 1\nmu = 1.25\n"
    "bulk_modulus = 8\nstep_length = 2.5\nreference_director = [0, 0, 1]\n"
    "activity = 0.4439517925290134\nactivity_ramp = [0, 5]\n";

TEST(Relaxation, ActiveBarReachesItsStretches) {
  Relaxed<3> run(active_bar);
  EXPECT_EQ(run.relaxation().steady_after(), 5);
  run.simulation.begin();
  while (!run.simulation.finished()) {
    run.simulation.advance();
    run.simulation.audit_now();
  }
  run.expect_rest(1e-8, 1e-6);
  EXPECT_GT(run.simulation.state().time, 5);
  EXPECT_NEAR(run.measure("bar.extent_z") / 2, 1.1222250670561522, 1e-6);
  EXPECT_NEAR(run.measure("bar.extent_x"), 0.9509088637224783, 1e-6);
  const Ledger ledger = run.simulation.audit_now();
  EXPECT_LT(ledger.external_work, -0.01);  // the bar shortens under the active stress
  EXPECT_LT(std::abs(run.simulation.audit().balance_error(ledger)), 1e-4);
  EXPECT_LT(run.simulation.audit().angular_momentum_error(ledger), 1e-12);
}

TEST(Relaxation, KnowsHowFarItHasToGo) {
  // If relaxation stops early, the error of the shape is about the reported remaining change.
  for (const std::string tolerance : {"1e-2", "1e-3"}) {
    std::string loose = active_bar;
    for (const std::string key : {"force_tolerance = 1e-8", "shape_tolerance = 1e-6"})
      loose.replace(loose.find(key), key.size(), key.substr(0, 18) + tolerance);
    Relaxed<3> run(loose);
    run.simulation.begin();
    while (!run.simulation.finished()) run.simulation.advance();
    run.expect_rest(std::stod(tolerance), std::stod(tolerance));
    EXPECT_NEAR(run.measure("bar.extent_z") / 2, 1.1222250670561522, 2 * std::stod(tolerance));
  }
}

TEST(Relaxation, GoesOnFromASnapshotWithTheSameBits) {
  Relaxed<3> straight(active_bar), broken(active_bar);
  straight.simulation.begin();
  for (int n = 0; n < 130; ++n) straight.simulation.advance();
  const Snapshot snapshot = straight.simulation.snapshot();
  broken.simulation.restore(snapshot);
  EXPECT_EQ(broken.simulation.snapshot().hash(), snapshot.hash());
  for (int n = 0; n < 130; ++n) {
    straight.simulation.advance();
    broken.simulation.advance();
  }
  EXPECT_EQ(broken.simulation.snapshot().hash(), straight.simulation.snapshot().hash());
}

TEST(Relaxation, LoadsMustCeaseToChange) {
  const std::string force = "[[body_force]]\nbody = \"it\"\nacceleration = [\"sin(t)\", \"0\"]\n";
  EXPECT_THROW_WITH(Relaxed<2>(sheet + force), InputError,
                    "body force on 'it' changes as long as the scene lasts");
  std::string late = active_bar;
  late.replace(late.find("[0, 5]"), 6, "[0, 500]");
  EXPECT_THROW_WITH((Relaxed<3>(late)), InputError,
                    "until t = 500, not before the end 500 of the scene");
}

}  // namespace
}  // namespace meniscus::test_relaxation
