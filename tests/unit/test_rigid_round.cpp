// SPDX-License-Identifier: BSD-3-Clause
// Rigid half spaces, balls, cylinders and cavities against reference values and their limits.
#include "body/grid/gauss.hpp"
#include "contact_reference.hpp"
#include "physics/contact/rigid/rigid_partner.hpp"
#include "physics/contact/rigid/round_field.hpp"

#include <type_traits>

namespace meniscus::test_rigid_round {
namespace {

using test::contact_references;
using test::expect_relative;

constexpr Real pi = std::numbers::pi;
const ContactLaw unit_space{PairKernel::space, 1, 1};
const ContactLaw unit_integrated{PairKernel::integrated, 1, 1};
const ContactLaw unit_planar{PairKernel::planar, 1, 1};

TEST(RigidHalfSpace, HasTheReferenceValues) {
  for (const auto& reference : contact_references("halfspace_sigma1_zz_eq3.34")) {
    const Real a = reference.inputs["a"];
    const Vec<3> up = Vec<3>::UnitZ();
    const auto f = rigid_half_space<3>(unit_space, 1, Vec<3>::Zero(), up)->field(a * up);
    EXPECT_NEAR(-f.U, reference.value[0], 1e-12 * std::abs(reference.value[0]) + 1e-14);
    EXPECT_EQ(f.grad_S(2, 2), f.U);
    const auto line = rigid_half_space<2>(unit_integrated, 1, Vec<2>::Zero(), Vec<2>::UnitY());
    const auto g = line->field({7, a});
    EXPECT_EQ(g.U, f.U);
    EXPECT_EQ(g.S[1], f.S[2]);
  }
  const auto planar = contact_references("planar_variant_halfplane_U")[0];
  const auto half_plane = rigid_half_space<2>(unit_planar, 1, Vec<2>::Zero(), Vec<2>::UnitX());
  const Real a = planar.inputs["a"];
  expect_relative(half_plane->field({a, 3}).U, planar.value[0], planar.rel_tol, "planar");
}

TEST(RigidHalfSpace, TiltsAndScales) {
  const ContactLaw law{PairKernel::space, 2.3, 0.6};
  const Vec<3> normal(1, -2, 2), m = normal / 3, point(0.4, 0.1, -0.7);
  const auto partner = rigid_half_space<3>(law, 1.9, point, normal);
  const Vec<3> x = point + 0.45 * m + Vec<3>(2, 1, 0);  // (2, 1, 0).m = 0
  EXPECT_NEAR(partner->distance(x), 0.45, 1e-15);
  const auto f = partner->field(x);
  const Real s = std::pow(0.6 / 0.45, 6), volume = pi * 2.3 * std::pow(0.45, 3) * 1.9;
  expect_relative(f.U, volume * (s * s / 45 - s / 3), 1e-14, "U");
  EXPECT_NEAR((f.S + volume * 0.45 * (s * s / 360 - s / 6) * m).norm(), 0, 1e-14 * f.S.norm());
  EXPECT_NEAR((f.grad_S - f.U * m * m.transpose()).norm(), 0, 1e-14 * std::abs(f.U));
}

/// {tangential stress, radial stress, U} for unit density as in the references: Sigma = -grad S.
/// Full balls are tested inside, too.
template <int D>
std::vector<Real> ball_values(const ContactLaw& law, Real a, Real R) {
  const RadialField f = std::conditional_t<D == 3, SphereField, CylinderField>(law, R).at(a);
  return {-f.tangent, (D - 1) * f.tangent - f.U, f.U};
}

template <int D>
void expect_ball_references(const std::string& name, const ContactLaw& law) {
  for (const auto& reference : contact_references(name)) {
    const auto values = ball_values<D>(law, reference.inputs["a"], reference.inputs["R"]);
    for (int i = 0; i < 3; ++i)
      expect_relative(at(values, i), at(reference.value, i), reference.rel_tol,
                      name + reference.inputs.dump() + " " + std::to_string(i));
  }
}

TEST(RigidBall, HasTheReferenceValues) {
  expect_ball_references<3>("sphere_sigma1_[tangential,radial]_and_U", unit_space);
  const auto radial = contact_references("sphere_S_radial")[0];
  const Real a = radial.inputs["a"], R = radial.inputs["R"];
  const auto ball = rigid_ball<3>(unit_space, 1, Vec<3>::Zero(), R);
  expect_relative(ball->field({0, a, 0}).S[1], radial.value[0], radial.rel_tol, "S");
}

TEST(RigidCylinder, HasTheReferenceValues) {
  expect_ball_references<2>("planestrain_cylinder_sigma1_[tangential,radial]_and_U",
                            unit_integrated);
  expect_ball_references<2>("planar_variant_cylinder_sigma1_[tangential,radial]_and_U",
                            unit_planar);
}

/// The tensors of partners against their radial values; a cavity has the opposite sign of the ball.
template <int D>
void expect_tensors(const ContactLaw& law) {
  const Vec<D> centre = Vec<D>::Constant(0.3), k = Vec<D>::Ones().normalized();
  for (const Real a : {1.1, 3.0, 5.8}) {
    const bool inside = a < 2;
    const auto partner =
        inside ? rigid_cavity<D>(law, 2, centre, 2) : rigid_ball<D>(law, 2, centre, 2);
    const auto f = partner->field(centre + a * k);
    const auto v = ball_values<D>(law, a, 2);
    const Real beta = inside ? -2 : 2;
    const Mat<D> kk = k * k.transpose();
    const Mat<D> sigma = v[0] * (Mat<D>::Identity() - kk) + v[1] * kk;
    const Real tolerance = 1e-13 * sigma.norm();
    EXPECT_NEAR(f.U, beta * v[2], tolerance);
    EXPECT_NEAR((f.S + beta * a * v[0] * k).norm(), 0, a * tolerance);
    EXPECT_NEAR((f.grad_S + beta * sigma).norm(), 0, 4 * tolerance);
    EXPECT_NEAR(partner->distance(centre + a * k), std::abs(a - 2), 1e-15);
  }
  EXPECT_EQ(rigid_cavity<D>(law, 2, centre, 2)->field(centre).S, (Vec<D>::Zero()));
}
TEST(RigidBall, HasTheFieldOfItsRadialValues) {
  expect_tensors<3>(unit_space);
  expect_tensors<2>(unit_integrated);
  expect_tensors<2>(unit_planar);
}

/// S and U of a cylinder from the definition: the trapezoidal rule on its circle, which converges
/// exponentially. The number of points grows as the place approaches the circle.
TEST(RigidCylinder, IsTheIntegralOverItsCircle) {
  const Real R = 3;
  for (const ContactLaw& law : {unit_integrated, unit_planar})
    for (const Real a : {0.02, 0.6, 1.04, 1.06, 2.2, 2.7, 3.3, 3.8, 5.0, 8.5, 8.6, 40.0}) {
      const int n = static_cast<int>(60 * (R + a) / std::abs(a - R)) + 60;
      Real U = 0, S = 0;
      for (int i = 0; i < n; ++i) {
        const Real angle = 2 * pi * i / n, line = 2 * pi * R / n;
        const Vec<2> normal(std::cos(angle), std::sin(angle)), r = Vec<2>(a, 0) - R * normal;
        const auto f = pair_functions(law, r.norm());
        U += line * f.psi * r.dot(normal);
        S += line * f.u * normal[0];
      }
      const RadialField f = CylinderField(law, R).at(a);
      // Near its zero, U has the error of the rounding of its sum.
      const Real size = std::abs(U) + std::pow(std::abs(a - R), -6);
      EXPECT_NEAR(f.U, U, 2e-13 * size) << name_of(law.kernel) << " a " << a;
      EXPECT_NEAR(f.tangent, S / a, 2e-13 * (std::abs(S / a) + size))
          << name_of(law.kernel) << " a " << a;
    }
}

/// dU/da by differences of sixth order.
TEST(RigidBall, SlopeIsTheDerivativeOfU) {
  const auto expect_slope = [](const auto& field, Real a) {
    const Real h = 2e-3 * std::abs(a - 2);
    const auto f = [&](int k) { return field.at(a + k * h).U; };
    const Real slope = (45 * (f(1) - f(-1)) - 9 * (f(2) - f(-2)) + (f(3) - f(-3))) / (60 * h);
    expect_relative(field.slope(a), slope, 1e-9, "dU/da at " + std::to_string(a));
  };
  for (const Real a : {0.3, 1.5, 2.4, 3.0, 9.0}) {
    expect_slope(SphereField({PairKernel::space, 1.2, 0.7}, 2), a);
    expect_slope(CylinderField({PairKernel::integrated, 1.2, 0.7}, 2), a);
    expect_slope(CylinderField({PairKernel::planar, 1.2, 0.7}, 2), a);
  }
}

/// The near and far formulas agree to the last digits, on both sides of their switch.
TEST(RigidBall, SeriesAndClosedFormAgree) {
  for (const Real R : {0.7, 5.0}) {
    for (const Real ratio : {0.25, 4.0}) {
      const Real a = R * ratio;
      const auto before = ball_values<3>(unit_space, a * (1 - 1e-15), R);
      const auto after = ball_values<3>(unit_space, a * (1 + 1e-15), R);
      for (int i = 0; i < 3; ++i) expect_relative(at(before, i), at(after, i), 1e-12, "sphere");
    }
    for (const ContactLaw& law : {unit_integrated, unit_planar})
      for (const Real ratio : {0.35, 1 / 0.35}) {
        const Real a = R * ratio;
        const auto before = ball_values<2>(law, a * (1 - 1e-15), R);
        const auto after = ball_values<2>(law, a * (1 + 1e-15), R);
        for (int i = 0; i < 3; ++i) expect_relative(at(before, i), at(after, i), 1e-12, "cylinder");
      }
  }
}

/// A distant ball acts as a point with all its particles, U = V phi.
TEST(RigidBall, IsAPointFarAway) {
  for (const Real a : {1e3, 1e5}) {
    const Real volume = 4 * pi / 3, phi = -2 * std::pow(a, -6);
    expect_relative(ball_values<3>(unit_space, a, 1)[2], volume * phi, 10 / (a * a), "sphere");
    const auto cylinder = pair_functions(unit_integrated, a).phi * pi;
    expect_relative(ball_values<2>(unit_integrated, a, 1)[2], cylinder, 10 / (a * a), "cylinder");
  }
}

TEST(RigidBall, BecomesAPlate) {
  const auto plate = rigid_half_space<3>(unit_space, 1, Vec<3>::Zero(), Vec<3>::UnitX());
  const Real U = plate->field({0.7, 0, 0}).U;
  for (const Real R : {1e2, 1e4, 1e6}) {
    const auto outside = ball_values<3>(unit_space, R + 0.7, R);
    const auto inside = ball_values<3>(unit_space, R - 0.7, R);
    // At this gap, near the zero of U, the relative curvature term is 5 gap/R; for a cavity it is
    // negative.
    EXPECT_NEAR(outside[2], U, 5 / R);
    EXPECT_NEAR(-inside[2], U, 5 / R);
    EXPECT_NEAR(outside[0], 0, 5 / R);
    EXPECT_NEAR(-outside[1], U, 5 / R);
    const auto cylinder = ball_values<2>(unit_integrated, R + 0.7, R);
    EXPECT_NEAR(cylinder[2], U, 5 / R);
    EXPECT_NEAR(-cylinder[1], U, 5 / R);
  }
  const auto half_plane = rigid_half_space<2>(unit_planar, 1, Vec<2>::Zero(), Vec<2>::UnitX());
  EXPECT_NEAR(ball_values<2>(unit_planar, 1e6 + 0.7, 1e6)[2], half_plane->field({0.7, 0}).U, 1e-5);
}

/// Force (form B) along x and energy of a sphere of radius R around the origin in a field that is
/// axisymmetric about x, with Gauss points on panels that halve towards both poles.
std::array<Real, 2> force_and_energy(const RigidPartner<3>& partner, Real R) {
  const GaussRule rule = gauss_rule(20);
  std::array<Real, 2> sum{0, 0};
  Real begin = 0;
  for (int panel = 0; panel < 24; ++panel) {
    const Real end = panel < 23 ? pi * std::pow(0.5, 0.5 * (23 - panel)) : pi;
    for (int q = 0; q < 20; ++q) {
      const Real half = (end - begin) / 2, angle = begin + half * (1 + at(rule.x, q));
      const Vec<3> n(std::cos(angle), std::sin(angle), 0);
      const auto f = partner.field(R * n);
      const Real area = at(rule.w, q) * half * 2 * pi * std::sin(angle) * R * R;
      sum[0] -= area * f.U * n[0];
      sum[1] += area * f.S.dot(n);
    }
    begin = end;
  }
  return sum;
}

TEST(RigidPartner, PutsTheExactForceAndEnergyOnASphere) {
  for (const auto& reference : contact_references("sphere_halfspace_[F_repulsive,E]")) {
    const Real g = reference.inputs["g"], R = reference.inputs["R"];
    const auto plate = rigid_half_space<3>(unit_space, 1, Vec<3>(R + g, 0, 0), -Vec<3>::UnitX());
    const auto [force, energy] = force_and_energy(*plate, R);
    expect_relative(-force, reference.value[0], reference.rel_tol, "force of the plate");
    expect_relative(energy, reference.value[1], reference.rel_tol, "energy of the plate");
  }
  for (const auto& reference : contact_references("two_spheres_[F_repulsive,E]")) {
    const Real D = reference.inputs["D"], R1 = reference.inputs["R1"], R2 = reference.inputs["R2"];
    const auto ball = rigid_ball<3>(unit_space, 1, Vec<3>(D, 0, 0), R2);
    const auto [force, energy] = force_and_energy(*ball, R1);
    expect_relative(-force, reference.value[0], reference.rel_tol, "force of the ball");
    expect_relative(energy, reference.value[1], reference.rel_tol, "energy of the ball");
  }
}

}  // namespace
}  // namespace meniscus::test_rigid_round
