// SPDX-License-Identifier: BSD-3-Clause
// Quasi-statics: the preconditioner, known equilibria, energy balance, jumps, and refused scenes.
#include "cases.hpp"
#include "kernel/row_sums.hpp"
#include "meniscus/error.hpp"
#include "numbers/dense.hpp"
#include "one_body.hpp"
#include "parallel/nodal_algebra.hpp"
#include "solve/step/central_difference.hpp"
#include "solved.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <list>

namespace meniscus::test_quasi_statics {
namespace {

TEST(LeastEigenvalue, IsThatOfAChainOfSprings) {
  constexpr int n = 7;
  const Real exact = 2 - 2 * std::cos(std::acos(-1.0) / (n + 1));
  EXPECT_NEAR(least_eigenvalue(std::vector<Real>(n, 2), std::vector<Real>(n - 1, -1)), exact,
              1e-14);
  EXPECT_NEAR(least_eigenvalue({-3}, {}), -3, 1e-14);
}

const std::string neo_hookean = "density = 1\nmu = 0.7\nlambda = 1.9\n";

template <int D>
void expect_moduli() {
  test::OneBody<D> one(test::potato<D>(), "neo_hookean", neo_hookean);
  const ElasticModuli moduli = elastic_moduli(one.system, one.body());
  EXPECT_NEAR(moduli.shear, 0.7, 1e-12);
  EXPECT_NEAR(moduli.lame, 1.9, 1e-12);
}

TEST(ElementPreconditioner, FindsTheModuliOfItsBodies) {
  expect_moduli<2>();
  expect_moduli<3>();
}

template <int D>
void expect_symmetric(Geometry<D> geometry) {
  test::OneBody<D> one(std::move(geometry), "neo_hookean", neo_hookean);
  const ElementPreconditioner<D> P(one.system);
  const NodalVectors a = test::random_field<D>(one.system.size(), 1, 3),
                     b = test::random_field<D>(one.system.size(), 1, 4);
  NodalVectors Pa = a, Pb = b;
  P.apply(a, Pa);
  P.apply(b, Pb);
  EXPECT_NEAR(test::dot(a, Pb), test::dot(b, Pa), 1e-10 * test::norm(a) * test::norm(Pb));
  EXPECT_GT(test::dot(a, Pa), 0);
}

TEST(ElementPreconditioner, IsSymmetricAndPositive) {
  expect_symmetric<2>(test::potato<2>());
  expect_symmetric<3>(test::potato<3>());
  Scene<3> shell = test::scene_of<3>("dimension = 3\n[time]\nend = 1\n" + test::one_shell());
  expect_symmetric<3>(shell.system.bodies.front().geometry);  // whose transform is factored
}

/// Conjugate gradients for a smooth load on a free cube (quasi-statics note 3).
TEST(ElementPreconditioner, SolvesAFreeCubeInFewIterations) {
  test::OneBody<3> one(test::brick<3>({8, 8, 8}), "neo_hookean", neo_hookean);
  const NodalVectors rest = one.state.u;
  const ElementPreconditioner<3> P(one.system);
  const FreeMotions<3> free(one.system, {0, rest, rest}, 1);
  NodalVectors r = test::field_on<3>(one.body(), [](const Vec<3>& X) {
    const Vec<3> x = X / 8 - Vec<3>::Constant(0.5);
    return Vec<3>(0.5 * std::sin(3 * x[2]), 0, x[0] * x[0] - 0.3 * x[1]);
  });
  for (Index A = 0; A < one.body().size(); ++A) at(r, A) *= at(one.system.mass, A);
  free.remove_from(r);
  NodalVectors z = rest, q = rest;
  const auto precondition = [&] {
    P.apply(r, z);
    free.remove_from(z);
    return test::dot(r, z);
  };
  const Real first = test::norm(r);
  Real rz = precondition();
  NodalVectors p = z;
  int iterations = 0;
  for (; iterations < 200 && test::norm(r) > 1e-4 * first; ++iterations) {
    q = rest;
    one.system.terms.front()->add_tangent({0, rest, rest}, {0, p, rest}, q);
    free.remove_from(q);
    const Real a = rz / -test::dot(p, q);
    r = test::sum_of(r, a, q);
    const Real before = rz;
    rz = precondition();
    p = test::sum_of(z, rz / before, p);
  }
  RecordProperty("iterations", iterations);
  EXPECT_LE(iterations, 60);
}

TEST(FreeMotions, AreThoseThatNoTermHasAForceAlong) {
  const auto left = [](const std::string& more, bool moved) {
    Scene<2> scene =
        test::scene_of<2>("dimension = 2\n[time]\nend = 1\n" + test::one_drop(2) + more);
    const NodalVectors u =
        moved ? test::random_field<2>(scene.system.size(), 0.01, 3) : NodalVectors(scene.initial.u);
    const FreeMotions<2> free(scene.system, {0, u, scene.initial.v}, 0.1);
    int count = 0;
    for (int k = 0; k < 3; ++k) {
      NodalVectors mode = test::field_on<2>(scene.system.bodies.front(), [k](const Vec<2>& X) {
        return k == 2 ? Vec<2>(-X[1], X[0]) : Vec<2>(Vec<2>::Unit(k));
      });
      if (k == 2)
        for (std::size_t A = 0; A < u.size(); ++A) mode[A] += Lanes(-u[A][1], u[A][0], 0, 0);
      const Real before = test::norm(mode);
      free.remove_from(mode);
      count += test::norm(mode) < 1e-9 * before;
    }
    return count;
  };
  for (const bool moved : {false, true}) {
    EXPECT_EQ(left("", moved), 3);
    EXPECT_EQ(left("[[surface_tension]]\nbody = \"drop\"\ngamma = 1\n", moved), 3);
    EXPECT_EQ(left("[[body_force]]\nbody = \"drop\"\nacceleration = [0, -1]\n", moved), 1);
    EXPECT_EQ(left("[[body_force]]\nbody = \"drop\"\nacceleration = [\"x\", 0]\n", moved), 2);
  }
}

/// Constant forces on the coefficients of a body.
class DeadLoad final : public ForceTerm {
 public:
  explicit DeadLoad(NodalVectors load) : load_(std::move(load)) {}
  std::string name() const override { return "dead load"; }
  Report add_force(const Motion&, Forces force) override {
    for (std::size_t A = 0; A < load_.size(); ++A) force[A] += load_[A];
    return {};
  }
  void add_tangent(const Motion&, const Motion&, Forces) override {}
  std::optional<Real> potential(const Motion& motion) override { return -power(motion.u); }
  Real load_power(const Motion& motion) override { return power(motion.v); }

