// SPDX-License-Identifier: BSD-3-Clause
// Number of contact points per facet. With the estimated number, balls slide on each other; with
// fewer points they do not. Far from a rigid partner, fewer points give the same forces.
#include "contact_support.hpp"
#include "physics/contact/contact_numbers.hpp"
#include "physics/contact/pair/contact_forms.hpp"
#include "physics/contact/points/contact_resolution.hpp"
#include "physics/contact/points/facet_grades.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace meniscus {
namespace {

constexpr Real sigma0 = 0.4;

template <int D>
ContactLaw law() {
  return test::law<D>(D == 3 ? PairKernel::space : PairKernel::integrated, sigma0);
}

/// Rotates X about `centre` by an angle. The rotation is mostly in the plane of the first two axes.
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

/// Largest ratio of tangential to normal force between two rotated balls (2D: disks) with a gap.
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
  for (const auto& [width, points] : {std::pair{1.0, 3}, {0.3, 4}, {0.2, 6}, {0.01, 6}})
    EXPECT_EQ((ContactResolution{0.4, 0.25, true, width}.enough_points()), points) << width;
  EXPECT_EQ(hopeless.enough_points(), 8);
  EXPECT_TRUE(hopeless.points_miss(8));
  EXPECT_FALSE(coarse.points_miss(1));
}

/// An interaction without far_power(), so that all points are used at any distance.
class AllPoints final : public Interaction {
 public:
  explicit AllPoints(const ContactLaw& law) : law_(law, 1.2 * 0.7) {}
  PlaneState at(Real gap) const override { return law_.at(gap); }
  Real range() const override { return law_.range(); }
  Real least_gap() const override { return law_.least_gap(); }
  PlaneContact flat() const override { return law_.flat(); }

 private:
  LennardJones law_;
};

template <int D>
ContactLaw uncut(Real size) {
  ContactLaw law = test::law<D>(D == 3 ? PairKernel::space : PairKernel::integrated, size);
  law.cutoff = std::numeric_limits<Real>::infinity();
  return law;
}

/// A partner whose surface is `gap` below the lowest point of a ball of radius 1.
template <int D>
MovingPartner<D> partner(const std::string& type, const ContactLaw& law, Real gap) {
  Vec<D> down = Vec<D>::Zero();
  down[D - 1] = -1;
  MovingPartner<D> moving;
  moving.beta = 0.7;
  if (type == "half space") moving.shape = rigid_half_space<D>(law, 0.7, (1 + gap) * down, -down);
  if (type == "ball") moving.shape = rigid_ball<D>(law, 0.7, (2 + gap) * down, 1);
  if constexpr (D == 2)
    if (type == "frame") moving.shape = rigid_frame(law, 0.7, {-3, -1 - gap}, {4, 5});
  return moving;
}

template <int D>
ContactChoice choice(int points, bool on_patches = false) {
  ContactChoice choice;
  choice.name = "pair";
  choice.points = points;
  choice.on_patches = {on_patches, false};
  return choice;
}

Real largest(const NodalVectors& f) {
  Real square = 0;
  for (const Lanes& x : f) square = std::max(square, sum(x * x));
  return std::sqrt(square);
}

Real size_of_sum(const NodalVectors& f) {
  return largest({std::accumulate(f.begin(), f.end(), Lanes::zero())});
}

