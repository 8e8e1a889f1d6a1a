// SPDX-License-Identifier: BSD-3-Clause
// Properties of every rigid partner: identities, continuation through the surface, motion.
#include "contact_reference.hpp"
#include "meniscus/error.hpp"
#include "physics/contact/rigid/rigid_motion.hpp"
#include "physics/contact/rigid/rigid_partner.hpp"
#include "thrown.hpp"

#include <functional>
#include <random>

namespace meniscus::test_rigid_partners {
namespace {

using test::expect_relative;

template <int D>
struct Case {
  std::string name;
  ContactLaw law;
  std::unique_ptr<RigidPartner<D>> partner;
  bool corners = false;
};

template <int D>
std::vector<Case<D>> cases() {
  std::vector<Case<D>> all;
  std::vector<ContactLaw> laws{{PairKernel::space, 1.3, 0.4}};
  if constexpr (D == 2) laws = {{PairKernel::integrated, 1.3, 0.4}, {PairKernel::planar, 1.3, 0.4}};
  for (const ContactLaw& law : laws) {
    Vec<D> centre = Vec<D>::Constant(0.1), normal = Vec<D>::Ones();
    normal[0] = -0.4;
    const auto add = [&](const std::string& name, std::unique_ptr<RigidPartner<D>> partner,
                         bool corners = false) {
      all.push_back(
          {name + ", " + std::string(name_of(law.kernel)), law, std::move(partner), corners});
    };
    add("half space", rigid_half_space<D>(law, 1.7, centre, normal));
    add("ball", rigid_ball<D>(law, 1.7, centre, 0.9));
    add("large cavity", rigid_cavity<D>(law, 1.7, centre, 1.6));
    if constexpr (D == 2) {
      add("frame", rigid_frame(law, 1.7, {-1.4, -1.2}, {1.6, 1.5}), true);
      add("thick frame", rigid_frame(law, 1.7, {-1.4, -1.2}, {1.6, 1.5}, 0.5), true);
      add("L",
          rigid_polygons(law, 1.7,
                         {{{0, 0}, {1.5, 0}, {1.5, 0.7}, {0.7, 0.7}, {0.7, 1.6}, {0, 1.6}}}),
          true);
    }
  }
  return all;
}

/// Central difference of sixth order of a vector field.
template <int D>
Mat<D> gradient(const std::function<Vec<D>(const Vec<D>&)>& f, const Vec<D>& x, Real h) {
  Mat<D> gradient;
  for (int j = 0; j < D; ++j) {
    const auto g = [&](int k) { return f(x + k * h * Vec<D>::Unit(j)); };
    gradient.col(j) = (45 * (g(1) - g(-1)) - 9 * (g(2) - g(-2)) + (g(3) - g(-3))) / (60 * h);
  }
  return gradient;
}

/// Calls check(case, x, distance in sigma0) for many points whose distances lie in this range.
template <int D, class Check>
void for_points(Real from, Real to, Check&& check) {
  std::mt19937 random(5);
  std::uniform_real_distribution<Real> place(-2.5, 2.5);
  for (const Case<D>& c : cases<D>()) {
    int found = 0;
    for (int i = 0; i < 2000 && found < 40; ++i) {
      Vec<D> x;
      for (int d = 0; d < D; ++d) x[d] = place(random);
      const Real z = c.partner->distance(x) / c.law.sigma0;
      if (z < from || z > to) continue;
      ++found;
      check(c, x, z);
    }
    EXPECT_GE(found, 20) << c.name;
  }
}

template <int D>
void expect_identities() {
  for_points<D>(1.02 * least_gap, 1e9, [](const Case<D>& c, const Vec<D>& x, Real z) {
    const auto f = c.partner->field(x);
    const Real size = f.grad_S.norm(), tolerance = 1e-11 * size;
    EXPECT_NEAR(f.grad_S.trace(), f.U, 1e-13 * size) << c.name << ", z " << z;
    EXPECT_NEAR((f.grad_S - f.grad_S.transpose()).norm(), 0, tolerance) << c.name << ", z " << z;
    const auto S = [&](const Vec<D>& y) { return c.partner->field(y).S; };
    const Mat<D> slope = gradient<D>(S, x, 0.002 * z * c.law.sigma0);
    EXPECT_NEAR((slope - f.grad_S).norm(), 0, 1e-8 * size) << c.name << ", z " << z;
  });
}
TEST(RigidPartner, DivSIsUAndGradSItsGradient) {
  expect_identities<2>();
  expect_identities<3>();
}

/// Points nearer than the least gap, and inside the material.
template <int D>
void expect_continuation() {
  for_points<D>(-0.5, 0.95 * least_gap, [](const Case<D>& c, const Vec<D>& x, Real z) {
    const auto f = c.partner->field(x);
    const auto S = [&](const Vec<D>& y) { return c.partner->field(y).S; };
    const Mat<D> slope = gradient<D>(S, x, 1e-4 * c.law.sigma0);
    if (!c.corners) {
      EXPECT_NEAR((slope - f.grad_S).norm(), 0, 1e-6 * slope.norm()) << c.name;
    }
    EXPECT_NEAR(f.grad_S.trace(), f.U, 1e-13 * f.grad_S.norm()) << c.name;
    EXPECT_GT(f.U, 0) << c.name << ", z " << z;
  });
}
TEST(RigidPartner, RepelsPointsThatCameThrough) {
  expect_continuation<2>();
  expect_continuation<3>();
}

/// U increases along a path through the surface.
template <int D>
void expect_growing(const RigidPartner<D>& partner, Vec<D> from, Vec<D> direction, Real sigma0) {
  Real before = 0;
  for (Real z = 0.55; z > -0.6; z -= 0.01) {
    const auto f = partner.field(from + z * sigma0 * direction);
    EXPECT_GT(f.U, before) << z;
    before = f.U;
    const auto along = [&](Real dz) {
      return direction.dot(partner.field(from + (z + dz) * sigma0 * direction).S) / sigma0;
    };
    if (std::abs(z - least_gap) > 1e-3) {
      expect_relative((along(1e-5) - along(-1e-5)) / 2e-5, direction.dot(f.grad_S * direction),
                      1e-5, "dS/dn");
    }
  }
  const auto at_gap = [&](Real z) { return partner.field(from + z * sigma0 * direction); };
  const auto out = at_gap(least_gap + 1e-12), in = at_gap(least_gap - 1e-12);
  EXPECT_NEAR((out.S - in.S).norm(), 0, 1e-10 * out.S.norm());
  EXPECT_NEAR((out.grad_S - in.grad_S).norm(), 0, 1e-9 * out.grad_S.norm());
}
TEST(RigidPartner, GrowsMoreRepulsiveWithTheDepth) {
  const ContactLaw space{PairKernel::space, 1.3, 0.4};
  const Vec<3> x = Vec<3>::UnitX(), o = Vec<3>::Zero();
  expect_growing<3>(*rigid_half_space<3>(space, 1, o, x), o, x, 0.4);
  expect_growing<3>(*rigid_ball<3>(space, 1, o, 0.9), 0.9 * x, x, 0.4);
  expect_growing<3>(*rigid_cavity<3>(space, 1, o, 0.9), 0.9 * x, -x, 0.4);
  for (const PairKernel kernel : {PairKernel::integrated, PairKernel::planar}) {
    const ContactLaw law{kernel, 1.3, 0.4};
    const Vec<2> e = Vec<2>::UnitX(), c = Vec<2>::Zero();
    expect_growing<2>(*rigid_half_space<2>(law, 1, c, e), c, e, 0.4);
    expect_growing<2>(*rigid_ball<2>(law, 1, c, 0.9), 0.9 * e, e, 0.4);
    expect_growing<2>(*rigid_cavity<2>(law, 1, c, 0.9), 0.9 * e, -e, 0.4);
    expect_growing<2>(*rigid_frame(law, 1, {-1, -2}, {3, 2}), -e, e, 0.4);
  }
}

TEST(RigidPartner, RefusesNonsense) {
  const Vec<3> o = Vec<3>::Zero();
  EXPECT_THROW_WITH(rigid_half_space<3>({}, 1, o, o), InputError, "a normal that is not zero");
  EXPECT_THROW_WITH(rigid_half_space<3>({PairKernel::planar}, 1, o, Vec<3>::UnitX()), InputError,
                    "in 3 dimensions cannot have the kernel 'planar'; allowed is 'space'");
  EXPECT_THROW_WITH(
      rigid_polygons({}, 1, {{Vec<2>(0, 0), Vec<2>(1, 0), Vec<2>(0, 1)}}), InputError,
      "in 2 dimensions cannot have the kernel 'space'; allowed is 'integrated' or 'planar'");
  EXPECT_THROW_WITH(rigid_ball<3>({}, 1, o, 0), InputError,
                    "the radius of a rigid ball must be > 0, not 0");
  EXPECT_THROW_WITH(rigid_cavity<3>({}, 1, o, -1), InputError,
                    "the radius of a rigid cavity must be > 0, not -1");
  EXPECT_THROW_WITH(rigid_cavity<3>({}, 1, o, 0.9 * least_gap), InputError,
                    "the radius of a rigid cavity must be greater than");
}

TEST(RigidMotion, IsTheFormulaAndItsDerivative) {
  const RigidMotion<2> rest;
  EXPECT_FALSE(rest.moves());
  EXPECT_EQ(rest.displacement(3), (Vec<2>::Zero()));
  const RigidMotion<2> moved({Expression(0.5), Expression("2*3")});
  EXPECT_FALSE(moved.moves());
  EXPECT_EQ(moved.displacement(3), (Vec<2>(0.5, 6)));
  EXPECT_EQ(moved.velocity(3, 0.1), (Vec<2>::Zero()));
  const RigidMotion<3> motion({Expression("t^4"), Expression("sin(2*t)"), Expression(1.0)});
  EXPECT_TRUE(motion.moves());
  const Vec<3> v = motion.velocity(1.5, 1e-3);
  EXPECT_NEAR(v[0], 4 * 1.5 * 1.5 * 1.5, 1e-11);
  EXPECT_NEAR(v[1], 2 * std::cos(3.0), 1e-11);
  EXPECT_EQ(v[2], 0);
}

/// Some of the four points are nearer than the least gap, some are inside the material.
template <int D>
void expect_fields_of_points() {
  for (const Case<D>& c : cases<D>()) {
    SCOPED_TRACE(c.name);
    std::mt19937_64 generator(5);
    std::uniform_real_distribution<Real> place(-2, 2);
    for (int k = 0; k < 40; ++k) {
      LanePlace<D> x;
      for (Lanes& component : x)
        component = Lanes(place(generator), place(generator), place(generator), place(generator));
      const LaneField<D> all = c.partner->fields(x, Lanes::width);
      for (int lane = 0; lane < Lanes::width; ++lane) {
        Vec<D> point;
        for (int i = 0; i < D; ++i) point[i] = at(x, i)[lane];
        const RigidField<D> one = c.partner->field(point);
        const Real size = 1e-12 * one.grad_S.norm();
        EXPECT_NEAR(all.distance[lane], c.partner->distance(point), 1e-14);
        EXPECT_NEAR(all.U[lane], one.U, size);
        for (int i = 0; i < D; ++i) {
          EXPECT_NEAR(at(all.S, i)[lane], one.S[i], 1e-12 * one.S.norm());
          for (int j = 0; j < D; ++j)
            EXPECT_NEAR(at(at(all.grad_S, i), j)[lane], one.grad_S(i, j), size);
        }
      }
    }
  }
}

TEST(RigidPartner, HasTheSameFieldAtFourPointsAtOnce) {
  expect_fields_of_points<2>();
  expect_fields_of_points<3>();
}

}  // namespace
}  // namespace meniscus::test_rigid_partners
