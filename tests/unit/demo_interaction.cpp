// SPDX-License-Identifier: BSD-3-Clause
// A demonstration: an interaction that no other file knows of. Morse's law of the gap; the tests of
// all loads find it.
#include "meniscus/physics/interaction_registry.hpp"

#include <cmath>

#include "load_examples.hpp"

namespace meniscus {
namespace {

/// e = W (x^2 - 2 x), x = exp((rest - g) / length).
struct DemoMorse final : Interaction {
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

std::string contact(const std::string& partner) {
  return "[[contact]]\nbodies = [\"drop\"]\ninteraction = \"demo_morse\"\nwork = 1\nrest = 0.3\n"
         "length = 0.1\npartner = { " +
         partner + " }\n";
}

const bool registered =
    register_interaction<DemoMorse>("demo_morse", "demonstration: Morse's law of the gap") &&
    register_entry(test::LoadExample{"contact.demo_morse", test::one_drop,
                                     [](int D) {
                                       return contact(
                                           std::string("type = \"half_space\", ") +
                                           (D == 3 ? "point = [0, 0, -1.35], normal = [0, 0, 1]"
                                                   : "point = [0, -1.35], normal = [0, 1]"));
                                     },
                                     true, false}) &&
    register_entry(test::LoadExample{"contact.demo_morse_ball", test::one_drop,
                                     [](int D) {
                                       return contact(
                                           std::string("type = \"ball\", radius = 0.7, centre = ") +
                                           (D == 3 ? "[0, 0.2, -2]" : "[0.2, -2]"));
                                     },
                                     true, false}) &&
    register_entry(test::LoadExample{
        "contact.demo_morse_cavity", test::one_drop,
        [](int D) {
          return contact(std::string("type = \"cavity\", radius = 1.4, centre = ") +
                         (D == 3 ? "[0, 0.1, 0]" : "[0.1, 0]"));
        },
        true, false}) &&
    register_entry(test::LoadExample{
        "contact.demo_morse_frame", test::one_drop,
        [](int D) {
          return D == 3 ? "" : contact("type = \"frame\", low = [-1.3, -1.4], high = [2, 3]");
        },
        true, false});

}  // namespace
}  // namespace meniscus
