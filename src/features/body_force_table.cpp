// SPDX-License-Identifier: BSD-3-Clause
// A force per mass, given by a formula of position and time.
#include "meniscus/scene/assembly.hpp"
#include "physics/loads/body_force.hpp"

#include <algorithm>

namespace meniscus::body_force_table {
namespace {

template <int D>
struct BodyForce final : Load<D> {
  static constexpr std::string_view example =
      D == 3 ? "body = \"drop\"\nacceleration = [\"0.1*x*cos(t)\", 0, -1]\n"
             : "body = \"drop\"\nacceleration = [\"0.1*x*cos(t)\", -1]\n";
  std::string body;
  std::vector<Expression> acceleration;

  static Rows<BodyForce> rows() {
    return {text_row("body", &BodyForce::body, "name of the body"),
            expressions_row("acceleration", &BodyForce::acceleration, D, dimension::acceleration,
                            "force per mass, a formula of reference position x, y, z and time t "
                            "for each component")};
  }
  void check(const Block& block, const BodyPlans<D>& bodies) const override {
    const BodyPlan<D>* on = require_body(block, bodies, body);
    if (on && on->geometry.grid.revolved && !is_zero(acceleration.front()))
      block.problem("acceleration", "acts across the axis of revolution; allowed is 0 for x");
  }
  static bool is_zero(const Expression& a) { return a.constant() && a({0, 0, 0}) == 0; }
  void build(Assembly<D>& assembly) const override {
    const Body<D>& on = assembly.body(body);
    const bool one_for_all = std::none_of(acceleration.begin(), acceleration.end(),
                                          [](const Expression& a) { return a.depends_on_place(); });
    const SceneBody& of_body = assembly.of(body);
    const bool drop =
        of_body.is_fluid() && (of_body.has_balanced_tension() || of_body.has_face_tension);
    if (drop && one_for_all && on.uniform_density) {
      assembly.of(body).accelerations.push_back(acceleration);
      assembly.add(weight_on_patches(on, acceleration), body);
    } else {
      assembly.of(body).other_body_forces = true;
      assembly.add(body_force(on, assembly.is_dynamic() ? on.mass : on.mass_integral, acceleration),
                   body);
    }
  }
};

const bool registered =
    register_load<BodyForce>("body_force", Stage::volume, "force per mass, e.g. gravity");

}  // namespace
}  // namespace meniscus::body_force_table
