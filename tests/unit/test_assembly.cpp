// SPDX-License-Identifier: BSD-3-Clause
// Assembly: names of measures are unique.
#include "meniscus/scene/assembly.hpp"

#include <gtest/gtest.h>

namespace meniscus::test_assembly {
namespace {

TEST(Assembly, HasEachMeasureOnce) {
  Scene<2> scene;
  Assembly<2> assembly(scene, true);
  const MeasureSource reach{"reach", dimension::length, "", {}};
  assembly.measure("one", reach);
  assembly.measure("two", reach);
  EXPECT_THROW(assembly.measure("one", reach), std::logic_error);
}

}  // namespace
}  // namespace meniscus::test_assembly
