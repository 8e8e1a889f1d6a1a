// SPDX-License-Identifier: BSD-3-Clause
// Nematics: exact gradients, reaction and torque, transport, exact flows and shapes, and the energy
// balance of a step.
#include "meniscus/error.hpp"
#include "nematic_scenes.hpp"
#include "numbers/dense.hpp"
#include "solve/step/central_difference.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meniscus::test_nematic {
namespace {

using test::director_of;
using test::NematicDrop;

/// A drop without any symmetry: a disordered cloud with random displacements and directors.
template <int D>
struct Disturbed {
  Scene<D> scene;
  State state;

  explicit Disturbed(const std::string& anchoring, Real lambda = -1.7, Real nu2 = 0.4)
      : scene(test::scene_of<D>(
            drop(anchoring, lambda, nu2).scene(D, D == 3 ? 2 : 4, D == 3 ? 1 : 2, "end = 1"))),
        state(scene.initial) {
    const Index n = scene.system.size();
    state.u = test::random_field<D>(n, 0.03, 1);
    state.force.resize(state.u.size());
    director_of(state) = test::sum_of(director_of(state), 1, test::random_field<D>(n, 0.3, 2));
  }
  static NematicDrop drop(const std::string& anchoring, Real lambda, Real nu2) {
    NematicDrop drop;
    drop.K = 0.7;
    drop.eps = 0.6;
    drop.lambda = lambda;
    drop.nu2 = nu2;
    drop.anchoring = anchoring;
    drop.tension = false;
    drop.more = "jitter = 0.3\n";
    drop.director = D == 3 ? "\"0.5 + x\", \"y - 0.2*z\", \"0.3 - z\"" : "\"0.5 + x\", \"y - 0.2\"";
    return drop;
  }

