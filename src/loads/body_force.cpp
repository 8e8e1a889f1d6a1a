// SPDX-License-Identifier: BSD-3-Clause
// A force per mass as a formula of place and time.
#include "meniscus/physics/body_force.hpp"

#include "meniscus/scene/assembly.hpp"

namespace meniscus::body_force_load {
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
    require_body(block, bodies, body);
  }
  void build(Assembly<D>& assembly) const override {
    assembly.add(body_force(assembly.body(body), acceleration), body);
  }
};

const bool registered =
    register_load<BodyForce>("body_force", Stage::volume, "force per mass, e.g. gravity");

}  // namespace
}  // namespace meniscus::body_force_load
