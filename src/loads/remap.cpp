// SPDX-License-Identifier: BSD-3-Clause
// Times at which a body is referred anew to where it is.
#include "meniscus/scene/assembly.hpp"

#include <fmt/core.h>

namespace meniscus::remap_load {
namespace {

template <int D>
struct RemapTimes final : Load<D> {
  static constexpr std::string_view example = "body = \"drop\"\nat = [0.1]\n";
  std::string body;
  std::vector<Real> at;

  static Rows<RemapTimes> rows() {
    return {text_row("body", &RemapTimes::body, "name of the body, a drop of fluid"),
            reals_row("at", &RemapTimes::at, 0, dimension::time, range::positive,
                      "times; it is done after the step that reaches one")};
  }
  std::optional<typename Load<D>::Identity> identity() const override { return {{"body", body}}; }

  void check(const Block& block, const BodyPlans<D>& bodies) const override {
    const BodyPlan<D>* planned = require_body(block, bodies, body);
    if (planned && planned->geometry.surface && !planned->geometry.surface->smooth())
      block.problem("body", fmt::format("the surface of '{}' has edges, which cannot be recovered; "
                                        "allowed are smooth shapes such as ball",
                                        body));
  }
  void build(Assembly<D>& assembly) const override { assembly.remap({body, at}); }
};

const bool registered =
    register_load<RemapTimes>("remap", Stage::volume,
                              "a body that flows far is referred anew to where it is: its steps "
                              "are long again, as if it had just begun");

}  // namespace
}  // namespace meniscus::remap_load
