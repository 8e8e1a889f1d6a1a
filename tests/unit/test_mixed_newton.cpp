// SPDX-License-Identifier: BSD-3-Clause
// Newton's method with expected pressures and factors of the tangent: the assembled tangent, its
// pressures, iterations for any bulk modulus, known equilibria and their stability.
#include "cases.hpp"
#include "one_body.hpp"
#include "physics/mixed_force.hpp"
#include "run/simulation.hpp"
#include "solve/newton/quasi_statics.hpp"
#include "solve/newton/tangent_factors.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meniscus::test_mixed_newton {
namespace {

/// A body with a law, and a state of it with finite strains.
template <int D>
struct Deformed {
  test::OneBody<D> one;
  NodalVectors still, u;
  ForceTerm& force;
  MixedForce& mixed;

  Deformed(Geometry<D> geometry, const std::string& law, const std::string& keys)
      : Deformed(test::OneBody<D>(std::move(geometry), law, keys), law, nullptr) {}
  Deformed(Geometry<D> geometry, const std::string& law, const Integration& integration)
      : Deformed(test::OneBody<D>(std::move(geometry), law), law, &integration) {}
  Motion at(const NodalVectors& w) const { return {0, w, still}; }

 private:
  Deformed(test::OneBody<D> body, const std::string& law, const Integration* integration)
      : one(std::move(body)),
        still(one.state.u),
        u(test::random_field<D>(one.system.size(), 0.03, 5)),
        force(chosen(law, integration)),
        mixed(dynamic_cast<MixedForce&>(force)) {}
  ForceTerm& chosen(const std::string& law, const Integration* integration) {
    auto& term = one.system.terms.front();
    if (integration) term = test::internal_force<D>(one.body(), law, *integration);
    return *term;
  }

