// SPDX-License-Identifier: BSD-3-Clause
// The list of clusters against a search over all pairs, on moving clouds.
#include "physics/contact/pair/contact_list.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace meniscus::test_contact_list {
namespace {

using Cloud = AlignedVector<Lanes>;

template <int D>
Cloud random_cloud(Index clusters, Real size, Real spread, std::mt19937_64& generator) {
  std::uniform_real_distribution<Real> place(0, size), offset(-spread, spread);
  Cloud cloud;
  for (Index c = 0; c < clusters; ++c) {
    Vec<D> centre;
    for (int i = 0; i < D; ++i) centre[i] = place(generator);
    for (int i = 0; i < D; ++i) {
      Lanes x = Lanes::zero();
      for (int lane = 0; lane < 4; ++lane) x.set(lane, centre[i] + offset(generator));
      cloud.push_back(x);
    }
  }
  return cloud;
}

template <int D>
bool near(const Cloud& a, Index c, const Cloud& b, Index d, Real reach) {
  for (int k = 0; k < 4; ++k)
    for (int l = 0; l < 4; ++l) {
      Real square = 0;
      for (int i = 0; i < D; ++i) {
        const Real r = at(a, c * D + i)[k] - at(b, d * D + i)[l];
        square += r * r;
      }
      if (square <= reach * reach) return true;
    }
  return false;
}

/// All pairs within reach are in the rows, in both directions and in order; no pair is farther
/// apart than the list allows. Returns the number of pairs.
template <int D>
Index expect_complete(const ContactList<D>& list, const Cloud& a, const Cloud& b, Real reach,
                      Real farthest) {
  const auto n = static_cast<Index>(a.size()) / D, m = static_cast<Index>(b.size()) / D;
  std::set<std::pair<Index, Index>> listed, reverse;
  for (Index c = 0; c < n; ++c) {
    const auto row = list.of_first().of(c);
    EXPECT_TRUE(std::is_sorted(row.begin(), row.end()));
    for (const Index d : row) listed.emplace(c, d);
  }
  for (Index d = 0; d < m; ++d) {
    const auto row = list.of_second().of(d);
    EXPECT_TRUE(std::is_sorted(row.begin(), row.end()));
    for (const Index c : row) reverse.emplace(c, d);
  }
  EXPECT_EQ(listed, reverse);
  EXPECT_EQ(list.pairs(), static_cast<Offset>(listed.size()));
  Index found = 0;
  for (Index c = 0; c < n; ++c)
    for (Index d = 0; d < m; ++d) {
      const bool within = near<D>(a, c, b, d, reach);
      found += within;
      const bool is_listed = listed.contains({c, d});
      EXPECT_TRUE(is_listed || !within) << c << " " << d;
      EXPECT_TRUE(!is_listed || near<D>(a, c, b, d, farthest)) << c << " " << d;
    }
  return found;
}

template <int D>
void expect_complete_on_moving_clouds(unsigned seed) {
  std::mt19937_64 generator(seed);
  const Real reach = 0.5, skin = 0.15, size = D == 3 ? 3 : 5;
  Cloud a = random_cloud<D>(60, size, 0.1, generator),
        b = random_cloud<D>(45, size, 0.2, generator);
  ContactList<D> list(reach, skin);
  std::normal_distribution<Real> step(0, 0.01);
  Index found = 0;
  for (int k = 0; k < 60; ++k) {
    const bool built = list.update(a, b);
    EXPECT_TRUE(built || k > 0);
    found += expect_complete<D>(list, a, b, reach, reach + 2 * skin);
    for (Cloud* cloud : {&a, &b})
      for (Lanes& x : *cloud)
        for (int lane = 0; lane < 4; ++lane) x.set(lane, x[lane] + step(generator));
  }
  EXPECT_GT(found, 1000);        // the test found pairs
  EXPECT_GT(list.builds(), 3);   // rebuilt,
  EXPECT_LT(list.builds(), 55);  // but not always
}

TEST(ContactList, HasAllPairsOfMovingClouds) {
  for (unsigned seed = 0; seed < 3; ++seed) {
    expect_complete_on_moving_clouds<2>(seed);
    expect_complete_on_moving_clouds<3>(seed);
  }
}

TEST(ContactList, IsEmptyWhenTheCloudsAreApart) {
  std::mt19937_64 generator(1);
  const Cloud a = random_cloud<3>(10, 1, 0.1, generator);
  Cloud b = random_cloud<3>(10, 1, 0.1, generator);
  for (std::size_t k = 0; k < b.size(); k += 3) b[k] += 10.0;
  ContactList<3> list(0.5, 0.1);
  list.update(a, b);
  EXPECT_EQ(list.pairs(), 0);
  EXPECT_TRUE(list.of_first().active.empty());
  EXPECT_TRUE(list.of_second().active.empty());
  for (std::size_t k = 0; k < b.size(); k += 3) b[k] += -10.0;  // a fast approach is noticed,
  EXPECT_TRUE(list.update(a, b));
  EXPECT_GT(list.pairs(), 0);
  for (std::size_t k = 0; k < b.size(); k += 3) b[k] += 10.0;  // and so is the separation
  EXPECT_TRUE(list.update(a, b));
  EXPECT_EQ(list.pairs(), 0);
  EXPECT_TRUE(list.of_first().active.empty());
}

}  // namespace
}  // namespace meniscus::test_contact_list
