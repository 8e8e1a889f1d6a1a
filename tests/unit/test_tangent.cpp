// SPDX-License-Identifier: BSD-3-Clause
// Tangents of the terms against other differences of their forces; linear, and symmetric where
// there is an energy.
#include "meniscus/physics/cavity.hpp"
#include "meniscus/physics/surface_tension.hpp"

#include <gtest/gtest.h>

#include "contact_support.hpp"
#include "support.hpp"

namespace meniscus {
namespace {

/// Changes of the size of a spacing.
struct Change {
  NodalVectors u, v;
  Motion motion() const { return {0, u, v}; }
};

NodalVectors tangent_of(ForceTerm& term, const Change& at, const Change& change) {
  NodalVectors f = test::zeros(at.u);
  term.add_tangent(at.motion(), change.motion(), f);
  return f;
}

template <int D>
Change random_change(Index size, Real u, Real v, unsigned seed) {
  return {test::random_field<D>(size, u, seed), test::random_field<D>(size, v, seed + 1)};
}

/// `symmetric`: relative deviation allowed for the tangent of an energy.
template <int D>
void expect_tangent(ForceTerm& term, Index size, Real symmetric) {
  SCOPED_TRACE(term.name());
  const Change at = random_change<D>(size, 0.02, term.viscous() ? 0.5 : 0, 7);
  const Change change = random_change<D>(size, 0.1, 0.1, 11);
  const NodalVectors tangent = tangent_of(term, at, change);
  NodalVectors difference = test::zeros(at.u);
  constexpr Real h = 1e-5;
  const auto moved = [&](Real s) {
    return test::force_of(term, test::sum_of(at.u, s, change.u), test::sum_of(at.v, s, change.v));
  };
  const NodalVectors plus = moved(h), minus = moved(-h);
  for (std::size_t A = 0; A < difference.size(); ++A)
    difference[A] = (plus[A] - minus[A]) / (2 * h);
  EXPECT_LT(test::norm(test::sum_of(tangent, -1, difference)), 1e-6 * test::norm(difference));
  const NodalVectors zero = test::zeros(at.u);
  const Change half{test::sum_of(zero, 0.5, change.u), test::sum_of(zero, 0.5, change.v)};
  EXPECT_LT(test::norm(test::sum_of(tangent, -2, tangent_of(term, at, half))),
            1e-6 * test::norm(tangent));
  if (symmetric == 0) return;
  // Along displacements alone: viscous forces have no energy.
  Change a = random_change<D>(size, 0.1, 0, 17), b = random_change<D>(size, 0.1, 0, 19);
  const Change still{at.u, test::zeros(at.u)};
  const Real one = test::dot(b.u, tangent_of(term, still, a)),
             two = test::dot(a.u, tangent_of(term, still, b));
  const Real size_of_both = test::norm(tangent_of(term, still, a)) * test::norm(b.u);
  EXPECT_GT(size_of_both, 0);
  EXPECT_LT(std::abs(one - two), symmetric * size_of_both);
}

template <int D>
void expect_tangents() {
  const auto body = test::body_of<D>(test::potato<D>());
  for (const auto& [law, text] : test::law_texts())
    for (const Integration& integration : test::integrations()) {
      SCOPED_TRACE(integration.rule + " " + integration.volumetric);
      expect_tangent<D>(*test::internal_force<D>(*body, law, integration), body->size(), 1e-6);
    }
  expect_tangent<D>(*weak_surface_tension<D>(*body, 1, 3), body->size(), 1e-6);
  expect_tangent<D>(*triangle_surface_tension<D>(*body, 1), body->size(), 1e-6);
  expect_tangent<D>(*curvature_surface_tension<D>(*body, 1, 3), body->size(), 0);
  CavityFilling filling;
  filling.pressure = 2;
  expect_tangent<D>(*cavity<D>(*body, SurfacePart::outer, filling, 3), body->size(), 1e-6);
}

TEST(Tangent, OfEveryTermIsThatOfItsForces) {
  expect_tangents<2>();
  expect_tangents<3>();
}

TEST(Tangent, OfContactIsThatOfItsForces) {
  const auto pair = test::round_pair<2>(0.35);
  const auto term = test::contact_of<2>(pair, test::law<2>(), ContactForm::energy);
  expect_tangent<2>(*term, pair.first->size() + pair.second->size(), 1e-6);
}

}  // namespace
}  // namespace meniscus
