// SPDX-License-Identifier: BSD-3-Clause
// The table [[remap]]: when the reference configuration of a body is updated.
#include "body/grid/simplex.hpp"
#include "meniscus/scene/assembly.hpp"
#include "remap/distortion.hpp"

#include <fmt/core.h>

namespace meniscus::remap_table {
namespace {

template <int D>
struct Remaps final : Load<D> {
  static constexpr std::string_view example = "body = \"drop\"\nat = [0.1]\n";
  std::string body, nodes;
  std::vector<Real> at;
  Real condition = 0;

  static Rows<Remaps> rows() {
    return {
        text_row("body", &Remaps::body, "name of the body, a drop of fluid"),
        reals_row("at", &Remaps::at, 0, dimension::time, range::positive,
                  "times of remaps; each is done after the step that reaches the time",
                  std::vector<Real>{}),
        real_row(
            "condition", &Remaps::condition, dimension::none, {1.5, 100},
            "ratio of the largest and the least stretch of a particle since the last remap. The "
            "body is remapped when more than 1 % of its particles exceed it; checked every 50 "
            "steps, less often in runs of more than 1600 steps. 0: remaps at the times only",
            0),
        choice_row("nodes", &Remaps::nodes, {"even", "particles"},
                   "even: new nodes are spread evenly over the present shape, a ring of them on "
                   "the contact line of a rigid partner. particles: new nodes are at the particles",
                   "even")};
  }
  std::optional<typename Load<D>::Identity> identity() const override { return {{"body", body}}; }

  void check(const Block& block, const BodyPlans<D>& bodies) const override {
    const BodyPlan<D>* planned = require_body(block, bodies, body);
    if (planned && nodes == "even" && is_simplex<D>(planned->geometry.grid.cells.front()))
      block.problem("nodes", fmt::format("'even' places the nodes of hexahedra, but '{}' is of {}; "
                                         "allowed is particles",
                                         body, D == 3 ? "tetrahedra" : "triangles"));
    if (at.empty() && condition == 0)
      block.problem("at", "is missing; expected are times, or a condition");
  }
  void build(Assembly<D>& assembly) const override {
    const Body<D>& on = assembly.body(body);
    const auto distortion = std::make_shared<const Distortion<D>>(on);
    const auto now = [distortion, first = on.first](const Motion& motion) {
      return distortion->condition(motion.u.data() + first);
    };
    assembly.measure(body, {"condition", dimension::none,
                            "ratio of the largest and the least stretch since the last remap, "
                            "which 99 % of the particles do not exceed",
                            now});
    assembly.remap({body, at, nodes == "even", condition, now});
  }
};

const bool registered =
    register_load<Remaps>("remap", Stage::volume,
                          "a body that flows far is remapped: its present shape becomes the "
                          "reference, and steps are long again");

}  // namespace
}  // namespace meniscus::remap_table
