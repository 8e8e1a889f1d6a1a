// SPDX-License-Identifier: BSD-3-Clause
// Every registered shape of a rigid partner: its distance belongs to its closed-form field, and its
// derivatives are consistent.
#include "meniscus/physics/interaction_registry.hpp"

#include <gtest/gtest.h>

#include <map>

namespace meniscus::test_partner_shapes {
namespace {

template <int D>
const std::map<std::string, std::string>& texts() {
  static const std::map<std::string, std::string> all =
      D == 3 ? std::map<std::string,
                        std::string>{{"half_space",
                                      "point = [0.1, 0.2, -1.6]\nnormal = [0.2, -0.4, 2]"},
                                     {"ball", "centre = [0.3, -0.2, -2.5]\nradius = 0.8"},
                                     {"cavity", "centre = [-0.5, 0, -0.3]\nradius = 2.1"}}
             : std::map<std::string, std::string>{
                   {"half_space", "point = [0.1, -1.6]\nnormal = [0.2, 2]"},
                   {"ball", "centre = [0.3, -2.5]\nradius = 0.8"},
                   {"cavity", "centre = [-0.5, -0.4]\nradius = 2.1"},
                   {"frame", "low = [-1.7, -1.5]\nhigh = [2, 1.8]"}};
  return all;
}

template <int D>
void expect_consistent_feet() {
  const ContactLaw law{D == 3 ? PairKernel::space : PairKernel::integrated, 1, 0.3};
  const std::vector<Vec<D>> places{Vec<D>::Constant(0.31), Vec<D>::Unit(0) * 0.9,
                                   Vec<D>::Unit(D - 1) * -1.1};
  for (const auto& [name, entry] : partners<D>()) {
    SCOPED_TRACE(name + " in " + std::to_string(D) + "D");
    const SceneInput input = SceneInput::from_text(texts<D>().at(name));
    const auto shape = entry.read(input.root());
    input.check();
    const auto field = shape->lennard_jones(law, 1);
    for (const Vec<D>& x : places) {
      const auto foot = shape->foot(x);
      EXPECT_NEAR(foot.distance, field->distance(x), 1e-14);
      EXPECT_NEAR(foot.normal.norm(), 1, 1e-14);
      for (int i = 0; i < D; ++i) {
        constexpr Real h = 1e-5;
        const auto above = shape->foot(x + h * Vec<D>::Unit(i)),
                   below = shape->foot(x - h * Vec<D>::Unit(i));
        EXPECT_NEAR((above.distance - below.distance) / (2 * h), foot.normal[i], 1e-9);
        EXPECT_LT(((above.normal - below.normal) / (2 * h) - foot.bend.col(i)).norm(), 1e-9);
      }
    }
  }
}

TEST(PartnerShapes, KnowTheirDistanceAndItsDerivatives) {
  expect_consistent_feet<2>();
  expect_consistent_feet<3>();
}

}  // namespace
}  // namespace meniscus::test_partner_shapes