/// Forces and energies with fewer points and with all points, at gaps from near the core to far
/// away. The surface has waves of the length of a facet, which fewer points resolve less well at
/// any position.
template <int D>
void expect_same(const std::string& type, Real size, int points, bool on_patches) {
  SCOPED_TRACE(type + " in " + std::to_string(D) + "D, " + std::to_string(points) + " points");
  const auto body = test::with_mass<D>(test::round<D>(Vec<D>::Zero()));
  const ContactLaw law = uncut<D>(size);
  const NodalVectors u = test::random_field<D>(body->size(), 0.01, 3);
  Real nodal = 0, net = 0, energy = 0;  // with all points: the largest force, and the least energy
  Real nodal_error = 0, net_error = 0, energy_error = 0;
  for (Real gap = 0.5 * size; gap < 8; gap *= 1.17) {
    const auto few = rigid_contact<D>({*body, 1.2}, partner<D>(type, law, gap), law,
                                      choice<D>(points, on_patches));
    const auto all =
        rigid_contact<D>({*body, 1.2}, partner<D>(type, law, gap), std::make_shared<AllPoints>(law),
                         choice<D>(points, on_patches));
    const NodalVectors f = test::force_of(*all, u),
                       error = test::sum_of(test::force_of(*few, u), -1, f);
    const Real e = test::energy_of(*all, u);
    nodal = std::max(nodal, largest(f));
    nodal_error = std::max(nodal_error, largest(error));
    net = std::max(net, size_of_sum(f));
    net_error = std::max(net_error, size_of_sum(error));
    energy = std::min(energy, e);
    energy_error = std::max(energy_error, std::abs(test::energy_of(*few, u) - e));
  }
  EXPECT_GT(nodal_error, 0);
  EXPECT_LT(nodal_error, 4e-5 * nodal);
  EXPECT_LT(net_error, 4e-6 * net);
  EXPECT_LT(energy_error, -3e-5 * energy);
}

TEST(FacetGrades, DoNotChangeForces) {
  expect_same<3>("half space", 0.3, 5, false);
  expect_same<3>("half space", 0.15, 6, false);
  expect_same<3>("half space", 0.3, 3, true);
  expect_same<3>("ball", 0.3, 4, false);
  expect_same<2>("half space", 0.2, 4, true);
  expect_same<2>("ball", 0.2, 5, false);
  expect_same<2>("frame", 0.2, 4, false);
}

/// The forces between a body and a ball have no torque about the centre of the ball, with any
/// grades of the facets.
TEST(FacetGrades, KeepForcesBalanced) {
  const auto body = test::with_mass<3>(test::round<3>(Vec<3>::Zero()));
  const ContactLaw law = uncut<3>(0.3);
  const auto term = rigid_contact<3>({*body, 1.2}, partner<3>("ball", law, 0.2), law, choice<3>(5));
  const NodalVectors u = test::random_field<3>(body->size(), 0.02, 7), f = test::force_of(*term, u);
  Vec<3> torque = Vec<3>::Zero(), net = torque;
  Real scale = 0;
  for (Index A = 0; A < body->size(); ++A) {
    const Vec<3> x = at(body->particles.X(), A) + vector_at<3>(u, A) - Vec<3>(0, 0, -2.2);
    const Vec<3> force = vector_at<3>(f, A);
    torque += Vec<3>(x[1] * force[2] - x[2] * force[1], x[2] * force[0] - x[0] * force[2],
                     x[0] * force[1] - x[1] * force[0]);
    net += force;
    scale += x.norm() * force.norm();
  }
  EXPECT_GT(net.norm(), 0);
  EXPECT_LT(torque.norm(), 1e-13 * scale);
}

/// Force and energy of two bodies by the sum over all points of both, in the form of the energy.
template <int D>
struct AllPairs {
  NodalVectors force;
  Real energy = 0;

  AllPairs(const test::Pair<D>& pair, const ContactLaw& law, int points, const NodalVectors& u)
      : force(test::zeros(u)) {
    const Motion motion{0, u, force};
    std::array<ContactPoints<D>, 2> side{
        ContactPoints<D>::on_surface(*pair.first, 1.2, SiteDensity::constant, points),
        ContactPoints<D>::on_surface(*pair.second, 0.7, SiteDensity::constant, points)};
    std::array<ContactPlaces<D>, 2> places{side[0].at_rest(), side[1].at_rest()};
    std::array<std::vector<Index>, 2> all;
    for (std::size_t k = 0; k < 2; ++k) {
      all[k].resize(static_cast<std::size_t>(side[k].clusters()));
      std::iota(all[k].begin(), all[k].end(), Index{0});
      side[k].move(motion, places[k]);
      side[k].update_weights(all[k], motion, places[k]);
    }
    with_kernel(law.kernel, [&](auto K) {
      const PairLaw<K()> pairs(law);
      for (std::size_t k = 0; k < 2; ++k) {
        AlignedVector<Lanes> T(places[k].x.size(), Lanes::zero()), S = T;
        for (const Index c : all[k]) {
          if constexpr (dimension_of(K()) == D)
            contact::sum_over_partners<contact::Energy<D>, D>(
                pairs, law.reach(), places[k].x_of(c), places[k].weight_of(c), all[1 - k], 1,
                places[1 - k], &at(T, c * D), &at(S, c * D));
          for (int i = 0; k == 0 && i < D; ++i)
            energy += sum(at(S, c * D + i) * places[k].weight_of(c)[i]);
        }
        side[k].add_force(places[k], all[k], T, S, force);
      }
    });
  }
};