  const CarriedField& director() const { return *scene.system.carried.front(); }
  Real energy(const NodalVectors& u, const NodalVectors& h) const {
    std::vector<Unknown> fields = state.fields;
    fields.front().x = h;
    return test::director_energy(scene, {0, u, test::zeros(u), fields});
  }
  /// Forces of the energies of the director on u; with `reaction`, the reaction of the director is
  /// added.
  NodalVectors force(bool reaction) {
    NodalVectors f = test::zeros(state.u);
    Unknown& field = state.fields.front();
    field.f = f;
    std::vector<Unknown> fields = state.fields;
    for (const auto& term : scene.system.terms)
      if (term->energy_kind() != "strain")
        term->add_force({0, state.u, state.v, state.fields}, {f, fields});
    if (reaction)
      for (auto& carried : scene.system.carried)
        carried->add_reaction({0, state.u, state.v, state.fields}, {f, fields});
    field.f = fields.front().f;
    return f;
  }
};

const std::vector<std::string> anchorings{"", "strength = 1.3\nsense = \"polar\"\n",
                                          "strength = 1.3\nsense = \"apolar\"\n"};

/// Derivative by central differences of the eighth order.
template <class F>
Real slope(F&& f, Real h) {
  return (4.0 / 5 * (f(h) - f(-h)) - 1.0 / 5 * (f(2 * h) - f(-2 * h)) +
          4.0 / 105 * (f(3 * h) - f(-3 * h)) - 1.0 / 280 * (f(4 * h) - f(-4 * h))) /
         h;
}

template <int D>
void expect_gradients() {
  for (const std::string& anchoring : anchorings) {
    Disturbed<D> drop(anchoring);
    const Index n = drop.scene.system.size();
    const NodalVectors way = test::random_field<D>(n, 1, 3), f = drop.force(false);
    const NodalVectors h = director_of(drop.state);
    const Real by_u =
                   slope([&](Real s) { return drop.energy(test::sum_of(drop.state.u, s, way), h); },
                         1e-3),
               by_h =
                   slope([&](Real s) { return drop.energy(drop.state.u, test::sum_of(h, s, way)); },
                         1e-2);
    const NodalVectors& of_h = drop.state.fields.front().f;
    EXPECT_NEAR(test::dot(f, way), -by_u, 1e-11 * test::norm(f) * test::norm(way)) << anchoring;
    EXPECT_NEAR(test::dot(of_h, way), -by_h, 1e-11 * test::norm(of_h) * test::norm(way))
        << anchoring;
  }
}

TEST(Nematic, ForcesAreTheGradientOfTheEnergyInPlacesAndDirectors) {
  expect_gradients<2>();
  expect_gradients<3>();
}

/// T h = dh/dt if particles have the velocity coefficients `v`.
template <int D>
NodalVectors carried_rate(const Body<D>& body, const NodalVectors& u, const NodalVectors& v,
                          const NodalVectors& h, Real lambda, Real nu2) {
  const PointRows<D> rows =
      build_point_rows<D>(body.particles, body.particles.X(), {.gradient = true}, body.name);
  NodalVectors rate = test::zeros(h);
  for (Index A = 0; A < body.size(); ++A) {
    Mat<D> F = Mat<D>::Identity(), F_rate = Mat<D>::Zero();
    for (Offset e = at(rows.start, A); e < at(rows.start, A + 1); ++e)
      for (int K = 0; K < D; ++K) {
        const Real g = at(rows.gradient, e * D + K);
        F.col(K) += g * vector_at<D>(u, at(rows.particle, e));
        F_rate.col(K) += g * vector_at<D>(v, at(rows.particle, e));
      }
    const Mat<D> l = F_rate * inverse<D>(F), d = (l + l.transpose()) / 2,
                 w = (l - l.transpose()) / 2;
    set_vector<D>(
        rate, A,
        Vec<D>((w + lambda * d - nu2 * l.trace() * Mat<D>::Identity()) * vector_at<D>(h, A)));
  }
  return rate;
}

/// The reaction does the power -S.T h of the forces on the director. Only with the reaction does
/// the net torque vanish. Without anchoring the torque is zero in any case, since energies with one
/// constant do not change if all directors rotate together.
template <int D>
void expect_reaction() {
  for (const std::string& anchoring : anchorings)
    for (const Real lambda : {1.0, -1.7}) {
      constexpr Real nu2 = 0.4;
      Disturbed<D> drop(anchoring, lambda, nu2);
      const Body<D>& body = drop.scene.system.bodies.front();
      const NodalVectors& u = drop.state.u;
      const NodalVectors without = drop.force(false), with = drop.force(true),
                         v = test::random_field<D>(body.size(), 1, 4);
      const NodalVectors& h = director_of(drop.state);
      const NodalVectors& minus_S = drop.state.fields.front().f;
      const Real power = test::dot(with, v) - test::dot(without, v);
      EXPECT_NEAR(power, test::dot(minus_S, carried_rate(body, u, v, h, lambda, nu2)),
                  1e-12 * test::norm(with) * test::norm(v));
      const auto none = test::balance_of(body, u, without), all = test::balance_of(body, u, with);
      EXPECT_LT(all.torque, 1e-13);
      EXPECT_LT(all.force, 1e-13);
      EXPECT_LT(none.force, 1e-13);
      if (anchoring.empty())
        EXPECT_LT(none.torque, 1e-13);
      else
        EXPECT_GT(none.torque, 1e-3);
      // The sum of h x S is the torque of the other forces.
      Eigen::Vector3d couple = Eigen::Vector3d::Zero(), torque = couple;
      for (Index A = 0; A < body.size(); ++A) {
        couple -= cross(spatial(at(h, A)), spatial(at(minus_S, A)));
        torque += cross(spatial<D>(at(body.particles.X(), A) + vector_at<D>(u, A)),
                        spatial(at(without, A)));
      }
      EXPECT_LT((couple - torque).norm(), 1e-13 * test::norm(without) * test::norm(h));
    }
}

TEST(Nematic, TheReactionTakesThePowerAndTheTorqueOfTheDirector) {
  expect_reaction<2>();
  expect_reaction<3>();
}

TEST(Nematic, ItsTransportGoesBackTheWayItCame) {
  Disturbed<3> drop("");
  const NodalVectors to = test::random_field<3>(drop.scene.system.size(), 0.1, 7),
                     h = director_of(drop.state);
  NodalVectors x = h;
  drop.director().carry(drop.state.u.data(), to.data(), x);
  EXPECT_GT(test::norm(test::sum_of(x, -1, h)), 0.1);
  drop.director().carry(to.data(), drop.state.u.data(), x);
  EXPECT_LT(test::norm(test::sum_of(x, -1, h)), 1e-13 * test::norm(h));
}

/// Displacements of the motion x = A X of all particles.
template <int D>
NodalVectors moved(const Body<D>& body, const Mat<D>& A) {
  return test::field_on<D>(body, [&](const Vec<D>& X) { return Vec<D>(A * X - X); });
}
Mat<2> sheared(Real t) {
  Mat<2> A = Mat<2>::Identity();
  A(0, 1) = t;
  return A;
}

/// Transport without relaxation: exact solutions in the shear flow v = (y, 0), and Jeffery's
/// period.
TEST(Nematic, TurnsInAShearFlowAsJefferySays) {
  for (const auto& row : test::cells_reference().at("nematic").at("shear").at("rows")) {
    Disturbed<2> drop("", row.at("lam"), 0);
    const Body<2>& body = drop.scene.system.bodies.front();
    const auto follow = [&](Real end, int steps) {
      NodalVectors h = test::field_on<2>(
          body, [](const Vec<2>&) { return Vec<2>(std::cos(0.3), std::sin(0.3)); });
      for (int k = 0; k < steps; ++k)
        drop.director().carry(moved<2>(body, sheared(end * k / steps)).data(),
                              moved<2>(body, sheared(end * (k + 1) / steps)).data(), h);
      return vector_at<2>(h, body.size() / 2);
    };
    for (const auto& [time, exact] : row.at("h").items()) {
      const Vec<2> h = follow(std::stod(time), 2000);
      EXPECT_NEAR(h[0], exact[0].get<Real>(), 3e-6 * h.norm()) << row.dump();
      EXPECT_NEAR(h[1], exact[1].get<Real>(), 3e-6 * h.norm()) << row.dump();
    }
    if (!row.contains("period")) continue;
    const Vec<2> after = follow(row.at("period"), 10000);
    EXPECT_NEAR(after[0], std::cos(0.3), 1e-6);
    EXPECT_NEAR(after[1], std::sin(0.3), 1e-6);
  }
}

/// With relaxation and |lambda| > 1, the director aligns at the Leslie angle. Its length follows
/// from the penalty.
TEST(Nematic, AlignsInAShearFlowAtTheLeslieAngle) {
  const auto& exact = test::cells_reference().at("nematic").at("aligned");
  NematicDrop numbers;
  numbers.K = 0.2;
  numbers.gamma_1 = 0.5;
  numbers.eps = exact.at("eps");
  numbers.lambda = exact.at("lam");
  numbers.tension = false;
  numbers.director = "\"sqrt(0.3)\", \"-sqrt(0.7)\"";
  Scene<2> scene = test::scene_of<2>(numbers.scene(2, 4, 2, "end = 1"));
  const Body<2>& body = scene.system.bodies.front();
  CarriedField& director = *scene.system.carried.front();
  director.set_limit(5e-3);  // so that both steps have two stages
  const auto after = [&](Real dt) {
    NodalVectors h = director_of(scene.initial);
    for (int k = 0; k * dt < 2.999; ++k) {
      director.depart(moved<2>(body, sheared(k * dt)));
      director.arrive(moved<2>(body, sheared((k + 1) * dt)), dt, h);
    }
    return vector_at<2>(h, body.size() / 2);
  };
  const Vec<2> coarse = after(2e-3), fine = after(1e-3);
  const auto expect = [&](Real of_coarse, Real of_fine, Real truth) {
    EXPECT_NEAR((of_coarse - truth) / (of_fine - truth), 4, 0.1);  // second order
    EXPECT_NEAR((4 * of_fine - of_coarse) / 3, truth, 1e-6);
  };
  expect(coarse.squaredNorm(), fine.squaredNorm(), exact.at("h2"));
  EXPECT_NEAR(std::atan(fine[1] / fine[0]), exact.at("theta").get<Real>(), 1e-6);
}

/// In a hundred revolutions the director follows the body without heat. The middle of a step by the
/// angle b lies on straight lines between the particle positions, so the body is smaller there by
/// cos(b/2). The length |h| is one in the middle, and 1 + lambda b^2/8 at the ends of the step.
TEST(Nematic, GoesRoundWithABodyThatTurns) {
  Disturbed<3> drop("", -1.7, 0);
  const Body<3>& body = drop.scene.system.bodies.front();
  CarriedField& director = *drop.scene.system.carried.front();
  director.set_limit(0.1);
  NodalVectors h = test::field_on<3>(body, [](const Vec<3>&) { return Vec<3>(0.6, 0.8, 0); });
  const auto turned = [&](int degrees) {
    const Real a = degrees * std::numbers::pi / 180;
    Mat<3> R = Mat<3>::Identity();
    R(0, 0) = R(1, 1) = std::cos(a);
    R(0, 1) = -(R(1, 0) = std::sin(a));
    return moved<3>(body, R);
  };
  constexpr int revolutions = 100, by = 3;
  Real heat = 0;
  for (int k = 0; k < 360 * revolutions; k += by) {
    director.depart(turned(k % 360));
    heat += std::abs(director.arrive(turned(k % 360 + by), 0.01, h));
  }
  const Real b = by * std::numbers::pi / 180;
  for (const Lanes& x : h) {
    EXPECT_NEAR(x[0] * 0.8 - x[1] * 0.6, 0, 2e-4);
    EXPECT_NEAR(std::hypot(x[0], x[1]), 1 - 1.7 * b * b / 8, 1e-6);
  }
  EXPECT_LT(heat, 1e-5 * test::director_energy(drop.scene, drop.scene.initial.motion()));
}

/// The free twisted disk of the note, with strong coupling.
NematicDrop twisted(Real lambda, Real gamma_1 = 0.5) {
  NematicDrop drop;
  drop.lambda = lambda;
  drop.mu = 0.3;
  drop.gamma_1 = gamma_1;
  drop.anchoring = "strength = 2\nsense = \"polar\"\n";
  drop.more = "initial_velocity = [\"0.3*y - 0.2*x\", \"0.1*x + 0.2*y\"]\n";
  const std::string angle = "0.4*(1 - x^2 - y^2)", length = "sqrt(1.08/(x^2 + y^2 + 0.08))";
  drop.director = fmt::format(
      "\"(cos({0})*x - sin({0})*y)*{1}\", \"(sin({0})*x + cos({0})*y)*{1}\"", angle, length);
  return drop;
}

/// The largest errors of the balance of energy and of the angular momentum until t = 0.4.
struct Books {
  Real balance = 0, angular_momentum = 0, exchanged = 0;
  int stages = 0;
};
Books books_of(const NematicDrop& drop, const std::string& step) {
  Scene<2> scene =
      test::scene_of<2>(drop.scene(2, 6, 3, "end = 0.4\nviscosity = \"explicit\"\n" + step));
  Simulation<2> simulation(scene);
  simulation.begin();
  Books books;
  const Ledger begin = simulation.audit_now();
  while (!simulation.finished()) {
    simulation.advance();
    const Ledger now = simulation.audit_now();
    books.balance = std::max(books.balance, std::abs(now.balance() - begin.balance()));
    books.angular_momentum =
        std::max(books.angular_momentum, (now.angular_momentum - begin.angular_momentum).norm());
  }
  books.exchanged = simulation.audit().energy_scale;
  books.stages = scene.system.carried.front()->stages(simulation.last_step());
  return books;
}

/// The error of the balance is of second order in the step, with the number of stages that the
/// director needs. Angular momentum is constant. The default step is short enough for the start of
/// the motion.
TEST(Nematic, KeepsTheBooks) {
  for (const auto& drop : {twisted(1), twisted(-2.5), twisted(-1.5, 0.5 / 30)}) {
    const Books coarse = books_of(drop, "step = 1e-3"), fine = books_of(drop, "step = 5e-4"),
                by_default = books_of(drop, "");
    fmt::print(
        "lambda {}, gamma_1 {:.3g}, {} stages: balance {:.3g}, {:.3g} of {:.3g}, angular "
        "momentum {:.1g}; by default {:.2g} of what is exchanged\n",
        drop.lambda, drop.gamma_1, coarse.stages, coarse.balance, fine.balance, fine.exchanged,
        fine.angular_momentum, by_default.balance / by_default.exchanged);
    EXPECT_LT(fine.balance, 2e-4 * fine.exchanged);
    EXPECT_GT(coarse.balance / fine.balance, drop.gamma_1 < 0.1 ? 2 : 3);
    EXPECT_LT(by_default.balance, 1e-4 * by_default.exchanged);
    for (const Books& books : {fine, by_default}) EXPECT_LT(books.angular_momentum, 1e-13);
  }
}

TEST(Nematic, FindsTheRadialDirectorOfADiskAndABall) {
  for (const auto& row : test::cells_reference().at("nematic").at("hedgehog").at("rows")) {
    const bool ball = row.at("d") == 3;
    if (row.at("eps") < (ball ? 0.4 : 0.15)) continue;  // for verify_nematic
    const test::Radial found = ball ? test::radial<3>(row, 4, 2) : test::radial<2>(row, 8, 4);
    EXPECT_NEAR(found.energy, 0, 0.01) << row.dump();
    EXPECT_LT(found.profile, 0.01) << row.dump();
    if (!ball) continue;
    const test::Radial revolved = test::radial<2>(row, 12, 6, true);
    EXPECT_NEAR(revolved.energy, 0, 0.005) << row.dump();
    EXPECT_LT(revolved.profile, 0.005) << row.dump();
  }
}

/// The director makes the motion stiffer; an estimate of the stable step detects this only if the
/// director moves in trial displacements. At K = 20, a uniform director with lambda = -2.5 makes
/// the limit several times shorter.
TEST(Nematic, TheStableStepTakesTheDirectorAlong) {
  const auto limit = [](Real lambda) {
    NematicDrop drop;
    drop.K = 20;
    drop.gamma_1 = 20;
    drop.mu = 0.01;
    drop.lambda = lambda;
    drop.director = "1, 0";
    drop.more = "initial_velocity = [\"0.01*sin(9*y)\", \"0.01*cos(8*x)\"]\n";
    const auto scene_with = [&](const std::string& time) {
      return test::scene_of<2>(drop.scene(2, 6, 3, "viscosity = \"explicit\"\n" + time));
    };
    Scene<2> scene = scene_with("end = 1");
    State state = scene.initial;
    state.force.resize(state.u.size());
    const Real found = StableStepEstimator<2>(scene.system).estimate(state).dt;
    const auto error = [&](Real share) {
      Scene<2> free = scene_with("end = 1");
      State moving = free.initial;
      moving.force.resize(moving.u.size());
      StableStepEstimator<2>(free.system).estimate(moving);
      start(free.system, moving);
      const Real begin = take_ledger(free.system, moving).balance();
      for (int step = 0; step < 400; ++step) advance(free.system, moving, share * found);
      return std::abs(take_ledger(free.system, moving).balance() - begin);
    };
    EXPECT_LT(error(0.95), 1e-4);
    return found;
  };
  EXPECT_LT(limit(-2.5), 0.6 * limit(0));
}

/// The number of stages grows with the square root of step / limit of the field.
TEST(Nematic, RelaxesInABoundedNumberOfStages) {
  Disturbed<2> drop("");
  CarriedField& field = *drop.scene.system.carried.front();
  field.set_limit(1);
  EXPECT_EQ(field.stages(0), 2);
  EXPECT_EQ(field.stages(1e6), 2236);
  for (const Real limit : {1e-300, 0.0, std::nan("")}) {
    field.set_limit(limit);
    try {
      field.stages(1e6);
      FAIL() << limit;
    } catch (const SolveError& error) {
      EXPECT_NE(std::string(error.what()).find("a lower frank_constant"), std::string::npos)
          << error.what();
    }
  }
}

/// Largest error of a twisted radial director at the particles.
template <int D>
Real error_of_start(int core, int layers) {
  NematicDrop drop;
  drop.tension = false;
  const std::string r2 = D == 3 ? "(x^2 + y^2 + z^2)" : "(x^2 + y^2)",
                    f = fmt::format("/sqrt({} + 0.2)", r2),
                    twist = fmt::format("0.3*(1 - {})^2", r2);
  drop.director = fmt::format("\"x{0} - {1}*y\", \"y{0} + {1}*x\"{2}", f, twist,
                              D == 3 ? ", \"z" + f + "\"" : "");
  const Scene<D> scene = test::scene_of<D>(drop.scene(D, core, layers, "end = 1"));
  const Body<D>& body = scene.system.bodies.front();
  Real error = 0;
  for (Index A = 0; A < body.size(); ++A) {
    const Vec<D>& X = at(body.particles.X(), A);
    const Real radial = 1 / std::sqrt(X.squaredNorm() + 0.2),
               across = 0.3 * std::pow(1 - X.squaredNorm(), 2);
    Vec<D> h = radial * X;
    h[0] -= across * X[1];
    h[1] += across * X[0];
    const Lanes found = value_at(body.at_particles, A, director_of(scene.initial).data());
    for (int i = 0; i < D; ++i) error = std::max(error, std::abs(found[i] - h[i]));
  }
  return error;
}

/// If the formulas gave the coefficients, the errors would be 0.012 and 0.031.
TEST(Nematic, StartsWithTheValuesOfItsFormulas) {
  EXPECT_LT(error_of_start<2>(4, 2), 2e-3);
  EXPECT_LT(error_of_start<3>(4, 2), 2e-3);
}

TEST(Nematic, RefusesWhatCannotBe) {
  const auto complaint = [](const NematicDrop& drop, const std::string& more = "") -> std::string {
    try {
      test::scene_of<2>(drop.scene(2, 4, 2, "end = 1") + more);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  NematicDrop drop;
  drop.director = "\"3*x\", \"y\"";
  EXPECT_NE(complaint(drop).find("initial_director: has the length"), std::string::npos)
      << complaint(drop);
  drop.director = "1, 0";
  drop.gamma_1 = 0;
  EXPECT_NE(complaint(drop).find("rotational_viscosity"), std::string::npos) << complaint(drop);
  drop.gamma_1 = 1;
  EXPECT_EQ(complaint(drop), "");
  const std::string no_director =
      "dimension = 2\n[time]\nend = 1\n" + test::ball_of(2, 4, 2) +
      "material = { type = \"newtonian\", density = 1, bulk_modulus = 20, viscosity = 1 }\n" +
      test::law_of("anchoring", "strength = 1\n");
  try {
    test::scene_of<2>(no_director);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what())
                  .find("\"anchoring\" acts on a director, which body 'b' has "
                        "none of; expected is a body whose material is "
                        "\"nematic\""),
              std::string::npos)
        << error.what();
  }
}

/// In an axisymmetric flow, the director of a hedgehog stays in planes through the axis. Its couple
/// h x s is therefore azimuthal.
TEST(Nematic, CouplesOfAnAxisymmetricFlowAreAzimuthal) {
  NematicDrop drop;
  drop.lambda = -2;
  drop.anchoring = "strength = 2\nsense = \"polar\"\n";
  const std::string f =
      "(1.13664 - 0.15483*(x^2+y^2+z^2) + 0.08937*(x^2+y^2+z^2)^2)/sqrt(x^2+y^2+z^2"
      " + 0.2)";
  drop.director = "\"x*" + f + "\", \"y*" + f + "\", \"z*" + f + "\"";
  drop.more = "initial_velocity = [\"0.3*x\", \"0.3*y\", \"-0.6*z\"]\n";
  Scene<3> scene = test::scene_of<3>(drop.scene(3, 6, 3, "end = 1"));
  Simulation<3> simulation(scene);
  simulation.begin();
  while (simulation.state().time < 0.05) simulation.advance();
  const Body<3>& body = scene.system.bodies.front();
  std::vector<Real> m(3 * static_cast<std::size_t>(body.size()));
  for (const BodyField& field : scene.fields)
    if (field.source.name == "director_couple")
      field.source.compute(simulation.state().motion(), m);
  const auto& x = body.particles.X();  // a flow along the axis keeps directors in their planes
  Real azimuthal = 0, rest = 0;
  for (Index A = 0; A < body.size(); ++A) {
    const Vec<3> couple(at(m, 3 * A), at(m, 3 * A + 1), at(m, 3 * A + 2)),
        around = Vec<3>(-at(x, A)[1], at(x, A)[0], 0);
    const Real along = around.norm() > 1e-9 ? couple.dot(around) / around.norm() : 0;
    azimuthal += body.cells.volume(A) * along * along;
    rest += body.cells.volume(A) * (couple.squaredNorm() - along * along);
  }
  EXPECT_GT(azimuthal, 1e-4);
  EXPECT_LT(std::sqrt(rest / azimuthal), 0.05);
}

/// The couple h x s exists while a flow turns the director away from its equilibrium, and vanishes
/// with the flow.
TEST(Nematic, CouplesEndWithTheFlow) {
  NematicDrop drop;
  drop.lambda = -2;
  drop.anchoring = "strength = 2\nsense = \"polar\"\n";
  drop.director = "\"x/sqrt(x^2 + y^2 + 0.08)\", \"y/sqrt(x^2 + y^2 + 0.08)\"";
  drop.more = "initial_velocity = [\"0.3*x\", \"-0.3*y\"]\n";
  Scene<2> scene = test::scene_of<2>(drop.scene(2, 6, 3, "end = 8"));
  scene.initial.fields = test::relaxed_director(scene).fields;
  Simulation<2> simulation(scene);
  simulation.begin();
  const auto couple = [&] {
    return test::measured(scene, simulation.state(), "b.director_couple");
  };
  EXPECT_LT(couple(), 2e-3);
  Real greatest = 0;
  while (!simulation.finished()) {
    simulation.advance();
    if (simulation.state().step % 10 == 0) greatest = std::max(greatest, couple());
  }
  EXPECT_GT(greatest, 0.05);
  EXPECT_LT(couple(), 1e-2 * greatest);
}

}  // namespace
}  // namespace meniscus::test_nematic
