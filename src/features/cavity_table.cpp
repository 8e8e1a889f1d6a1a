// SPDX-License-Identifier: BSD-3-Clause
// Cavity: the filling inside a closed surface.
#include "body/wall_supports.hpp"
#include "input/optional_rows.hpp"
#include "meniscus/scene/assembly.hpp"
#include "physics/loads/cavity.hpp"

#include <fmt/core.h>

namespace meniscus::cavity_table {
namespace {

struct Keys {
  std::string body, surface;
  std::optional<Real> pressure, volume_target, penalty;
  Ramp ramp;
  int points = 2;
  static Rows<Keys> rows();
};

Rows<Keys> Keys::rows() {
  return {
      text_row("body", &Keys::body, "name of the body around the cavity"),
      choice_row("surface", &Keys::surface, {"inner", "outer"},
                 "the closed surface that is filled; a drop has an outer one only", "inner"),
      optional_row("pressure", &Keys::pressure, dimension::pressure, range::any, "none",
                   "pressure inside above that outside; either this or volume_target, or neither: "
                   "vented"),
      optional_row("volume_target", &Keys::volume_target, dimension::none, range::positive, "none",
                   "volume of the content / enclosed volume of the reference"),
      optional_row("penalty", &Keys::penalty, dimension::pressure, range::positive, "none",
                   "pressure per deviation from volume_target, which needs it"),
      ramp_row("ramp", &Keys::ramp, "pressure from 0 or volume_target from 1"),
      integer_row("points", &Keys::points, {1, 8}, "Gauss points per direction and surface facet",
                  2),
  };
}

template <int D>
struct Cavity final : Load<D>, Keys {
  static constexpr std::string_view example =
      "body = \"drop\"\nsurface = \"outer\"\npressure = 0.3\n";
  std::optional<typename Load<D>::Identity> identity() const override { return {{"body", body}}; }

  void check(const Block& block, const BodyPlans<D>& bodies) const override {
    const BodyPlan<D>* planned = require_body(block, bodies, body);
    if (planned && surface == "inner" && !is_hollow(planned->geometry))
      block.problem("surface", fmt::format("'{}' has no inner surface; allowed is outer", body));
    if (pressure && volume_target)
      block.problem("pressure", "the volume is given, too; allowed is one of them");
    if (volume_target.has_value() != penalty.has_value())
      block.problem("penalty", "goes with volume_target; allowed are both or neither");
  }

  void build(Assembly<D>& assembly) const override {
    const SurfacePart part = surface == "inner" ? SurfacePart::inner : SurfacePart::outer;
    const CavityFilling filling{pressure, volume_target, penalty.value_or(0), ramp};
    assembly.add(cavity(assembly.body(body), part, filling, points), body);
    assembly.keep_reference(body, "its [[cavity]] depends on the volume of the reference");
  }
};

const bool registered =
    register_load<Cavity>("cavity", Stage::surface, "what fills a closed surface");

}  // namespace
}  // namespace meniscus::cavity_table
