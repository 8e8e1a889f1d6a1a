// SPDX-License-Identifier: BSD-3-Clause
// A reference profile with which the shape of a shell is compared.
#include "body/wall_supports.hpp"
#include "measure/cell_measures.hpp"
#include "meniscus/scene/assembly.hpp"

#include <fmt/core.h>

namespace meniscus::profile_table {
namespace {

template <int D>
struct Profile final : Load<D> {
  static constexpr std::string_view example = "body = \"shell\"\nr = [0, 2]\nz = [0.8, 0]\n";
  std::string body, label;
  std::vector<Real> r, z;

  static Rows<Profile> rows() {
    return {text_row("body", &Profile::body, "name of the shell whose mean meridian is compared"),
            reals_row("r", &Profile::r, 0, dimension::length, range::non_negative,
                      "distances from the axis of places of a known outer profile"),
            reals_row("z", &Profile::z, 0, dimension::length, range::any,
                      "their heights above the middle plane; the profile is symmetric"),
            text_row("label", &Profile::label, "what pictures call it", "given profile")};
  }
  std::optional<typename Load<D>::Identity> identity() const override { return {{"body", body}}; }

  void check(const Block& block, const BodyPlans<D>& bodies) const override {
    const BodyPlan<D>* planned = require_body(block, bodies, body);
    if (planned && !is_hollow(planned->geometry))
      block.problem("body", fmt::format("'{}' is not a shell", body));
    else if (planned && space_dimension(planned->geometry.grid) == 2)
      block.problem(
          "body",
          fmt::format("'{}' is in the plane; allowed are bodies in space or of revolution", body));
    if (r.size() != z.size() || r.empty())
      block.problem("z",
                    fmt::format("has {} numbers, but r has {}; allowed are as many, at least 1",
                                z.size(), r.size()));
  }
  void build(Assembly<D>& assembly) const override {
    assembly.measure(body, profile_rms(assembly.body(body), r, z));
  }
};

const bool registered = register_load<Profile>(
    "profile", Stage::surface, "measure: distance from a known profile of a shell of revolution");

}  // namespace
}  // namespace meniscus::profile_table
