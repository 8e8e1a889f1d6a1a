// SPDX-License-Identifier: BSD-3-Clause
// Solids that relax: a Prony series of branches of Maxwell.
#include "meniscus/scene/assembly.hpp"
#include "physics/internal/viscoelasticity.hpp"

#include <fmt/core.h>

namespace meniscus::viscoelasticity_table {
namespace {

template <int D>
struct Viscoelastic final : Load<D> {
  static constexpr std::string_view example =
      "body = \"other\"\nmoduli = [0.6, 0.3]\ntimes = [0.02, 0.5]\n";
  std::string body;
  std::vector<Real> moduli, times;

  static Rows<Viscoelastic> rows() {
    return {text_row("body", &Viscoelastic::body, "name of the body"),
            reals_row("moduli", &Viscoelastic::moduli, 0, dimension::pressure, range::positive,
                      "shear modulus of each branch (Prony series); those of the material are "
                      "what is left after a long time"),
            reals_row("times", &Viscoelastic::times, 0, dimension::time, range::positive,
                      "time in which the stress of each branch relaxes")};
  }
  std::optional<typename Load<D>::Identity> identity() const override { return {{"body", body}}; }
  void check(const Block& block, const BodyPlans<D>& bodies) const override {
    require_body(block, bodies, body);
    if (moduli.size() != times.size())
      block.problem("times", fmt::format("has {} numbers, moduli has {}; each branch has one of "
                                         "both",
                                         times.size(), moduli.size()));
    if (moduli.empty() || moduli.size() > MaxwellPoints::most_branches)
      block.problem("moduli", fmt::format("has {} numbers; allowed are 1 to {}", moduli.size(),
                                          MaxwellPoints::most_branches));
  }
  void build(Assembly<D>& assembly) const override {
    if (assembly.is_relaxing())
      throw InputError(this->place +
                       ": the rest of a body with a memory depends on time, which \"relax\" does "
                       "not follow; use \"newton\", whose load steps are steps in time, or "
                       "\"dynamics\"");
    assembly.keep_reference(body, "its [[viscoelasticity]] remembers strains of the reference");
    std::vector<MaxwellBranch> branches;
    for (std::size_t b = 0; b < moduli.size(); ++b) branches.push_back({moduli[b], times[b]});
    assembly.add(viscoelasticity(assembly.body(body), std::move(branches)), body);
  }
};

const bool registered = register_load<Viscoelastic>(
    "viscoelasticity", Stage::volume,
    "stress that relaxes, beside that of a material (generalised Maxwell, Prony series)");

}  // namespace
}  // namespace meniscus::viscoelasticity_table
