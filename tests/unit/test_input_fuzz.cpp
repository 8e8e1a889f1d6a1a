// SPDX-License-Identifier: BSD-3-Clause
// Damaged scenes, quantities, formulas and paths are read or refused, without a crash.
#include "unit/input_scene.hpp"

#include <gtest/gtest.h>

#include <random>

namespace meniscus::test_input_fuzz {
namespace {

using namespace input_test;

// ---- robustness
// ----------------------------------------------------------------------------------

TEST(Fuzz, MutatedScenesAreReadOrRefused) {
  std::mt19937 random(7);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  int refused = 0, accepted = 0;
  for (int round = 0; round < 3000; ++round) {
    std::string toml = valid_scene;
    for (std::size_t n = 1 + below(2); n > 0; --n) {
      const std::size_t place = below(toml.size());
      switch (below(4)) {
        case 0:
          toml[place] = static_cast<char>(random());
          break;
        case 1:
          toml.erase(place, 1 + below(8));
          break;
        case 2:
          toml.insert(place, toml, below(toml.size()), below(12));
          break;
        default:
          toml[place] = toml[below(toml.size())];
      }
    }
    try {
      const auto input = SceneInput::from_text(toml);
      const LiquidScene scene = read_scene(input.root());
      (void)input.complete();
      input.check();
      for (const auto& liquid : scene.liquids) liquid.at({1e-9, 1, 2});
      ++accepted;
    } catch (const InputError& error) {
      EXPECT_STRNE(error.what(), "");
      ++refused;
    }
  }
  EXPECT_GT(refused, 1000);
  EXPECT_GT(accepted, 100);
}

TEST(Fuzz, MutatedQuantitiesFormulasAndPathsAreReadOrRefused) {
  std::mt19937 random(11);
  const std::string letters = "0123456789.eE+-*/^()<>=!?:&|,[]{}'\" xyztpimskgNPaJ\xc2\xb5#_$";
  const std::string seeds[] = {"2.2e9*(1 + sin(x)/5e-9)", "1e3 kg/(m s^2)", "x > 0 ? min(1,y) : t",
                               "body[0].liquid.note=1"};
  for (int round = 0; round < 4000; ++round) {
    std::string text = seeds[random() % 4];
    for (unsigned n = 1 + random() % 6; n > 0; --n) {
      const std::size_t place = random() % (text.size() + 1);
      const char letter = letters[random() % letters.size()];
      if (random() % 3 == 0 && place < text.size())
        text[place] = letter;
      else
        text.insert(place, 1, letter);
    }
    try {
      (void)UnitSystem("nm-ps-ag").quantity(text, dimension::pressure);
    } catch (const InputError&) {
    }
    try {
      (void)Expression(text)({1, 2, 3}, 4);
    } catch (const InputError&) {
    }
    try {
      SceneInput::from_text(valid_scene, "s.toml", {text});
    } catch (const InputError&) {
    }
  }
}

}  // namespace
}  // namespace meniscus::test_input_fuzz
