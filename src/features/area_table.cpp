// SPDX-License-Identifier: BSD-3-Clause
// Resistance of the whole surface of a body against a change of its total area.
#include "meniscus/scene/assembly.hpp"
#include "physics/surface/global_area.hpp"

namespace meniscus::area_table {
namespace {

struct Keys {
  std::string body;
  Real modulus = 0, area_target = 1;
  Ramp ramp;
  int points = 3;

  static Rows<Keys> rows() {
    return {text_row("body", &Keys::body, "name of the body whose surface it is"),
            real_row("modulus", &Keys::modulus, dimension::tension, range::positive,
                     "tension per deviation from area_target"),
            real_row("area_target", &Keys::area_target, dimension::none, range::positive,
                     "total area / that of the reference", 1.0),
            ramp_row("ramp", &Keys::ramp, "area_target from 1"),
            integer_row("points", &Keys::points, {1, 8},
                        "Gauss points per direction and surface facet", 3)};
  }
};

template <int D>
struct Area final : Load<D>, Keys {
  static constexpr std::string_view example =
      "body = \"drop\"\nmodulus = 2\narea_target = 1.05\nramp = [0, 0.2]\n";
  std::optional<typename Load<D>::Identity> identity() const override { return {{"body", body}}; }

  void check(const Block& block, const BodyPlans<D>& bodies) const override {
    require_body(block, bodies, body);
  }
  void build(Assembly<D>& assembly) const override {
    assembly.add(global_area(assembly.body(body), {modulus, area_target, ramp}, points), body);
    assembly.keep_reference(body, "its [[area]] depends on the area of the reference");
  }
};

const bool registered = register_load<Area>(
    "area", Stage::surface, "resistance of a whole surface against a change of its total area");

}  // namespace
}  // namespace meniscus::area_table
