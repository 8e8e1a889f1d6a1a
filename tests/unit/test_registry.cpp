// SPDX-License-Identifier: BSD-3-Clause
// Names of a registry: sorted, unique, with suggestions for misspelt ones.
#include "input/registry.hpp"
#include "meniscus/error.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace meniscus::test_registry {
namespace {

struct Liquid {
  static constexpr const char* kind = "liquid";
  std::string_view name;
  double density = 0;
};

TEST(Registry, KnowsItsEntriesByName) {
  Registry<Liquid> liquids;
  EXPECT_TRUE(liquids.add({"water", 1000}));
  EXPECT_TRUE(liquids.add({"hexane", 655}));
  EXPECT_EQ(liquids.size(), 2u);
  EXPECT_EQ(liquids.names(), (std::vector<std::string>{"hexane", "water"}));
  EXPECT_EQ(liquids.at("water").density, 1000);
  EXPECT_EQ(liquids.find("hexane")->density, 655);
  EXPECT_EQ(liquids.find("mercury"), nullptr);
}

TEST(Registry, RefusesANameThatIsTaken) {
  Registry<Liquid> liquids;
  liquids.add({"water", 1000});
  EXPECT_THROW(liquids.add({"water", 999}), std::logic_error);
  EXPECT_EQ(liquids.at("water").density, 1000);
}

TEST(Registry, GuessesWhatAMisspeltNameMeans) {
  Registry<Liquid> liquids;
  liquids.add({"water", 1000});
  liquids.add({"hexane", 655});
  try {
    liquids.at("watre");
    FAIL() << "an unknown name is found";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "there is no liquid 'watre'; allowed are hexane, water; did you mean 'water'?");
  }
}

TEST(Registry, IsOneForAllFiles) {
  EXPECT_TRUE(register_entry(Liquid{"oil", 900}));
  EXPECT_EQ(Registry<Liquid>::all().at("oil").density, 900);
  EXPECT_THROW(register_entry(Liquid{"oil", 910}), std::logic_error);
}

}  // namespace
}  // namespace meniscus::test_registry
