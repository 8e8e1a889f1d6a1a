// SPDX-License-Identifier: BSD-3-Clause
// Tangents of the terms against differences of their forces; linear, and symmetric for terms with
// an energy.
#include "contact_support.hpp"
#include "physics/loads/body_force.hpp"
#include "physics/loads/cavity.hpp"
#include "physics/surface/surface_tension.hpp"
#include "stiffness_support.hpp"
#include "support.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

namespace meniscus::test_tangent {
namespace {

/// Displacements and velocities, or their changes, of all particles.
struct Fields {
  NodalVectors u, v;
  Motion motion() const { return {0.3, u, v}; }
};

Fields sum_of(const Fields& a, Real s, const Fields& b) {
  return {test::sum_of(a.u, s, b.u), test::sum_of(a.v, s, b.v)};
}

NodalVectors force_of(ForceTerm& term, const Fields& at) {
  NodalVectors f = test::zeros(at.u);
  term.add_force(at.motion(), f);
  return f;
}

NodalVectors tangent_of(ForceTerm& term, const Fields& at, const Fields& change) {
  NodalVectors f = test::zeros(at.u);
  term.add_tangent(at.motion(), change.motion(), f);
  return f;
}

/// Central differences of eighth order.
NodalVectors difference_of(ForceTerm& term, const Fields& at, const Fields& change, Real h) {
  constexpr std::array<Real, 4> weight{4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
  NodalVectors sum = test::zeros(at.u);
  for (int k = 1; k <= 4; ++k)
    for (const int sign : {1, -1})
      sum = test::sum_of(sum, sign * meniscus::at(weight, k - 1) / h,
                         force_of(term, sum_of(at, sign * k * h, change)));
  return sum;
}

template <int D>
Fields random_fields(Index size, Real u, Real v, unsigned seed) {
  return {test::random_field<D>(size, u, seed), test::random_field<D>(size, v, seed + 1)};
}

template <int D>
void expect_tangent(ForceTerm& term, Index size) {
  SCOPED_TRACE(term.name());
  const Fields at = random_fields<D>(size, 0.02, 0.5, 7),
               change = random_fields<D>(size, 0.1, 0.1, 11),
               other = random_fields<D>(size, 0.1, 0.1, 13);
  const NodalVectors tangent = tangent_of(term, at, change);
  const NodalVectors difference = difference_of(term, at, change, 1e-2);
  EXPECT_GT(test::norm(difference), 0);
  EXPECT_LT(test::norm(test::sum_of(tangent, -1, difference)), 1e-10 * test::norm(difference));
  // The tangent is linear.
  const NodalVectors both = tangent_of(term, at, sum_of(change, -0.5, other));
  const NodalVectors sum = test::sum_of(tangent, -0.5, tangent_of(term, at, other));
  EXPECT_LT(test::norm(test::sum_of(both, -1, sum)), 1e-12 * test::norm(sum));
  auto* assembled = dynamic_cast<AssembledForce*>(&term);
  if (assembled && assembled->has_stiffness() && term.energy_kind() != "strain") {
    const NodalVectors still = test::zeros(at.u);
    const NodalVectors of_u = tangent_of(term, {at.u, still}, {change.u, still});
    EXPECT_LT(test::norm(test::sum_of(
                  test::assembled_tangent<D>(*assembled, {0.3, at.u, still}, change.u), -1, of_u)),
              (term.name().starts_with("cavity") ? 5e-3 : 1e-6) * test::norm(of_u));
  }
  // The tangent of an energy is symmetric for displacements; viscous forces have no energy.
  if (!term.stored_energy(at.motion())) return;
  const Fields still{at.u, test::zeros(at.u)};
  const Fields a{change.u, still.v}, b{other.u, still.v};
  const NodalVectors along_a = tangent_of(term, still, a), along_b = tangent_of(term, still, b);
  const Real one = test::dot(b.u, along_a), two = test::dot(a.u, along_b);
  EXPECT_LT(std::abs(one - two), 1e-12 * test::norm(along_a) * test::norm(b.u));
}

/// Every law with every rule, for fluids also with the enclosed volume.
template <int D>
void expect_tangents_of_laws() {
  const auto body = test::body_of<D>(test::potato<D>());
  for (const auto& [law, entry] : laws())
    for (const Integration& integration : test::integrations()) {
      SCOPED_TRACE(law + " " + integration.rule + " " + integration.volumetric);
      expect_tangent<D>(*test::internal_force<D>(*body, law, integration), body->size());
    }
  for (const std::string volumetric : {"full", "cell_average"})
    for (const std::string equation : {"linear", "log", "tait"})
      for (const std::string viscosity : {"0", "0.5"}) {
        SCOPED_TRACE(volumetric + " " + equation + " " + viscosity);
        const auto term =
            test::internal_force<D>(*body, "newtonian",
                                    "density = 1\nbulk_modulus = 2\nequation_of_state = \"" +
                                        equation + "\"\nviscosity = " + viscosity + "\n",
                                    {"q_scni", 0, volumetric, true});
        expect_tangent<D>(*term, body->size());
      }
  for (const std::string director : {"normal", "convected"})
    for (const Integration& integration : test::integrations()) {
      SCOPED_TRACE(director + " " + integration.rule + " " + integration.volumetric);
      const auto term = test::internal_force<D>(
          *body, "liquid_crystal_elastomer",
          test::law_texts().at("liquid_crystal_elastomer") +
              "volume_energy = \"logarithmic\"\nstep_length_end = 1.5\nstep_length_ramp = [0, 1]\n"
              "activity = 0.2\ndirector = \"" +
              director + "\"\n",
          integration);
      expect_tangent<D>(*term, body->size());
    }
}

TEST(Tangent, OfEveryLawAndRuleIsThatOfItsForces) {
  expect_tangents_of_laws<2>();
  expect_tangents_of_laws<3>();
}

template <int D>
void expect_tangents_of_surfaces() {
  const auto body = test::body_of<D>(test::potato<D>());
  expect_tangent<D>(*balanced_surface_tension<D>(*body, 1), body->size());
  expect_tangent<D>(*weak_surface_tension<D>(*body, 1, 3), body->size());
  expect_tangent<D>(*triangle_surface_tension<D>(*body, 1), body->size());
  CavityFilling filling;
  filling.pressure = 2;
  expect_tangent<D>(*cavity<D>(*body, SurfacePart::outer, filling, 3), body->size());
  filling.pressure.reset();
  filling.volume_target = 0.8;
  filling.penalty = 3;
  filling.ramp = {0, 1};
  expect_tangent<D>(*cavity<D>(*body, SurfacePart::outer, filling, 3), body->size());
}

TEST(Tangent, OfSurfacesAndCavitiesIsThatOfTheirForces) {
  expect_tangents_of_surfaces<2>();
  expect_tangents_of_surfaces<3>();
}

/// The curvature form has an energy, but its force is not the gradient.
TEST(Tangent, OfCurvatureIsThatOfItsForces) {
  const auto body = test::body_of<3>(test::potato<3>());
  const auto term = curvature_surface_tension<3>(*body, 1, 3);
  const Fields at = random_fields<3>(body->size(), 0.002, 0, 7),
               change = random_fields<3>(body->size(), 0.01, 0, 11);
  const NodalVectors difference = difference_of(*term, at, change, 0.01);
  EXPECT_LT(test::norm(test::sum_of(tangent_of(*term, at, change), -1, difference)),
            1e-10 * test::norm(difference));
}

TEST(Tangent, OfALoadThatDoesNotDependOnTheMotionIsZero) {
  const auto body = test::body_of<2>(test::potato<2>());
  body->mass.assign(static_cast<std::size_t>(body->size()), 1.0);
  const auto term = body_force<2>(*body, body->mass, {Expression("x*t"), Expression("1")});
  const Fields at = random_fields<2>(body->size(), 0.02, 0.5, 7);
  EXPECT_EQ(test::norm(tangent_of(*term, at, at)), 0);
}

template <int D>
void expect_tangents_of_pairs() {
  const auto pair = test::round_pair<D>(0.35);
  ContactLaw law = test::law<D>();
  law.cutoff = 20;  // the ends of the switch are out of reach
  for (const ContactForm form :
       {ContactForm::energy, ContactForm::pressure, ContactForm::volume, ContactForm::dissertation})
    for (const SiteDensity density : {SiteDensity::constant, SiteDensity::referential}) {
      SCOPED_TRACE(contact_form_names.at(static_cast<std::size_t>(form)));
      const auto term = test::contact_of<D>(pair, law, form, density);
      const Fields at = random_fields<D>(pair.size(), 0.01, 0, 7),
                   change = random_fields<D>(pair.size(), 0.1, 0, 11);
      const NodalVectors tangent = tangent_of(*term, at, change);
      const NodalVectors difference = difference_of(*term, at, change, 3e-3);
      EXPECT_LT(test::norm(test::sum_of(tangent, -1, difference)), 1e-8 * test::norm(difference));
      if (!term->potential(at.motion())) continue;
      const Fields other = random_fields<D>(pair.size(), 0.1, 0, 13);
      EXPECT_NEAR(test::dot(other.u, tangent), test::dot(change.u, tangent_of(*term, at, other)),
                  1e-12 * test::norm(tangent) * test::norm(other.u));
    }
}

TEST(Tangent, OfPairsIsThatOfTheirForces) {
  expect_tangents_of_pairs<2>();
  expect_tangents_of_pairs<3>();
}

/// Rigid partners, whose field is differentiated numerically; with points on patches and on the
/// surface.
template <int D>
void expect_tangents_of_partners() {
  const auto pair = test::round_pair<D>(0.35);
  const Body<D>& body = *pair.first;
  for (const bool on_patches : {false, true})
    for (const ContactForm form : {ContactForm::energy, ContactForm::pressure}) {
      SCOPED_TRACE(on_patches);
      ContactChoice choice;
      choice.name = "floor";
      choice.form = form;
      choice.on_patches = {on_patches, false};
      const ContactLaw law = test::law<D>();
      MovingPartner<D> partner;
      Vec<D> centre = Vec<D>::Constant(0.3);
      centre[0] = -2.2;
      partner.shape = rigid_ball<D>(law, 1, centre, 0.9);
      const auto term = rigid_contact<D>({body, 1.2}, std::move(partner), law, choice);
      const Fields at = random_fields<D>(body.size(), 0.01, 0, 7),
                   change = random_fields<D>(body.size(), 0.1, 0, 11),
                   other = random_fields<D>(body.size(), 0.1, 0, 13);
      const NodalVectors tangent = tangent_of(*term, at, change);
      const NodalVectors difference = difference_of(*term, at, change, 3e-3);
      EXPECT_LT(test::norm(test::sum_of(tangent, -1, difference)), 1e-8 * test::norm(difference));
      if (!term->potential(at.motion())) continue;
      EXPECT_NEAR(test::dot(other.u, tangent), test::dot(change.u, tangent_of(*term, at, other)),
                  1e-9 * test::norm(tangent) * test::norm(other.u));
    }
}

TEST(Tangent, OfRigidPartnersIsThatOfTheirForces) {
  expect_tangents_of_partners<2>();
  expect_tangents_of_partners<3>();
}

/// For uniform strains, dP = mu dF + (mu/J^2 + lambda) c cof F + (lambda (J - 1) - mu/J) dcof F
/// with c = cof F : dF. The work of the change on another strain G is V G : dP.
TEST(Tangent, OfNeoHookeanIsThatWrittenByHand) {
  const auto body = test::body_of<3>(test::potato<3>());
  constexpr Real mu = 0.7, lambda = 1.9;
  const auto term =
      test::internal_force<3>(*body, "neo_hookean", "density = 1\nmu = 0.7\nlambda = 1.9\n");
  Mat<3> H, dH;
  H << 0.2, 0.1, -0.05, 0.02, -0.15, 0.07, 0.11, 0.03, 0.1;
  dH << 0.3, -0.2, 0.5, 0.1, 0.4, -0.3, 0.25, 0.6, -0.7;
  const auto uniform = [&](const Mat<3>& G) {
    const NodalVectors u = test::field_on<3>(*body, [&](const Vec<3>& X) { return Vec<3>(G * X); });
    return Fields{u, test::zeros(u)};
  };
  const Mat<3> F = Mat<3>::Identity() + H;
  const Real J = F.determinant();
  const Mat<3> cof = J * F.inverse().transpose();
  const Real c = (cof.array() * dH.array()).sum();
  const Mat<3> dcof = (c * Mat<3>::Identity() - cof * dH.transpose()) * F.inverse().transpose();
  const Mat<3> dP =
      mu * dH + (mu / (J * J) + lambda) * c * cof + (lambda * (J - 1) - mu / J) * dcof;
  Real volume = 0;
  for (Index A = 0; A < body->size(); ++A) volume += body->cells.volume(A);
  const NodalVectors df = tangent_of(*term, uniform(H), uniform(dH));
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      Mat<3> G = Mat<3>::Zero();
      G(i, k) = 1;
      EXPECT_NEAR(-test::dot(uniform(G).u, df) / volume, dP(i, k), 1e-13);
    }
}

/// Newton's method for the equilibrium of a hanging block, with tangents as columns of a matrix.
/// Each residual is of the order of the square of the last one.
TEST(Tangent, MakesNewtonConvergeQuadratically) {
  const auto body = test::body_of<2>(test::brick<2>({2, 2}, 0.1));
  const auto force = test::internal_force<2>(*body, "neo_hookean");
  const std::size_t n = 2 * static_cast<std::size_t>(body->size());
  // The upper coefficients are held by springs; a force pulls all of them down.
  const auto residual_of = [&](const Fields& at) {
    NodalVectors f = force_of(*force, at);
    for (Index A = 0; A < body->size(); ++A) {
      meniscus::at(f, A) += Lanes(0, -0.05, 0, 0);
      if (meniscus::at(body->particles.X(), A)[1] > 0.9)
        meniscus::at(f, A) -= 10 * meniscus::at(at.u, A);
    }
    return f;
  };
  const auto solve = [&](const Fields& at, const NodalVectors& r) {
    Eigen::MatrixXd K(n, n);
    Eigen::VectorXd b(n);
    for (std::size_t k = 0; k < n; ++k) {
      Fields unit{test::zeros(at.u), test::zeros(at.u)};
      unit.u[k / 2].set(static_cast<int>(k % 2), 1);
      const NodalVectors column = tangent_of(*force, at, unit);
      for (std::size_t i = 0; i < n; ++i)
        K(static_cast<Index>(i), static_cast<Index>(k)) = column[i / 2][static_cast<int>(i % 2)];
      if (meniscus::at(body->particles.X(), k / 2)[1] > 0.9)
        K(static_cast<Index>(k), static_cast<Index>(k)) -= 10;
      b[static_cast<Index>(k)] = r[k / 2][static_cast<int>(k % 2)];
    }
    const Eigen::VectorXd x = K.partialPivLu().solve(-b);
    NodalVectors du = test::zeros(at.u);
    for (std::size_t k = 0; k < n; ++k)
      du[k / 2].set(static_cast<int>(k % 2), x[static_cast<Index>(k)]);
    return du;
  };
  Fields at{NodalVectors(static_cast<std::size_t>(body->size()), Lanes::zero()), {}};
  at.v = at.u;
  std::vector<Real> norms;
  for (int iteration = 0; iteration < 8; ++iteration) {
    const NodalVectors r = residual_of(at);
    norms.push_back(test::norm(r));
    at.u = test::sum_of(at.u, 1, solve(at, r));
  }
  std::string all;
  for (const Real norm : norms) all += fmt::format(" {:.2e}", norm);
  std::size_t fast = 0;
  for (std::size_t k = 1; k < norms.size(); ++k)
    if (norms[k - 1] < 1e-2 && norms[k - 1] > 1e-7) {
      EXPECT_LT(norms[k], 100 * norms[k - 1] * norms[k - 1] + 1e-15) << all;
      ++fast;
    }
  EXPECT_GE(fast, 2u) << all;
  EXPECT_LT(norms.back(), 1e-14) << all;
}

}  // namespace
}  // namespace meniscus::test_tangent
