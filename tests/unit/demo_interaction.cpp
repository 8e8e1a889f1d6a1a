// SPDX-License-Identifier: BSD-3-Clause
// Demonstration: an interaction in one file, without a change elsewhere. Morse's law of the gap;
// the tests of everything registered find it.
#include "meniscus/physics/interaction_registry.hpp"

#include <cmath>

namespace meniscus::demo_interaction {
namespace {

/// e = W (x^2 - 2 x), x = exp((rest - g) / length).
struct DemoMorse final : Interaction {
  static constexpr std::string_view example = "work = 1\nrest = 0.3\nlength = 0.1\n";
  Real work = 0, rest = 0, length = 0;

  static Rows<DemoMorse> rows() {
    return {
        real_row("work", &DemoMorse::work, dimension::tension, range::positive, "adhesion W"),
        real_row("rest", &DemoMorse::rest, dimension::length, range::positive, "equilibrium gap"),
        real_row("length", &DemoMorse::length, dimension::length, range::positive,
                 "over which the interaction decays")};
  }
  PlaneState at(Real gap) const override {
    const Real x = std::exp((rest - gap) / length);
    return {work * x * (x - 2), 2 * work / length * x * (x - 1),
            2 * work / (length * length) * x * (2 * x - 1)};
  }
  Real range() const override { return rest + 10 * length; }
  Real least_gap() const override { return 0.2 * rest; }
  PlaneContact flat() const override {
    return {rest,
            work,
            work / (2 * length),
            rest + length * std::log(2),
            2 * work / (length * length),
            work / (4 * length * length),
            rest + length * std::log(4),
            work};
  }
};

const bool registered =
    register_interaction<DemoMorse>("demo_morse", "demonstration: Morse's law of the gap");

}  // namespace
}  // namespace meniscus::demo_interaction
