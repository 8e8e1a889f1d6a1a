// SPDX-License-Identifier: BSD-3-Clause
// An exact motion with which a body is compared.
#include "measure/shape_measures.hpp"
#include "meniscus/scene/assembly.hpp"

namespace meniscus::exact_table {
namespace {

template <int D>
struct Exact final : Load<D> {
  static constexpr std::string_view example =
      D == 3
          ? "body = \"drop\"\ndisplacement = [\"0.1*t\", 0, 0]\nvelocity = [0.1, 0, 0]\nrate = 1\n"
          : "body = \"drop\"\ndisplacement = [\"0.1*t\", 0]\nvelocity = [0.1, 0]\nrate = 1\n";
  std::string body;
  std::vector<Expression> displacement, velocity;
  Real rate = 0;

  static Rows<Exact> rows() {
    return {text_row("body", &Exact::body, "name of the body whose exact motion is known"),
            expressions_row("displacement", &Exact::displacement, D, dimension::length,
                            "a formula of x, y, z, t for each component"),
            expressions_row("velocity", &Exact::velocity, D, dimension::velocity,
                            "a formula of x, y, z, t for each component"),
            real_row("rate", &Exact::rate, dimension::rate, range::positive,
                     "weight of displacements beside velocities in the error; the frequency of an "
                     "oscillation")};
  }
  std::optional<typename Load<D>::Identity> identity() const override { return {{"body", body}}; }

  void check(const Block& block, const BodyPlans<D>& bodies) const override {
    require_body(block, bodies, body);
  }
  void build(Assembly<D>& assembly) const override {
    assembly.measure(body, state_error(assembly.body(body), {displacement, velocity, rate}));
  }
};

const bool registered =
    register_load<Exact>("exact", Stage::volume, "measure: error against a known motion");

}  // namespace
}  // namespace meniscus::exact_table