 public:
  /// Off-pressures that differ from point to point.
  std::vector<Lanes> off() const {
    std::vector<Lanes> off;
    const auto groups = mixed.pressures(at(u), at(still)).size();
    for (std::size_t g = 0; g < groups; ++g)
      off.push_back(Lanes(0.1, -0.2, 0.3, 0.05) * (1 + 0.1 * static_cast<Real>(g % 7)));
    return off;
  }
  /// Minus the tangent with these pressures, times w.
  NodalVectors tangent(const std::vector<Lanes>& off, const NodalVectors& w) {
    NodalVectors Kw = still;
    force.add_tangent(at(u), at(w), Kw);
    if (!off.empty()) mixed.add_pressure_tangent(at(u), at(w), off, Kw);
    for (NodalVector& f : Kw) f = -f;
    return Kw;
  }
};

template <int D>
NodalVectors product(const StiffnessMatrix& K, const NodalVectors& w) {
  std::vector<Real> x(static_cast<std::size_t>(K.unknowns()), 0.0), y = x;
  for (std::size_t A = 0; A < w.size(); ++A)
    for (int i = 0; i < D; ++i) x[A * D + static_cast<std::size_t>(i)] = w[A][i];
  for (Index j = 0; j < K.unknowns(); ++j)
    for (Index e = K.start()[static_cast<std::size_t>(j)];
         e < K.start()[static_cast<std::size_t>(j) + 1]; ++e)
      at(y, K.row()[static_cast<std::size_t>(e)]) +=
          K.value()[static_cast<std::size_t>(e)] * at(x, j);
  NodalVectors Kw(w.size(), Lanes::zero());
  for (std::size_t A = 0; A < w.size(); ++A)
    for (int i = 0; i < D; ++i) Kw[A].set(i, y[A * D + static_cast<std::size_t>(i)]);
  return Kw;
}

/// Without shared pressures, the matrix is the tangent to round-off, with other pressures, too.
template <int D>
void expect_assembled(const Integration& integration) {
  Deformed<D> body(test::potato<D>(), "neo_hookean", integration);
  const NodalVectors w = test::random_field<D>(body.one.system.size(), 1, 9);
  for (const std::vector<Lanes>& off : {std::vector<Lanes>(), body.off()}) {
    StiffnessMatrix K(body.one.system.size(), D);
    body.mixed.announce(K);
    K.close();
    if (K.unknowns() > body.one.system.size() * D) return;  // shared pressures
    K.clear();
    body.mixed.add_stiffness(body.at(body.u), off, K);
    K.complete();
    const NodalVectors exact = body.tangent(off, w);
    EXPECT_LT(test::norm(test::sum_of(exact, -1, product<D>(K, w))), 1e-12 * test::norm(exact))
        << integration.rule << integration.volumetric;
  }
}

TEST(StiffnessMatrix, IsTheTangent) {
  for (const Integration& integration : test::integrations()) {
    expect_assembled<2>(integration);
    expect_assembled<3>(integration);
  }
}

/// Shared pressures are further unknowns, with an exact inverse in place of the polynomial, so that
/// K^-1 times the tangent of the force is nearly one.
template <int D>
void expect_inverse(Real lambda) {
  Deformed<D> body(test::potato<D>(), "neo_hookean",
                   fmt::format("density = 1\nmu = 1\nlambda = {}\n", lambda));
  for (NodalVector& w : body.u) w *= 1 / lambda;
  TangentFactors<D> K(body.one.system);
  const FreeMotions<D> free(body.one.system, body.at(body.u), 1);
  K.assemble(0, body.u, {});
  // Only rotations can have negative eigenvalues, since forces are not in balance.
  EXPECT_LE(K.factor(K.small_shift()), D * (D - 1) / 2);
  NodalVectors w = test::random_field<D>(body.one.system.size(), 1, 9), z = w;
  free.remove_from(w);
  NodalVectors Kw = body.tangent({}, w);
  K.apply(Kw, z);
  free.remove_from(z);
  // In the norm of the tangent; the error of the polynomial is 0.05.
  const NodalVectors off = test::sum_of(z, -1, w);
  EXPECT_LT(test::dot(off, body.tangent({}, off)), 0.1 * 0.1 * test::dot(w, Kw)) << lambda;
}

TEST(TangentFactors, AreThoseOfTheTangentWithSharedPressures) {
  for (const Real lambda : {10.0, 1e3, 1e5}) {
    expect_inverse<2>(lambda);
    expect_inverse<3>(lambda);
  }
}

/// Pressures and their derivatives, and the tangent of constant pressures, against differences.
template <int D>
void expect_pressures(Real lambda) {
  Deformed<D> body(test::potato<D>(), "neo_hookean",
                   fmt::format("density = 1\nmu = 1\nlambda = {}\n", lambda));
  const NodalVectors w = test::random_field<D>(body.one.system.size(), 0.03, 9);
  constexpr Real h = 1e-5;
  const NodalVectors ahead = test::sum_of(body.u, h, w), behind = test::sum_of(body.u, -h, w);
  const auto here = body.mixed.pressures(body.at(body.u), body.at(w)),
             before = body.mixed.pressures(body.at(behind), body.at(w)),
             after = body.mixed.pressures(body.at(ahead), body.at(w));
  Real error = 0, size = 0;
  for (std::size_t g = 0; g < here.size(); ++g)
    for (int q = 0; q <= D; ++q) {
      error = std::max(error, std::abs((after[g].v[q] - before[g].v[q]) / (2 * h) - here[g].d[q]));
      size = std::max(size, std::abs(here[g].d[q]));
    }
  EXPECT_LT(error, 1e-7 * size) << lambda;

  const std::vector<Lanes> off = body.off();
  NodalVectors tangent = body.still, forth = body.still, back = body.still;
  const NodalVectors step = test::sum_of(body.still, h, w),
                     step_back = test::sum_of(body.still, -h, w);
  body.mixed.add_pressure_tangent(body.at(body.u), body.at(w), off, tangent);
  body.mixed.subtract_pressure_force(body.at(body.u), body.at(step), off, forth);
  body.mixed.subtract_pressure_force(body.at(body.u), body.at(step_back), off, back);
  const NodalVectors difference = test::sum_of(back, -1, forth);
  EXPECT_LT(test::norm(test::sum_of(difference, -2 * h, tangent)),
            1e-7 * 2 * h * test::norm(tangent));
}

TEST(MixedForce, PressuresHaveTheirDerivatives) {
  for (const Real lambda : {1.0, 1e3}) {
    expect_pressures<2>(lambda);
    expect_pressures<3>(lambda);
  }
}

/// A scene that has been run to its end, and its measures.
template <int D>
struct Solved {
  Scene<D> scene;
  Simulation<D> simulation;