 private:
  Real power(std::span<const NodalVector> v) const {
    Real power = 0;
    for (std::size_t A = 0; A < load_.size(); ++A) power += sum(load_[A] * v[A]);
    return power;
  }
  NodalVectors load_;
};

/// Applies the load that is in equilibrium at given displacements, and compares the equilibrium
/// found.
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
  QuasiStatics<D> newton(one.system, {.end = 1});
  newton.begin(one.state);
  newton.step(one.state, 1);
  EXPECT_TRUE(newton.arrived());
  EXPECT_LE(newton.method().iterations(), 10) << law;
  // The preconditioner resists volume changes of points that cells of mooney_rivlin share.
  EXPECT_GT(newton.method().stability(), law == "mooney_rivlin" ? 0.05 : 0.1);
  EXPECT_EQ(newton.jumps(), 0);
  // Compares positions up to a translation, which is free.
  Lanes drift = Lanes::zero();
  NodalVectors off(target.size());
  for (Index A = 0; A < one.body().size(); ++A) {
    at(off, A) = value_at(one.body().at_particles, A, one.state.u.data()) -
                 value_at(one.body().at_particles, A, target.data());
    drift += at(off, A) / static_cast<Real>(target.size());
  }
  Real largest = 0;
  for (const NodalVector& w : off)
    largest = std::max(largest, std::sqrt(sum((w - drift) * (w - drift))));
  // Newton's method stops before an iteration that would release less than 1e-9 of the energy. The
  // remaining energy is the square of the remaining distance. Iterations converge faster and
  // faster, so that even less is left.
  constexpr Real left = 1e-9;
  const auto potential = [&](const NodalVectors& u) {
    State state = one.state;
    state.u = u;
    return *one.system.terms.front()->stored_energy(state.motion()) - dot(load, u);
  };
  const Real least = potential(target), released = -least;
  EXPECT_LT(potential(one.state.u) - least, 0.01 * left * released) << law;
  EXPECT_LT(largest, std::sqrt(left) * meniscus::largest(target)) << law;
}

TEST(QuasiStatics, FindsTheStateThatALoadHolds) {
  for (const std::string law : {"neo_hookean", "st_venant_kirchhoff", "mooney_rivlin"}) {
    expect_loaded_brick<2>(law);
    expect_loaded_brick<3>(law);
  }
}

std::string sheet(const std::string& time, const std::string& more) {
  return "dimension = 2\n[time]\nsolver = \"newton\"\n" + time +
         "[[body]]\nname = \"it\"\nshape = \"rectangle\"\nsize = [2, 1]\ncells = [6, 3]\n"
         "[body.material]\ntype = \"neo_hookean\"\ndensity = 1\nmu = 0.75\nlambda = 1.5\n" +
         more;
}

const std::string pull = "[[body_force]]\nbody = \"it\"\nacceleration = [\"0.3*x*min(t, 1)\", 0]\n";

/// The booked work of a growing dead load equals the stored energy. The error is of third order in
/// the load step.
TEST(QuasiStatics, BooksTheWorkOfLoads) {
  std::vector<Real> errors;
  for (const std::string step : {"0.0625", "0.03125"}) {
    test::Solved<2> run(sheet("end = 1\nstep = " + step + "\n", pull));
    const Ledger ledger = run.ledger();
    EXPECT_EQ(ledger.kinetic, 0);
    EXPECT_EQ(ledger.dissipated, 0);
    EXPECT_EQ(run.simulation.state().time, 1);
    errors.push_back(std::abs(ledger.balance()) / ledger.external_work);
  }
  EXPECT_LT(errors[0], 1e-4);
  EXPECT_NEAR(errors[0] / errors[1], 8, 1.5);
}

/// The equilibrium does not depend on the path: Newton's method and relaxation find the same.
TEST(QuasiStatics, FindsWhatRelaxationFinds) {
  const std::string steady =
      "[[body_force]]\nbody = \"it\"\nacceleration = [\"0.3*x\", \"-0.1*y\"]\n";
  test::Solved<2> newton(sheet("end = 1\n", steady));
  std::string text = sheet("end = 1000\nforce_tolerance = 1e-8\nshape_tolerance = 1e-8\n", steady);
  text.replace(text.find("newton"), 6, "relax");
  test::Solved<2> relaxed(text);
  for (const std::string extent : {"it.extent_x", "it.extent_y"})
    EXPECT_NEAR(newton.measure(extent), relaxed.measure(extent), 1e-7) << extent;
  EXPECT_NEAR(newton.ledger().stored.at("strain") / relaxed.ledger().stored.at("strain"), 1, 1e-6);
}

/// A soft disk on an adhesive floor, and an adhesive lid that approaches and recedes. The disk is
/// guided, since a free disk would roll to one of several equilibria, which jump at other times.
std::string under_a_lid(const std::string& way) {
  return "dimension = 2\n[time]\nsolver = \"newton\"\nend = 4\nstep = 0.25\n"
         "[[body]]\nname = \"it\"\nshape = \"disk\"\nradius = 1\ncore = 4\nrings = 3\n"
         "[body.material]\ntype = \"neo_hookean\"\ndensity = 1\nmu = 1\nlambda = 2\n"
         "[[contact]]\nname = \"floor\"\nbodies = [\"it\"]\nepsilon = 80\nsigma0 = 0.2\nbeta = 1\n"
         "partner = { type = \"half_space\", point = [0, -1.13], normal = [0, 1] }\n"
         "[[contact]]\nname = \"lid\"\nbodies = [\"it\"]\nepsilon = 40\nsigma0 = 0.2\nbeta = 1\n"
         "partner = { type = \"half_space\", point = [0, 1.5], normal = [0, -1], "
         "displacement = [0, \"-" +
         way + "*(1 - abs(t - 2)/2)\"] }\n" +
         "[[held]]\nname = \"guide\"\nbody = \"it\"\nwhere = \"abs(x) < 0.3\"\n"
         "components = [\"x\"]\n";
}

/// The lid jumps into contact, and is pulled off later than it came. So the cycle costs work, which
/// equals the energy that both jumps release. If the lid does not come that near, there is no jump,
/// and the way back equals the way there.
TEST(QuasiStatics, BooksJumpsAndTheirHysteresis) {
  test::Solved<2> jumps(under_a_lid("0.42"));
  EXPECT_EQ(jumps.quasi_statics().jumps(), 2);
  ASSERT_EQ(jumps.notes.size(), 2u);
  EXPECT_NE(jumps.notes.front().find("jump between t = 1.4"), std::string::npos)
      << jumps.notes.front();
  EXPECT_NE(jumps.notes.back().find("jump between t = 2.8"), std::string::npos)
      << jumps.notes.back();
  test::Solved<2> none(under_a_lid("0.3"));
  EXPECT_EQ(none.quasi_statics().jumps(), 0);
  const Ledger with = jumps.ledger(), without = none.ledger();
  // Both runs release the same energy at the start. The energy of the jumps was supplied by the
  // lid.
  const Real released = with.dissipated - without.dissipated;
  EXPECT_NEAR(released, 0.0193, 0.0015);  // with load steps of 0.01
  EXPECT_NEAR(with.external_work, released, 5e-4);
  EXPECT_NEAR(with.balance(), without.balance(), 5e-4);
  EXPECT_NEAR(without.external_work, 0, 1e-4);
  EXPECT_GT(jumps.quasi_statics().method().stability(), 0);
}

/// A bar between held ends is stretched. The stress is the stress of uniform plane strain to the
/// tolerance, on any grid. The reactions are the forces on the faces, and their work is the stored
/// energy.
TEST(QuasiStatics, StretchesAHeldBarUniformly) {
  const auto bar = [](const std::string& step) {
    return test::Solved<2>(
        "dimension = 2\n[time]\nsolver = \"newton\"\nend = 1\nstep = " + step +
        "\n[[body]]\nname = \"bar\"\nshape = \"rectangle\"\nsize = [2, 1]\ncells = [6, 3]\n"
        "jitter = 0.2\n[body.material]\ntype = \"neo_hookean\"\ndensity = 1\nmu = 0.75\nlambda = "
        "1.5\n"
        "[[held]]\nname = \"left\"\nbody = \"bar\"\nface = \"x_min\"\ncomponents = [\"x\"]\n"
        "[[held]]\nname = \"right\"\nbody = \"bar\"\nface = \"x_max\"\ncomponents = [\"x\"]\n"
        "displacement = [\"0.4*t\", 0]\n");
  };
  const test::Solved<2> run = bar("0.0625");
  const Real stretch = run.measure("bar.extent_x") / 2, across = run.measure("bar.extent_y");
  EXPECT_NEAR(stretch, 1.2, 1e-8);
  // mu (b - 1/b) + lambda (J - 1) a = 0 across, with J = a b.
  const Real J = stretch * across;
  EXPECT_NEAR(0.75 * (across - 1 / across) + 1.5 * (J - 1) * stretch, 0, 1e-6);
  const Real stress = 0.75 * (stretch - 1 / stretch) + 1.5 * (J - 1) * across;
  EXPECT_NEAR(run.measure("right.force_x"), stress, 1e-6);
  EXPECT_NEAR(run.measure("left.force_x"), -stress, 1e-6);
  const Real error = run.ledger().balance() / run.ledger().external_work,
             finer = bar("0.03125").ledger().balance() / run.ledger().external_work;
  EXPECT_LT(std::abs(error), 2e-5);
  EXPECT_NEAR(error / finer, 8, 1.5);
}

/// A strut between clamped ends that approach each other. The strut is exactly straight, so that
/// forces never have a component across the axis.
std::string straight_strut(const std::string& time, const std::string& way) {
  return "dimension = 2\n[time]\n" + time +
         "[[body]]\nname = \"strut\"\nshape = \"rectangle\"\nsize = [10, 0.5]\ncells = [40, 2]\n"
         "[body.material]\ntype = \"st_venant_kirchhoff\"\ndensity = 1\nmu = 0.5\nlambda = 0\n"
         "[[held]]\nname = \"left\"\nbody = \"strut\"\nface = \"x_min\"\n"
         "[[held]]\nname = \"right\"\nbody = \"strut\"\nface = \"x_max\"\n" +
         way;
}

/// The buckling load: Euler's P = E I (2 pi/L)^2, lowered by shear to P/(1 + P/(5/6 G A))
/// (Engesser). buckling_way() is the shortening at this load.
Real buckling_load() {
  const Real euler = std::pow(2 * std::acos(-1.0) / 10, 2) * std::pow(0.5, 3) / 12;
  return euler / (1 + euler / (5.0 / 6 * 0.5 * 0.5));
}
Real buckling_way() {
  return buckling_load() * 10 / 0.5;
}

/// At 1.7 times the buckling shortening, the straight strut is unstable, which iterations with
/// axial forces do not detect. The bent strut carries about the buckling load. Its deflection a
/// follows from (pi a)^2/(4 L) = shortening beyond buckling.
TEST(QuasiStatics, AStraightStrutBuckles) {
  const Real deflection = 2 * std::sqrt(10 * (0.14 - buckling_way())) / std::acos(-1.0);
  test::Solved<2> run(straight_strut("solver = \"newton\"\nend = 1\nstep = 0.125\n",
                                     "displacement = [\"-0.14*t\", 0]\n"));
  EXPECT_GT(run.quasi_statics().method().stability(), 0);
  EXPECT_NEAR(run.measure("right.force_x") / -buckling_load(), 1, 0.03);
  EXPECT_NEAR((run.measure("strut.extent_y") - 0.5) / deflection, 1, 0.03);
  ASSERT_FALSE(run.notes.empty());
  EXPECT_NE(run.notes.front().find("an equilibrium was found that is not stable"),
            std::string::npos)
      << run.notes.front();
  EXPECT_EQ(run.simulation.stepper().stability(run.simulation.state()),
            run.quasi_statics().method().stability());
}

/// Below the buckling load P_b the straight strut is stable. Its smallest stiffness, relative to
/// the stiffness without load, is about 1 - P/P_b. Newton's method and relaxation agree. Relaxation
/// stays straight beyond the buckling load.
TEST(QuasiStatics, KnowsHowFarAStrutIsFromBuckling) {
  for (const Real share : {0.7, 0.9, 1.7}) {
    const std::string way = "displacement = [" + std::to_string(-buckling_way() * share) + ", 0]\n";
    std::list<test::Solved<2>> runs;
    runs.emplace_back(straight_strut("solver = \"relax\"\nend = 4000\n", way + "ramp = [0, 10]\n"));
    if (share < 1) runs.emplace_back(straight_strut("solver = \"newton\"\nend = 1\n", way));
    for (test::Solved<2>& run : runs) {
      EXPECT_TRUE(run.simulation.stepper().arrived());
      const Real least = run.simulation.stepper().stability(run.simulation.state()).value();
      if (share < 1)
        EXPECT_NEAR(least, 1 - share, 0.05);
      else
        EXPECT_LT(least, -0.05);  // negative; its exact value is not computed
      EXPECT_NEAR(run.measure("strut.extent_y"), 0.5, 1e-6);
      EXPECT_TRUE(run.notes.empty());
    }
  }
}

std::string refusal(const std::string& text) {
  try {
    Scene<2> scene = test::scene_of<2>(text);
    const Simulation<2> simulation(scene);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(QuasiStatics, RefusesByNameWhatHasNoLeastEnergy) {
  const std::string heading = "dimension = 2\n[time]\nend = 1\nsolver = \"newton\"\n";
  EXPECT_EQ(refusal(heading + test::one_drop(2)), "");  // a fluid
  const std::string contact =
      "[[contact]]\nname = \"floor\"\nbodies = [\"it\"]\nepsilon = 1\nsigma0 = 0.3\nbeta = 1\n"
      "partner = { type = \"half_space\", point = [0, -1], normal = [0, 1] }\n";
  EXPECT_EQ(refusal(sheet("end = 1\n", contact)), "");
  for (const std::string form : {"pressure", "dissertation"})
    EXPECT_NE(refusal(sheet("end = 1\n", contact + "form = \"" + form + "\"\n"))
                  .find("the force of contact 'floor' is not the gradient of an energy"),
              std::string::npos)
        << form;
  EXPECT_NE(refusal(sheet("end = 1\n", contact + "friction = 1\n")).find("contact 'floor'"),
            std::string::npos);
}

TEST(QuasiStatics, NamesTheForceThatNothingBalances) {
  try {
    test::Solved<2> run(
        sheet("end = 1\n", "[[body_force]]\nbody = \"it\"\nacceleration = [0.1, 0]\n"));
    FAIL();
  } catch (const SolveError& error) {
    EXPECT_NE(std::string(error.what()).find("net force (0.2, 0) on body 'it'"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace meniscus::test_quasi_statics
