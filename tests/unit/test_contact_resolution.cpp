// SPDX-License-Identifier: BSD-3-Clause
// Points per facet: as many as the estimate asks for make balls slide on each other, fewer do not.
#include "meniscus/physics/contact_numbers.hpp"
#include "meniscus/physics/contact_resolution.hpp"

#include <gtest/gtest.h>

#include "contact_support.hpp"

namespace meniscus {
namespace {

constexpr Real sigma0 = 0.4;

template <int D>
ContactLaw law() {
  return test::law<D>(D == 3 ? PairKernel::space : PairKernel::integrated, sigma0);
}

/// Turns X about `centre` by an angle, in the plane and a bit out of it.
template <int D>
Vec<D> turned(const Vec<D>& X, const Vec<D>& centre, Real angle) {
  const Vec<D> arm = X - centre;
  Vec<D> y = arm;
  const Real c = std::cos(angle), s = std::sin(angle);
  y[0] = c * arm[0] - s * arm[1];
  y[1] = s * arm[0] + c * arm[1];
  if constexpr (D == 3) {
    const Real z = y[2];
    y[2] = c * z - s * y[0];
    y[0] = c * y[0] + s * z;
  }
  return y + centre - X;
}

/// Largest tangential / normal force of two balls (2D: disks), each turned, some gap apart.
template <int D>
Real friction(int points, Real gap) {
  const auto pair = test::round_pair<D>(gap);
  Vec<D> axis = Vec<D>::Constant(0.3);
  axis[0] = 1;
  axis.normalize();
  const Vec<D> centre = (2 + gap) * axis;
  ContactChoice choice;
  choice.name = "pair";
  choice.points = points;
  const auto term = contact_pair<D>({*pair.first, 1}, {*pair.second, 1}, law<D>(), choice);
  Real largest = 0;
  for (int k = 1; k <= 5; ++k) {
    const NodalVectors u = pair.field([&](const Vec<D>& X) {
      return (X - centre).norm() < 1 + 1e-9 ? turned<D>(X, centre, 0.37 * k)
                                            : turned<D>(X, Vec<D>::Zero(), 0.53 * k);
    });
    const NodalVectors f = test::force_of(*term, u);
    Vec<D> net = Vec<D>::Zero();
    for (Index A = 0; A < pair.first->size(); ++A)
      for (int i = 0; i < D; ++i) net[i] += at(f, A)[i];
    const Real normal = net.dot(axis);
    largest = std::max(largest, (net - normal * axis).norm() / std::abs(normal));
  }
  return largest;
}

template <int D>
void expect_smooth() {
  const auto body = test::with_mass<D>(test::round<D>(Vec<D>::Zero()));
  const Real facet = facet_size(*body);
  EXPECT_NEAR(facet, D == 3 ? std::sqrt(4 * std::numbers::pi / 96) : 2 * std::numbers::pi / 16,
              1e-3);
  const ContactResolution resolution{facet, plane_contact(law<D>(), 1).equilibrium_gap, false};
  const int enough = resolution.enough_points();
  EXPECT_LT(resolution.tangential_share(enough), 1e-3);
  EXPECT_GE(resolution.tangential_share(enough - 1), 1e-3);
  // Balls attract each other down to 0.8 of the equilibrium gap of planes.
  const Real gap = 0.6 * resolution.gap;
  for (const int points : {enough, enough - 2})
    EXPECT_LT(friction<D>(points, gap), roughness(gap * points / facet, false)) << points;
  EXPECT_LT(friction<D>(enough, gap), 5e-3);
  EXPECT_GT(friction<D>(2, gap), 0.03);
}

TEST(ContactResolution, EnoughPointsLetBallsSlide) {
  expect_smooth<2>();
  expect_smooth<3>();
}

TEST(ContactResolution, FollowsGapAndFacet) {
  const ContactResolution coarse{0.4, 0.25, false}, fine{0.1, 0.25, false}, wide{0.4, 1, false},
      rigid{0.4, 0.25, true}, hopeless{0.4, 0.001, false};
  EXPECT_GT(coarse.enough_points(), 4);
  EXPECT_EQ(fine.enough_points(), 2);
  EXPECT_EQ(wide.enough_points(), 2);
  EXPECT_LE(rigid.enough_points(), 4);
  EXPECT_EQ(hopeless.enough_points(), 8);
  EXPECT_TRUE(hopeless.unfelt(8));
  EXPECT_FALSE(coarse.unfelt(1));
}

}  // namespace
}  // namespace meniscus