/// Two round bodies with waves of the length of a facet, at gaps from near the core to the cut-off.
/// Several such pairs, since in a single pair the nearest facets may be far from the largest
/// forces.
template <int D>
void expect_same_of_pairs(Real size, int points) {
  SCOPED_TRACE(std::to_string(D) + "D, " + std::to_string(points) + " points");
  const ContactLaw law = test::law<D>(D == 3 ? PairKernel::space : PairKernel::integrated, size);
  Real nodal = 0, net = 0, energy = 0, nodal_error = 0, net_error = 0, energy_error = 0;
  const auto compare = [&](Real gap, unsigned seed) {
    const auto pair = test::round_pair<D>(gap);
    const NodalVectors u = pair.random(0.01, seed);
    const auto term =
        contact_pair<D>({*pair.first, 1.2}, {*pair.second, 0.7}, law, choice<D>(points));
    const AllPairs<D> all(pair, law, points, u);
    const NodalVectors f = test::force_of(*term, u), error = test::sum_of(f, -1, all.force);
    const auto on_first = [&](const NodalVectors& force) {
      return size_of_sum({force.begin(), force.begin() + pair.first->size()});
    };
    nodal = std::max(nodal, largest(all.force));
    nodal_error = std::max(nodal_error, largest(error));
    net = std::max(net, on_first(all.force));
    net_error = std::max(net_error, on_first(error));
    energy = std::min(energy, all.energy);
    energy_error = std::max(energy_error, std::abs(test::energy_of(*term, u) - all.energy));
  };
  for (unsigned seed = 1; seed <= (D == 3 ? 1 : 6); ++seed)
    for (Real gap = 0.5 * size; gap < 4 * size; gap *= D == 3 ? 1.7 : 1.25) compare(gap, seed);
  EXPECT_GT(nodal_error, 0);
  EXPECT_LT(nodal_error, 2e-5 * nodal);
  EXPECT_LT(net_error, 5e-5 * net);
  EXPECT_LT(energy_error, -1e-4 * energy);
}

TEST(FacetGrades, DoNotChangeForcesOfPairs) {
  expect_same_of_pairs<3>(0.4, 6);
  expect_same_of_pairs<3>(0.2, 5);
  expect_same_of_pairs<2>(0.4, 6);
  expect_same_of_pairs<2>(0.3, 5);
}

TEST(FacetGrades, AreCoarserFarther) {
  const LennardJones interaction(uncut<3>(0.1), 1);
  const FacetGrades grades(5, interaction, 0.2);
  EXPECT_EQ(grades.points(), (std::vector<int>{5, 3, 2}));
  EXPECT_EQ(grades.grade(0.05, 0.2), 0);
  EXPECT_EQ(grades.grade(5, 0.2), 2);
  EXPECT_EQ(grades.grade(5, 20), 0);
  int last = 0;
  for (Real distance = 0.05; distance < 5; distance *= 1.1) {
    EXPECT_GE(grades.grade(distance, 0.2), last);
    last = grades.grade(distance, 0.2);
  }
  EXPECT_EQ(FacetGrades(2, interaction, 0.2).count(), 1);
  EXPECT_EQ(FacetGrades(5, AllPoints(uncut<3>(0.1)), 0.2).count(), 1);
  const FacetGrades pairs = FacetGrades::of_pairs(6, interaction, 0.2);
  EXPECT_EQ(pairs.points(), (std::vector<int>{6, 4, 3, 2}));
  EXPECT_EQ(pairs.grade(0.05, 0.2), 0);
  EXPECT_EQ(pairs.grade(50, 0.2), 2);  // two points only measure the distance
  EXPECT_EQ(FacetGrades::of_pairs(3, interaction, 0.2).count(), 1);
}

}  // namespace
}  // namespace meniscus