  explicit Solved(const std::string& text) : scene(test::scene_of<D>(text)), simulation(scene) {
    simulation.begin();
    while (!simulation.finished()) simulation.advance();
  }
  const NewtonMethod<D>& newton() const {
    return dynamic_cast<const QuasiStatics<D>&>(simulation.stepper()).method();
  }
  Real measure(const std::string& name) const {
    for (const MeasureSource& m : scene.measures)
      if (m.name == name) return m.compute(simulation.state().motion());
    throw std::logic_error(name);
  }
};

/// Cook's membrane in four load steps.
std::string cook(int cells, Real ratio) {
  return fmt::format(
      "dimension = 2\n[time]\nsolver = \"newton\"\nend = 4\nstep = 1\n[[body]]\nname = \"panel\"\n"
      "shape = \"rectangle\"\ncorner = [0, 0]\nsize = [48, 1]\ncells = [{0}, {0}]\n"
      "map = [\"x\", \"44/48*x + y*(44 - 28/48*x)\"]\nmaterial = {{ type = \"neo_hookean\", "
      "density "
      "= 1, mu = 80.194, lambda = {1} }}\n[[held]]\nbody = \"panel\"\nface = \"x_min\"\n"
      "[[traction]]\nbody = \"panel\"\nface = \"x_max\"\nforce = [0, \"6.25*min(1, t/4)\"]\n"
      "[[probe]]\nname = \"tip\"\nbody = \"panel\"\nat = [48, 60]\n",
      cells, 80.194 * ratio);
}

/// Iterations do not grow with the bulk modulus, and solutions converge to an incompressible body.
TEST(MixedNewton, TakesFewIterationsForAnyBulkModulus) {
  std::vector<Real> tips;
  for (const Real ratio : {1.5, 50.0, 5e3, 5e4}) {
    const Solved<2> run(cook(8, ratio));
    EXPECT_LE(run.newton().iterations(), 4 * 6) << ratio;
    EXPECT_LE(run.newton().left(), 1e-9) << ratio;
    EXPECT_GT(run.newton().stability(), 0.5) << ratio;
    tips.push_back(run.measure("tip.displacement_y"));
  }
  EXPECT_NEAR(tips[2] / tips[3], 1, 1e-3);
}

/// A cylinder twisted by 0.8 radians per unit length between rigid plates (Rivlin 1948): torque pi
/// R^4 tau (c1 + c2) and axial force - pi R^4 tau^2 (c1 + 2 c2)/2 of an incompressible
/// Mooney-Rivlin rod, between its ends.
TEST(MixedNewton, TwistsARod) {
  constexpr Real R = 0.5, tau = 0.8, c1 = 0.3, c2 = 0.1;
  const Solved<3> run(
      "dimension = 3\n[time]\nsolver = \"newton\"\nend = 1\nstep = 0.5\n[[body]]\nname = \"bar\"\n"
      "shape = \"cylinder\"\nradius = 0.5\nheight = 1\ncore = 4\nrings = 1\nlayers = 4\nmaterial = "
      "{ type = \"mooney_rivlin\", density = 1, c1 = 0.3, c2 = 0.1, lambda = 500 }\n"
      "[[held]]\nbody = \"bar\"\nface = \"z_min\"\n[[held]]\nname = \"grip\"\nbody = \"bar\"\n"
      "face = \"z_max\"\nangle = \"0.8*t\"\n");
  EXPECT_LE(run.newton().iterations(), 2 * 8);
  const Real torque = std::numbers::pi * std::pow(R, 4) * tau * (c1 + c2),
             force = -std::numbers::pi * std::pow(R, 4) * tau * tau * (c1 + 2 * c2) / 2;
  EXPECT_NEAR(run.measure("grip.torque_z") / torque, 1, 0.03);
  EXPECT_NEAR(run.measure("grip.force_z") / force, 1, 0.05);
}

/// A bar that nothing holds, pulled at both ends by forces in balance: plane strain of a
/// neo-Hookean body, mu (a - 1/a^3) = 1, nearly incompressible.
TEST(MixedNewton, PullsAFreeBar) {
  const auto face = [](const std::string& name, const std::string& force) {
    return "[[traction]]\nname = \"" + name + "\"\nbody = \"bar\"\nface = \"" + name +
           "\"\nforce = [\"" + force + "\", 0]\n";
  };
  const Solved<2> run(
      "dimension = 2\n[time]\nsolver = \"newton\"\nend = 2\nstep = 1\n[[body]]\nname = \"bar\"\n"
      "shape = \"rectangle\"\nsize = [4, 1]\ncells = [8, 3]\nmaterial = { type = \"neo_hookean\", "
      "density = 1, mu = 1, lambda = 5000 }\n" +
      face("x_max", "t/2") + face("x_min", "-t/2"));
  EXPECT_LE(run.newton().iterations(), 2 * 6);
  EXPECT_GT(run.newton().stability(), 0.1);
  const Real stretch = run.measure("bar.extent_x") / 4;
  EXPECT_NEAR(stretch - std::pow(stretch, -3), 1, 1e-3);
}

}  // namespace
}  // namespace meniscus::test_mixed_newton
